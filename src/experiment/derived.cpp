// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/derived.h"

#include "experiment/lattice_stiffness.h"
#include "experiment/laws.h"
#include "experiment/specimen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainfrac {

namespace {

/// Sums over the bonds of a part with itself.
struct Sum {
    int number = 0;
    double k_n = 0.0, k_s = 0.0, length = 0.0, modulus = 0.0;  // modulus: k_n h
};

template <class Bonds, class Stiffness>
void add_bonds(const State& state, const Bonds& bonds, std::pair<int, int> parts, const Stiffness& stiffness, Sum& sum)
{
    const Bodies& b = state.bodies;
    for (int i = 0; i < bonds.size(); ++i) {
        if (std::minmax<int>({b.group[bonds.a[i]], b.group[bonds.b[i]]}) != parts) continue;
        const auto [k_n, k_s] = stiffness(i);
        const double length = norm(b.position[bonds.b[i]] - b.position[bonds.a[i]]);
        ++sum.number;
        sum.k_n += k_n;
        sum.k_s += k_s;
        sum.length += length;
        sum.modulus += k_n * length;
    }
}

/// Modulus and Poisson's ratio of the assembly from the mean of k_n h.
void set_elasticity(const PartSpec& part, double k_n_h, PartBonds& p)
{
    const auto set = [&](Packing packing, double normal, double density) {
        const LatticeElasticity e = lattice_elasticity(packing, {normal, p.shear_ratio}, density);
        p.young_modulus = e.young_modulus;
        p.poisson_ratio = e.poisson_ratio;
    };
    if (part.kind == "grains") {
        const bool prisms = part.generator == "hexagonal_prisms";
        return prisms ? set(Packing::honeycomb, k_n_h, 1.0) : set(Packing::random, k_n_h, 3.0);
    }
    if (part.generator == "hcp") return set(Packing::hcp, p.normal_stiffness, 1.0 / p.spacing);
    if (part.generator == "fcc") return set(Packing::fcc, p.normal_stiffness, 1.0 / p.spacing);
}

}  // namespace

PartBonds part_bonds(const Case& c, const Built& built, int part_a, int part_b)
{
    const State& s = built.state;
    const PartSpec& spec = c.parts[static_cast<std::size_t>(part_a)];
    const std::pair<int, int> parts = std::minmax({part_a, part_b});
    PartBonds p;
    std::vector<std::array<std::string, 2>> betweens;
    for (const BondSpec& b : c.bonds) betweens.push_back(b.between);
    p.entry = most_specific(betweens, built.model, part_a, part_b);
    if (p.entry < 0) return p;
    Sum sum;
    const InterfaceBonds& f = s.interfaces;
    add_bonds(
        s, f, parts, [&](int i) { return std::pair(f.normal_stiffness[i], f.shear_stiffness[i]); }, sum);
    const ParallelBonds& q = s.parallels;
    add_bonds(
        s, q, parts, [&](int i) { return std::pair(q.normal_stiffness[i], q.shear_stiffness[i]); }, sum);
    double section = 1.0;  // bonds of spheres have stiffnesses in N/m
    if (const SphereBonds& k = s.sphere_bonds; sum.number == 0) {
        double area = 0.0;
        add_bonds(
            s, k, parts,
            [&](int i) {
                const SphereBondKind& kind = k.kind_of(i);
                area += std::numbers::pi * kind.radius * kind.radius;
                return std::pair(kind.normal_stiffness, kind.shear_stiffness);
            },
            sum);
        if (sum.number > 0) section = area / sum.number;
    }
    p.number = sum.number;
    p.spacing = sum.number > 0 ? sum.length / sum.number : built.model.nominal_length;
    if (sum.number == 0) {  // made by a stage
        const BondSpec& b = c.bonds[static_cast<std::size_t>(p.entry)];
        const auto m = static_cast<std::size_t>(built.model.groups[static_cast<std::size_t>(part_a)].material);
        p.normal_stiffness = b.normal_stiffness.value_or(built.model.materials[m].young_modulus / p.spacing);
        p.shear_ratio = b.shear_ratio.value_or(1.0);
        return p;
    }
    p.shear_ratio = sum.k_s / sum.k_n;
    p.normal_stiffness = sum.k_n / sum.number;
    if (part_a == part_b) set_elasticity(spec, sum.modulus / sum.number, p);
    p.normal_stiffness /= section;
    return p;
}

std::optional<FractureScales> fracture_scales(const Case& c, const PartBonds& bonds, double E)
{
    if (bonds.entry < 0) return std::nullopt;
    const BondSpec& b = c.bonds[static_cast<std::size_t>(bonds.entry)];
    const bool softens = b.law == "interface" && b.softening == "bilinear" && b.failure != "unbreakable";
    if (!softens || !(b.fracture_energy_I > 0.0) || !(b.tensile_strength > 0.0)) return std::nullopt;
    const double G = b.fracture_energy_I, s = b.tensile_strength;
    return FractureScales{std::sqrt(E * G), E * G / (s * s), 2.0 * bonds.normal_stiffness * G / (s * s)};
}

