// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/microstructure.h"

#include "generate/hexagonal_prisms.h"
#include "geometry/cut.h"
#include "model/random.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

namespace grainfrac {

namespace {

/// Default dilation radius over the mean inradius: small enough to leave corners sharp, large enough for contact
/// detection with a distance (physics: dilated polyhedra).
constexpr double default_dilation = 0.04;

Vec3 axis_of(const std::string& word)
{
    return word == "x" ? Vec3{1, 0, 0} : (word == "y" ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
}

HexagonalPrismSpec prism_spec(const PartSpec& p)
{
    HexagonalPrismSpec s;
    s.side = p.side;
    s.thickness = p.thickness;
    s.stacking = p.stacking == "half"
                     ? Stacking::half
                     : (p.stacking == "hollow" || p.stacking == "AB" ? Stacking::hollow : Stacking::columnar);
    s.boundary = p.at_region_boundary == "cut" ? BoundaryMode::cut : BoundaryMode::keep;
    s.lattice = s.boundary == BoundaryMode::cut
                    ? LatticeMode::fill
                    : (p.lattice == "contained" ? LatticeMode::contained : LatticeMode::nominal);
    s.centered = p.centered;
    s.sliver_fraction = p.sliver_fraction;
    const bool round = p.region.shape == "cylinder" || p.region.shape == "disc";
    s.region.shape = round ? Region::Shape::cylinder : Region::Shape::box;
    s.region.center = p.region.center;
    s.region.size = p.region.size;
    s.region.diameter = p.region.diameter;
    s.region.height = p.region.height;
    s.region.axis = axis_of(p.region.axis);
    s.region.facets = p.region.facets;
    return s;
}

/// Crystal with a_1 along a vertex direction of the hexagon and c along the prism axis. Vertices lie at 30 deg + 60 deg
/// k.
Quat prism_crystal()
{
    return from_axis_angle({0, 0, 1}, std::numbers::pi / 6.0);
}

std::vector<Quat> read_orientations(const std::string& key, const std::filesystem::path& file, std::size_t count)
{
    std::ifstream in(file);
    if (!in) throw InputError(key, fmt::format("cannot read \"{}\"", file.string()));
    std::vector<Quat> q;
    Quat next;
    while (in >> next.w >> next.x >> next.y >> next.z) {
        const double n = std::sqrt(next.w * next.w + next.x * next.x + next.y * next.y + next.z * next.z);
        if (!(std::fabs(n - 1.0) < 1e-3))
            throw InputError(key, fmt::format("line {} of \"{}\" is no unit quaternion", q.size() + 1, file.string()));
        q.push_back(normalized(next));
    }
    if (!in.eof())
        throw InputError(key,
                         fmt::format("line {} of \"{}\": four numbers w x y z expected", q.size() + 1, file.string()));
    if (q.size() != count) {
        throw InputError(
            key, fmt::format("\"{}\" holds {} quaternions, the part has {} grains", file.string(), q.size(), count));
    }
    return q;
}

void orient(const Case& c, const PartSpec& part, const std::string& key, std::size_t first,
            std::vector<GrainSpec>& grains)
{
    const OrientationSpec& o = part.orientation;
    std::vector<Quat> from_file;
    if (!o.file.empty()) {
        from_file = read_orientations(key + ".orientation.file", std::filesystem::path(c.file).parent_path() / o.file,
                                      grains.size() - first);
    }
    for (std::size_t i = first; i < grains.size(); ++i) {
        const auto id = static_cast<std::uint32_t>(i);
        const double u = uniform_random(c.simulation.seed, RandomPurpose::orientation, id);
        Quat& q = grains[i].crystal;
        if (!o.file.empty())
            q = from_file[i - first];
        else if (o.random == "uniform")
            q = uniform_rotation(c.simulation.seed, RandomPurpose::orientation, id);
        else if (o.random == "c-fibre")
            q = from_axis_angle({0, 0, 1}, u * std::numbers::pi / 3.0) * q;
        else if (!o.choices.empty()) {
            const auto pick =
                std::min(static_cast<std::size_t>(u * static_cast<double>(o.choices.size())), o.choices.size() - 1);
            q = from_axis_angle(axis_of(o.about), o.choices[pick]) * q;
        }
    }
}

std::vector<GrainSpec> prism_grains(const PartSpec& part, const std::string& key)
{
    std::vector<LatticeCell> cells;
    try {
        cells = hexagonal_prism_lattice(prism_spec(part));
    } catch (const std::invalid_argument& e) {
        throw InputError(key + ".region", e.what());
    }
    for (LatticeCell& cell : cells) {
        if (part.gap == 0.0) break;
        cell.shape = erode(cell.shape, 0.5 * part.gap);
        if (cell.shape.faces.empty()) throw InputError(key + ".gap", "nothing is left of a grain; lower it");
    }
    double inradius = 0.0;
    for (const LatticeCell& cell : cells)
        inradius += inscribed_ball(cell.shape).radius / static_cast<double>(cells.size());
    std::vector<GrainSpec> grains;
    for (LatticeCell& cell : cells) {
        GrainSpec g;
        g.shape = std::move(cell.shape);
        g.site = cell.site;
        g.dilation_radius = part.dilation_radius.value_or(default_dilation * inradius);
        g.crystal = prism_crystal();
        grains.push_back(std::move(g));
    }
    return grains;
}

std::vector<GrainSpec> file_grains(const Case& c, const PartSpec& part, const std::string& key)
{
    try {
        std::vector<GrainSpec> grains = read_microstructure(std::filesystem::path(c.file).parent_path() / part.file);
        for (GrainSpec& g : grains) g.dilation_radius = part.dilation_radius.value_or(g.dilation_radius);
        return grains;
    } catch (const std::runtime_error& e) {
        throw InputError(key + ".file", e.what());
    }
}

}  // namespace

std::vector<GrainSpec> generate_grains(const Case& c)
{
    std::vector<GrainSpec> all;
    for (std::size_t p = 0; p < c.parts.size(); ++p) {
        const PartSpec& part = c.parts[p];
        if (part.kind != "grains") continue;
        const std::string key = fmt::format("parts[{}]", p);
        const std::size_t first = all.size();
        std::int32_t material = 0;
        while (c.materials[static_cast<std::size_t>(material)].name != part.material) ++material;
        for (GrainSpec& g : part.generator == "file" ? file_grains(c, part, key) : prism_grains(part, key)) {
            g.material = material;
            g.group = static_cast<std::int32_t>(p);
            g.velocity = part.velocity;
            g.angular_velocity = part.angular_velocity;
            all.push_back(std::move(g));
        }
        orient(c, part, key, first, all);
    }
    return all;
}

}  // namespace grainfrac
