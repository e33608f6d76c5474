// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/calibration.h"
#include "experiment/pulled_sample.h"
#include "experiment/specimen.h"
#include "model/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainfrac {

namespace {

/// Across and along a sample, in spheres, random spheres, or hexagons: the surface is softer to a depth of one or two.
constexpr double spheres_across = 12.0, random_across = 14.0, prisms_across = 16.0;
/// Length of what is measured over its own section (a fibre), in sections.
constexpr double chain_links = 12.0;
constexpr double lattice_tolerance = 0.005, random_tolerance = 0.02;  // [-]

std::size_t find_part(const Case& c, const std::string& name, const std::string& key)
{
    for (std::size_t i = 0; i < c.parts.size(); ++i) {
        if (c.parts[i].name == name) return i;
    }
    throw InputError(key + "part", fmt::format("there is no part \"{}\"", name));
}

/// The entry of [[bonds]] that joins a part with itself, as BondTable would take it.
int find_bonds(const Case& c, const PartSpec& part, const std::string& key)
{
    Model model;
    model.materials.push_back({part.material, 0.0, 0.0, 0.0});
    model.groups.push_back({part.name, 0, false});
    std::vector<std::array<std::string, 2>> betweens;
    for (const BondSpec& b : c.bonds) betweens.push_back(b.between);
    const int entry = most_specific(betweens, model, 0, 0);
    if (entry < 0)
        throw InputError(key + "part", fmt::format("no entry of [[bonds]] joins \"{}\" with itself", part.name));
    if (c.bonds[static_cast<std::size_t>(entry)].law == "point")
        throw InputError(key + "part", "bonds of law \"point\" are not calibrated; use parallel or interface");
    return entry;
}

bool is_thin_fibre(const PartSpec& p)
{
    return p.generator == "taken" || p.generator == "chain";
}

Packing packing_of(const PartSpec& p)
{
    if (p.generator == "hcp") return Packing::hcp;
    if (p.generator == "fcc") return Packing::fcc;
    return p.generator == "hexagonal_prisms" ? Packing::honeycomb : Packing::random;
}

/// Where a fibre's spheres come from makes its packing.
const PartSpec& packed_part(const Case& c, const PartSpec& part)
{
    const PartSpec* p = &part;
    while (p->generator == "taken") {
        const auto host =
            std::find_if(c.parts.begin(), c.parts.end(), [&](const PartSpec& q) { return q.name == p->inside; });
        if (host == c.parts.end()) break;
        p = &*host;
    }
    return *p;
}

RegionSpec cylinder(int axis, double diameter, double height)
{
    RegionSpec r;
    r.shape = "cylinder";
    r.axis = std::string(1, static_cast<char>('x' + axis));
    r.diameter = diameter;
    r.height = height;
    return r;
}

/// The part as a sample of its own: the same packing in another region.
PartSpec sample_part(const Case& c, const PartSpec& part, const CalibrationSpec& spec, int axis)
{
    PartSpec s = part;
    s.velocity = s.angular_velocity = Vec3{};
    if (part.generator == "chain") {
        const double spacing = part.fibre.spacing.value_or(part.diameter);
        s.inside.clear();
        s.copies.clear();
        s.fibre = FibreSpec{};
        s.fibre.spacing = spacing;
        s.fibre.radius = part.fibre.radius;
        s.fibre.to[axis] = std::round(spec.length.value_or(chain_links * spacing) / spacing) * spacing;
    } else if (part.generator == "taken") {
        const PartSpec& host = packed_part(c, part);
        s.generator = host.generator;
        s.diameter = host.diameter;
        s.lattice_axis = host.lattice_axis;
        s.lattice_origin = host.lattice_origin;
        s.inside.clear();
        s.region = part.region;
        s.region.center = part.region.center - host.region.center;  // where the lattice has its origin
        s.region.height = spec.length.value_or(chain_links * host.diameter);
    } else if (part.generator == "hexagonal_prisms") {
        const double pitch = std::sqrt(3.0) * part.side;
        s.region = RegionSpec{};
        const double width = spec.width.value_or(prisms_across * pitch);
        s.region.size = {width, width, part.thickness};
        s.region.size[axis] = spec.length.value_or(prisms_across * pitch);
    } else if (part.generator == "hcp" || part.generator == "fcc" || part.generator == "random_dense") {
        const double across = part.generator == "random_dense" ? random_across : spheres_across;
        s.region =
            cylinder(axis, spec.width.value_or(across * part.diameter), spec.length.value_or(across * part.diameter));
    }
    return s;
}

int direction_of(const Case& c, const PartSpec& part, const CalibrationSpec& spec)
{
    if (spec.direction != "auto") return axis_of(spec.direction);
    const PartSpec& packed = packed_part(c, part);
    if (packed.generator == "hcp") return axis_of(packed.lattice_axis);
    return part.generator == "hexagonal_prisms" ? 0 : 2;
}

double level_distance(Packing packing, double d)
{
    return packing == Packing::hcp ? std::sqrt(2.0 / 3.0) * d : d / std::sqrt(2.0);
}

/// Of the endless packing; 0 where it is that of the sample.
double solid_fraction(Packing packing)
{
    if (packing == Packing::random) return 0.0;
    return packing == Packing::honeycomb ? 1.0 : std::numbers::pi / std::sqrt(18.0);
}

/// Section that carries the load: of a lattice the cells of its spheres, of a fibre its own, else that of the region.
double section_of(const PartSpec& part, const PartSpec& sample, Packing packing, const State& state, int axis)
{
    if (part.generator == "chain") {
        const double a = part.fibre.radius.value_or(0.5 * part.diameter);
        return std::numbers::pi * a * a;
    }
    if (part.generator == "taken") return 0.25 * std::numbers::pi * part.region.diameter * part.region.diameter;
    if (packing == Packing::hcp || packing == Packing::fcc) {
        const double d = sample.diameter, cell = d * d * d / std::sqrt(2.0);
        const Range1D z = range_along(state, axis);
        return state.bodies.size() * cell / (z.high - z.low + level_distance(packing, d));
    }
    return 0.25 * std::numbers::pi * sample.region.diameter * sample.region.diameter;
}

/// Sum of A l^2 over the bonds in the window, over its volume: makes the closed form of a random packing one for k_n.
double bond_density(const State& state, const Window& window)
{
    double sum = 0.0;
    const SphereBonds& p = state.sphere_bonds;
    for (int i = 0; i < p.size(); ++i) {
        const Vec3 middle = 0.5 * (state.bodies.position[p.a[i]] + state.bodies.position[p.b[i]]);
        const SphereBondKind& k = p.kind_of(i);
        sum += window.weight(middle) * std::numbers::pi * k.radius * k.radius * k.length * k.length;
    }
    const InterfaceBonds& f = state.interfaces;
    for (int i = 0; i < f.size(); ++i) {
        const Vec3 a = state.bodies.position[f.a[i]], b = state.bodies.position[f.b[i]];
        sum += window.weight(0.5 * (a + b)) * f.area[i] * norm2(b - a);
    }
    return sum / window.volume();
}

}  // namespace

