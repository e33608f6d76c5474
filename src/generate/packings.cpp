// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/packings.h"

#include "generate/fibre_line.h"
#include "generate/lattice.h"
#include "generate/random_packing.h"
#include "generate/sphere_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

namespace grainfrac {

namespace {

using Spheres = std::vector<SphereSpec>;

/// Generators name keys of their own table; here these get their place in the file.
template <class Generator>
auto below(const std::string& path, const Generator& generate)
{
    try {
        return generate();
    } catch (InputError& e) {
        for (InputProblem& problem : e.problems) problem.key = path + '.' + problem.key;
        throw;
    }
}

/// The sphere that all of a part are copies of.
SphereSpec prototype(const Case& c, std::size_t part)
{
    const PartSpec& p = c.parts[part];
    SphereSpec s;
    s.radius = 0.5 * p.diameter;
    s.group = static_cast<std::int32_t>(part);
    while (c.materials[static_cast<std::size_t>(s.material)].name != p.material) ++s.material;
    s.velocity = p.velocity;
    s.angular_velocity = p.angular_velocity;
    return s;
}

/// A straight fibre along the c axis of the lattice that it lies in, without a spacing of its own, has a node at each
/// of its layers: bonds of its surface then measure slip and nothing else. It goes on with the same spacing where it is
/// outside. Empty where that is not so.
FibreNodes nodes_of_layers(const PartSpec& p, const PartSpec& host_part, const Spheres& host)
{
    const FibreSpec& f = p.fibre;
    const int axis = axis_index(host_part.lattice_axis);
    const Vec3 way = f.to - f.from;
    if (host_part.generator != "hcp" || f.shape != "straight" || f.spacing ||
        std::fabs(std::fabs(way[axis]) - norm(way)) > 1e-9 * norm(way))
        return {};
    const double round_off = 1e-6 * host_part.diameter;
    std::vector<double> layers;
    for (const SphereSpec& s : host) layers.push_back(s.position[axis]);
    std::sort(layers.begin(), layers.end());
    layers.erase(
        std::unique(layers.begin(), layers.end(), [&](double x, double y) { return std::fabs(x - y) < round_off; }),
        layers.end());
    if (way[axis] < 0.0) std::reverse(layers.begin(), layers.end());
    FibreNodes nodes;
    const double length = norm(way);
    std::vector<double> places;  // from the begin of the fibre [m]
    for (const double z : layers) {
        const double s = (z - f.from[axis]) * length / way[axis];
        if (s >= -round_off && s <= length + round_off) places.push_back(s);
    }
    if (places.size() < 2) return {};
    nodes.piece = places[1] - places[0];
    check_count("to", length / nodes.piece);
    while (places.front() - nodes.piece >= -round_off) places.insert(places.begin(), places.front() - nodes.piece);
    while (places.back() + nodes.piece <= length + round_off) places.push_back(places.back() + nodes.piece);
    for (const double s : places) nodes.position.push_back(f.from + (s / length) * way);
    nodes.before = std::clamp(places.front(), 0.0, 0.5 * nodes.piece);
    nodes.after = std::clamp(length - places.back(), 0.0, 0.5 * nodes.piece);
    return nodes;
}

/// The chain of a part and its copies, one after the other; `chains` counts those of all parts.
Spheres chain_spheres(const PartSpec& p, const SphereSpec& model, const FibreNodes& nodes, std::int32_t& chains)
{
    SphereSpec s = model;
    s.section_radius = p.fibre.radius.value_or(0.0);
    Spheres all;
    for (std::size_t copy = 0; copy <= p.copies.size(); ++copy) {
        s.chain = chains++;
        for (std::size_t k = 0; k < nodes.position.size(); ++k) {
            s.position = nodes.position[k] + (copy == 0 ? Vec3{} : p.copies[copy - 1]);
            s.piece = nodes.length_of(k);
            all.push_back(s);
        }
    }
    return all;
}

/// Of the file those in the region, if there is one.
std::vector<Ball> file_balls(const Case& c, const PartSpec& p)
{
    std::vector<Ball> balls;
    try {
        balls = read_spheres(std::filesystem::path(c.file).parent_path() / p.file, p.name);
    } catch (const std::runtime_error& e) {
        throw InputError("file", e.what());
    }
    const SphereRegion region(p.region);
    if (norm2(region.half) > 0.0) {
        std::erase_if(balls, [&](const Ball& b) { return !region.contains(b.center); });
        if (balls.empty()) throw InputError("region", fmt::format("no sphere of \"{}\" has its centre in it", p.file));
    }
    return balls;
}

Spheres packed_spheres(const Case& c, std::size_t part)
{
    const PartSpec& p = c.parts[part];
    const SphereRegion region(p.region);
    const SphereSpec model = prototype(c, part);
    Spheres all;
    const auto add = [&](const Vec3& center, double radius) {
        all.push_back(model);
        all.back().position = center;
        all.back().radius = radius;
    };
    if (p.generator == "hcp" || p.generator == "fcc") {
        const bool hcp = p.generator == "hcp";
        for (const Vec3& x :
             hcp ? hcp_sites(region, p.diameter, axis_index(p.lattice_axis), p.lattice_origin == "channel")
                 : fcc_sites(region, p.diameter)) {
            add(x, model.radius);
        }
    } else {
        const RandomPackingSpec random{region,           p.diameter,        p.size_ratio,
                                       p.solid_fraction, c.simulation.seed, static_cast<std::uint32_t>(part)};
        for (const Ball& b : p.generator == "file" ? file_balls(c, p) : random_packing(random)) add(b.center, b.radius);
    }
    return all;
}

std::size_t part_named(const Case& c, const std::string& name)
{
    const auto found = std::find_if(c.parts.begin(), c.parts.end(), [&](const PartSpec& p) { return p.name == name; });
    return static_cast<std::size_t>(found - c.parts.begin());
}

/// The host's spheres in the region change part.
Spheres take(const PartSpec& p, const SphereSpec& model, Spheres& host)
{
    const SphereRegion region(p.region);
    Spheres taken;
    std::erase_if(host, [&](const SphereSpec& s) {
        if (!region.contains(s.position)) return false;
        taken.push_back(model);
        taken.back().position = s.position;
        taken.back().radius = s.radius;
        return true;
    });
    if (taken.empty()) throw InputError("region", fmt::format("no sphere of \"{}\" has its centre in it", p.inside));
    if (host.empty()) throw InputError("region", fmt::format("takes all spheres of \"{}\"", p.inside));
    return taken;
}

/// Whether one of the nodes is in the box around the centres of the host's spheres.
bool reaches_into(const Spheres& nodes, std::size_t begin, std::size_t end, const Vec3& low, const Vec3& high)
{
    return std::any_of(nodes.begin() + static_cast<std::ptrdiff_t>(begin),
                       nodes.begin() + static_cast<std::ptrdiff_t>(end), [&](const SphereSpec& s) {
                           bool in = true;
                           for (int k = 0; k < 3; ++k) in = in && s.position[k] >= low[k] && s.position[k] <= high[k];
                           return in;
                       });
}

std::string key_of_copy(std::size_t copy)
{
    return copy == 0 ? std::string("fibre") : fmt::format("copies[{}]", copy - 1);
}

double fibre_radius(const PartSpec& p)
{
    return p.fibre.radius.value_or(0.5 * p.diameter);
}

/// Where a fibre is in its matrix, all of its section is; it may stick out at its ends.
void check_section_inside(const PartSpec& p, const PartSpec& host, const Spheres& nodes)
{
    const SphereRegion region(host.region);
    if (norm2(region.half) == 0.0) return;  // of a file
    constexpr int points = 16, few = 2;     // on the circle
    const std::size_t links = nodes.size() / (p.copies.size() + 1);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (i % links == 0 || i % links + 1 == links) continue;
        const Vec3 x = nodes[i].position, before = nodes[i - 1].position, after = nodes[i + 1].position;
        if (!region.contains(x) || !region.contains(before) || !region.contains(after)) continue;
        const Vec3 t = normalized(after - before), u = any_perpendicular(t), v = cross(t, u);
        int outside = 0;
        for (int k = 0; k < points; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / points;
            outside += region.contains(x + fibre_radius(p) * (std::cos(angle) * u + std::sin(angle) * v)) ? 0 : 1;
        }
        if (outside > few) {
            throw InputError(key_of_copy(i / links),
                             fmt::format("this fibre is not wholly inside \"{}\": at ({:.6g}, {:.6g}, {:.6g}) m its "
                                         "radius of {:.6g} m reaches out of the region",
                                         host.name, x.x, x.y, x.z, fibre_radius(p)));
        }
    }
}

/// Fibres of one part do not run through each other.
void check_copies_apart(const PartSpec& p, const Spheres& nodes)
{
    const std::vector<Vec3> line = fibre_polyline(p.fibre);
    const std::size_t links = nodes.size() / (p.copies.size() + 1);
    for (std::size_t copy = 1; copy <= p.copies.size(); ++copy) {
        for (std::size_t other = 0; other < copy; ++other) {
            const Vec3 shift = p.copies[copy - 1] - (other == 0 ? Vec3{} : p.copies[other - 1]);
            for (std::size_t k = 0; k < links; ++k) {
                const double apart = distance_to_polyline(nodes[k].position + shift, line);
                if (apart >= 2.0 * fibre_radius(p) * (1.0 - 1e-9)) continue;
                throw InputError(key_of_copy(copy),
                                 fmt::format("this fibre runs through {}: their axes are {:.4g} m apart, and must be "
                                             "{:.4g} m or more",
                                             other == 0 ? std::string("the first one") : key_of_copy(other), apart,
                                             2.0 * fibre_radius(p)));
            }
        }
    }
}

/// The host's spheres whose centre is nearer to the line of a chain than the fibre's radius go.
void make_room(const PartSpec& p, const Spheres& nodes, Spheres& host)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Vec3 low{infinity, infinity, infinity}, high = -low;
    for (const SphereSpec& s : host) {
        for (int k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], s.position[k] - s.radius);
            high[k] = std::max(high[k], s.position[k] + s.radius);
        }
    }
    const double radius = fibre_radius(p);
    const std::vector<Vec3> line = fibre_polyline(p.fibre);
    const std::size_t links = nodes.size() / (p.copies.size() + 1);
    for (std::size_t copy = 0; copy <= p.copies.size(); ++copy) {
        if (!reaches_into(nodes, copy * links, (copy + 1) * links, low, high)) {
            throw InputError(key_of_copy(copy),
                             fmt::format("this fibre is outside of \"{}\", whose spheres lie between ({:.6g}, "
                                         "{:.6g}, {:.6g}) and ({:.6g}, {:.6g}, {:.6g}) m",
                                         p.inside, low.x, low.y, low.z, high.x, high.y, high.z));
        }
        const Vec3 shift = copy == 0 ? Vec3{} : p.copies[copy - 1];
        // what lies on the fibre's surface, as sites of a lattice do, stays whatever the round-off
        std::erase_if(host, [&](const SphereSpec& s) {
            return distance_to_polyline(s.position - shift, line) < radius * (1.0 - 1e-9);
        });
    }
    if (host.empty()) {
        throw InputError(p.fibre.radius ? "fibre.radius" : "diameter",
                         fmt::format("the fibre takes the place of all spheres of \"{}\"", p.inside));
    }
}

}  // namespace