double weakest_strength(const Case& c)
{
    double least = 0.0;
    for (const BondSpec& b : c.bonds) {
        if (b.failure == "unbreakable" || !(b.tensile_strength > 0.0)) continue;
        least = least > 0.0 ? std::min(least, b.tensile_strength) : b.tensile_strength;
    }
    return least;
}

double closing_speed(const Experiment& e)
{
    const Specimen& s = e.specimen;
    if (e.stages.empty() || s.loaded_wall < 0) return 0.0;
    const std::size_t at = e.reference_stage >= 0 ? static_cast<std::size_t>(e.reference_stage) : 0;
    const auto speed = [&](std::int32_t wall) {
        const auto& all = e.stages[at].wall_velocity;
        const auto w = static_cast<std::size_t>(wall);
        return wall >= 0 && w < all.size() ? norm(all[w]) : 0.0;
    };
    return speed(s.loaded_wall) + speed(s.opposite_wall);
}

namespace {

void add_bond_lines(const Case& c, const Built& built, int a, int b, std::vector<std::string>& lines)
{
    const PartBonds p = part_bonds(c, built, a, b);
    if (p.entry < 0) return;
    const BondSpec& spec = c.bonds[static_cast<std::size_t>(p.entry)];
    if (p.number == 0 && (spec.made_in.empty() || a != b)) return;
    const std::string &x = c.parts[static_cast<std::size_t>(a)].name, &y = c.parts[static_cast<std::size_t>(b)].name;
    const std::string who = a == b ? fmt::format("part \"{}\", bonds[{}]: ", x, p.entry)
                                   : fmt::format("parts \"{}\" and \"{}\", bonds[{}]: ", x, y, p.entry);
    std::string line = fmt::format("{}{} bonds, distance of centres {:.4g} m, k_n {:.4g} Pa/m, k_s/k_n {:.4g}", who,
                                   p.number, p.spacing, p.normal_stiffness, p.shear_ratio);
    if (spec.shear_stiffness > 0.0)  // of a fibre
        line = fmt::format("{}{} bonds, K_0 {:.4g} Pa/m", who, p.number, spec.shear_stiffness);
    if (p.young_modulus) line += fmt::format("; they imply E {:.4g} Pa, nu {:.4g}", *p.young_modulus, *p.poisson_ratio);
    lines.push_back(line);
    const Group& group = built.model.groups[static_cast<std::size_t>(a)];
    const double E = built.model.materials[static_cast<std::size_t>(group.material)].young_modulus;
    const auto f = fracture_scales(c, p, p.young_modulus.value_or(E));
    if (!f) return;
    lines.push_back(
        fmt::format("{}K_Ic sqrt(E G_I) {:.4g} Pa m^0.5, process zone E G_I/sigma_c^2 {:.4g} m ({:.3g} grains), "
                    "G_I {:.3g} times sigma_c^2/(2 k_n)",
                    who, f->toughness, f->process_zone, f->process_zone / p.spacing, f->snap_back));
}

}  // namespace

std::vector<std::string> derived_lines(const Case& c, const Built& built)
{
    std::vector<std::string> lines;
    const Model& model = built.model;
    for (const Material& m : model.materials) {
        const double c0 = std::sqrt(m.young_modulus / m.density);
        lines.push_back(fmt::format("material \"{}\": wave speed sqrt(E/rho) {:.4g} m/s, impedance {:.4g} Pa s/m",
                                    m.name, c0, m.density * c0));
    }
    const int parts = static_cast<int>(c.parts.size());
    for (int a = 0; a < parts; ++a) {
        for (int b = a; b < parts; ++b) add_bond_lines(c, built, a, b, lines);
    }
    for (const MaterialSpec& m : c.materials) {
        if (m.cleavage.planes.empty()) continue;
        for (std::size_t g = 0; g < built.cleavage.size(); ++g) {
            if (c.parts[g].material != m.name) continue;
            for (std::size_t f = 0; f < built.cleavage[g].families.size(); ++f) {
                const CleavageLaw& law = built.cleavage[g].families[f].law;
                lines.push_back(
                    fmt::format("part \"{}\", planes {}: split at {:.4g} Pa across a wide plane, G_c {:.4g} "
                                "J/m^2",
                                c.parts[g].name, m.cleavage.planes[f], law.threshold_stress(), law.fracture_energy));
            }
        }
    }
    const double speed = closing_speed(built.experiment), strength = weakest_strength(c);
    const double length = built.experiment.specimen.length, c0 = built.experiment.wave_speed;
    if (speed > 0.0 && strength > 0.0 && length > 0.0 && c0 > 0.0) {
        const double time = strength / loaded_material(model).young_modulus * length / speed;
        lines.push_back(
            fmt::format("loading: closing speed {:.4g} m/s, strain rate {:.4g} 1/s; stress sigma_c = {:.4g} Pa "
                        "takes at least {:.3g} s, {:.3g} passages of a wave",
                        speed, speed / length, strength, time, time * c0 / length));
    }
    return lines;
}

}  // namespace grainfrac