CalibrationSample::CalibrationSample(const Case& c, std::size_t calibration, Device device)
    : spec_(c.calibration[calibration]), key_(fmt::format("calibration[{}].", calibration)), device_(device)
{
    part_ = find_part(c, spec_.part, key_);
    const PartSpec& part = c.parts[part_];
    entry_ = find_bonds(c, part, key_);
    packing_ = packing_of(packed_part(c, part));
    axis_ = direction_of(c, part, spec_);
    core_ = spec_.measure == "core" || (spec_.measure == "auto" && !is_thin_fibre(part));
    if (part.generator == "chain" && spec_.poisson_ratio)
        throw InputError(key_ + "poisson_ratio", "a chain has no width; leave it out and give start_shear_ratio");
    if (spec_.poisson_ratio && (*spec_.poisson_ratio > largest_poisson_ratio(packing_) + 1e-12) &&
        packing_ != Packing::random) {
        throw InputError(key_ + "poisson_ratio",
                         fmt::format("springs in this packing reach at most {:.4g}", largest_poisson_ratio(packing_)));
    }
    if (packing_ == Packing::honeycomb && axis_ == 2)
        throw InputError(key_ + "direction", "hexagonal prisms are pulled in their plane: x or y");

    case_ = c;
    case_.parts = {sample_part(c, part, spec_, axis_)};
    case_.calibration.clear();
    case_.bonds = {c.bonds[static_cast<std::size_t>(entry_)]};
    case_.bonds[0].between = {part.name, part.name};
    case_.bonds[0].made_in.clear();
    case_.contacts.clear();
    case_.walls.clear();
    case_.test = TestSpec{};
    StageSpec stage;
    stage.name = "pull";
    stage.duration = 1.0;
    case_.stages = {stage};
    case_.control = ControlSpec{};
    for (MaterialSpec& m : case_.materials) m.cleavage = CleavageSpec{};

    if (!core_ && part.generator == "file" && !spec_.area)
        throw InputError(key_ + "area", "missing: the section of a sample from a file is not known");
    const Built sample = built({1.0, 1.0});
    const State& state = sample.state;
    bodies_ = state.bodies.size();
    bonds_ = state.bond_slots();
    const double size = sample.model.nominal_length;
    thickness_ = packing_ == Packing::honeycomb ? part.thickness : 0.0;
    if (core_) {
        const auto window = core_window(state, axis_, size, thickness_);
        if (!window)
            throw InputError(key_ + "width",
                             "the sample is too thin for a core; raise width, or measure = \"section\"");
        if (packing_ == Packing::random) density_ = bond_density(state, *window);
    } else {
        area_ = spec_.area.value_or(section_of(part, case_.parts[0], packing_, state, axis_));
        if (packing_ == Packing::random && part.generator != "chain")
            density_ = bond_density(state, *core_window(state, axis_, 0.0, thickness_));
    }
    if (packing_ == Packing::honeycomb) density_ = std::sqrt(3.0) * part.side;
    if (packing_ == Packing::hcp || packing_ == Packing::fcc) {
        const double r = state.sphere_bonds.kind_of(0).radius;  // K_n = k_n pi r^2 and E = K_n/d f
        density_ = std::numbers::pi * r * r / case_.parts[0].diameter;
    }
    if (part.generator == "chain") spacing_ = *case_.parts[0].fibre.spacing;
}