std::vector<SphereSpec> generate_spheres(const Case& c)
{
    std::vector<Spheres> of_part(c.parts.size());
    std::int32_t chains = 0;
    const auto for_parts = [&](const auto& generate) {
        for (std::size_t k = 0; k < c.parts.size(); ++k) {
            if (c.parts[k].kind == "spheres") below(fmt::format("parts[{}]", k), [&] { generate(k, c.parts[k]); });
        }
    };
    for_parts([&](std::size_t k, const PartSpec& p) {
        if (p.generator != "taken" && p.generator != "chain") of_part[k] = packed_spheres(c, k);
    });
    for_parts([&](std::size_t k, const PartSpec& p) {
        if (p.generator != "chain") return;
        FibreNodes nodes;
        if (!p.inside.empty()) {
            const std::size_t host = part_named(c, p.inside);
            nodes = nodes_of_layers(p, c.parts[host], of_part[host]);
        }
        if (nodes.position.empty())
            nodes = below("fibre", [&] { return fibre_nodes(p.fibre, p.fibre.spacing.value_or(p.diameter)); });
        of_part[k] = chain_spheres(p, prototype(c, k), nodes, chains);
    });
    for_parts([&](std::size_t k, const PartSpec& p) {
        if (p.generator == "taken") of_part[k] = take(p, prototype(c, k), of_part[part_named(c, p.inside)]);
    });
    for_parts([&](std::size_t k, const PartSpec& p) {
        if (p.generator != "chain" || p.inside.empty()) return;
        const std::size_t host = part_named(c, p.inside);
        if (c.parts[host].kind == "spheres") make_room(p, of_part[k], of_part[host]);
        check_section_inside(p, c.parts[host], of_part[k]);
        check_copies_apart(p, of_part[k]);
    });
    Spheres all;
    for (const Spheres& spheres : of_part) all.insert(all.end(), spheres.begin(), spheres.end());
    return all;
}