Built CalibrationSample::built(const BondConstants& bonds, bool breaks) const
{
    Case c = case_;
    c.bonds[0].normal_stiffness = bonds.normal_stiffness;
    c.bonds[0].shear_ratio = bonds.shear_ratio;
    if (!breaks)
        c.bonds[0].softening = "brittle";  // whatever the stiffness of a trial, it has no fracture energy to lack
    try {
        return build(c, device_);
    } catch (InputError& e) {  // the sample has one part and one entry of [[bonds]]
        const auto rename = [](std::string& key, const std::string& from, const std::string& to) {
            if (key.starts_with(from)) key.replace(0, from.size(), to);
        };
        for (InputProblem& p : e.problems) {
            rename(p.key, "parts[0]", fmt::format("parts[{}]", part_));
            rename(p.key, "bonds[0]", fmt::format("bonds[{}]", entry_));
            p.message += " (in the sample of " + key_.substr(0, key_.size() - 1) + ")";
        }
        throw;
    }
}

ElasticTarget CalibrationSample::target() const
{
    ElasticTarget t;
    t.young_modulus = spec_.young_modulus;
    t.poisson_ratio = spec_.poisson_ratio;
    t.packing = packing_;
    t.tolerance = spec_.tolerance.value_or(packing_ == Packing::random ? random_tolerance : lattice_tolerance);
    t.most_trials = static_cast<int>(spec_.max_trials);
    return t;
}

BondConstants CalibrationSample::start() const
{
    double ratio = case_.bonds[0].shear_ratio.value_or(1.0);
    if (spec_.poisson_ratio) {
        const double nu = std::min(*spec_.poisson_ratio, largest_poisson_ratio(packing_));
        ratio = lattice_stiffness(packing_, 1.0, nu, 1.0)->shear_ratio;
    }
    ratio = spec_.start_shear_ratio.value_or(ratio);
    const double k = spacing_ > 0.0 ? spec_.young_modulus / spacing_
                                    : lattice_stiffness_at(packing_, spec_.young_modulus, ratio, density_).normal;
    return {spec_.start_normal_stiffness.value_or(k), ratio};
}

Response CalibrationSample::pull(const BondConstants& bonds) const
{
    Built sample = built(bonds);
    PulledSample pulled(sample.model, sample.state, axis_);
    const double nu = lattice_elasticity(packing_, {1.0, bonds.shear_ratio}, 1.0).poisson_ratio;
    Response r;
    const Relaxed relaxed = pulled.stretch_to(small_strain, nu);
    r.residual = relaxed.residual;
    r.steps = relaxed.steps;
    r.at_rest = relaxed.at_rest;
    const std::optional<Window> core =
        core_window(sample.state, axis_, core_ ? sample.model.nominal_length : 0.0, thickness_);
    const Strains strains = pulled.strains(&*core);
    r.young_modulus = pulled.force() / (area_ * pulled.strain_of_ends());
    r.poisson_ratio = -strains.lateral(axis_) / strains.normal[axis_];
    if (core_) {
        const CoreElasticity e = core_elasticity(pulled.mean_stress(*core, solid_fraction(packing_)), strains, axis_);
        r.young_modulus = e.young_modulus;
        r.poisson_ratio = e.poisson_ratio;
    }
    return r;
}

double CalibrationSample::strength(const BondConstants& bonds) const
{
    Built sample = built(bonds, true);
    PulledSample pulled(sample.model, sample.state, axis_);
    const double nu = lattice_elasticity(packing_, {1.0, bonds.shear_ratio}, 1.0).poisson_ratio;
    pulled.stretch_to(small_strain, nu);
    const std::optional<Window> core =
        core_window(sample.state, axis_, core_ ? sample.model.nominal_length : 0.0, thickness_);
    // Nominal stress is force over section; the section of a core sample follows from what its core carries.
    const double section = core_ ? pulled.force() / pulled.mean_stress(*core, solid_fraction(packing_))[axis_] : area_;
    return pulled.largest_force() / section;
}

}  // namespace grainfrac