void make_room_for_fibres(const Case& c, std::vector<GrainSpec>& grains)
{
    for (std::size_t k = 0; k < c.parts.size(); ++k) {
        const PartSpec& p = c.parts[k];
        if (p.kind != "spheres" || p.generator != "chain" || p.inside.empty()) continue;
        const std::size_t host = part_named(c, p.inside);
        if (c.parts[host].kind != "grains") continue;
        const std::vector<Vec3> line = fibre_polyline(p.fibre);
        const double radius = fibre_radius(p);
        for (std::size_t copy = 0; copy <= p.copies.size(); ++copy) {
            const std::size_t before = grains.size();
            const Vec3 shift = copy == 0 ? Vec3{} : p.copies[copy - 1];
            std::erase_if(grains, [&](const GrainSpec& g) {
                return g.group == static_cast<std::int32_t>(host) &&
                       distance_to_polyline(g.site - shift, line) < radius;
            });
            if (grains.size() < before) continue;
            const std::string key = copy == 0 ? std::string("inside") : fmt::format("copies[{}]", copy - 1);
            throw InputError(fmt::format("parts[{}].{}", k, key),
                             fmt::format("no grain of \"{}\" has its centre in {} fibre; the fibre must run where "
                                         "grains can make room for it",
                                         p.inside, copy == 0 ? "the" : "this"));
        }
    }
}

}  // namespace grainfrac
