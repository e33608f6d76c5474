// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/cleavage_rules.h"

#include "generate/crystal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

constexpr double default_residual_friction = 0.4;

CleavageLaw cleavage_law(const CleavageSpec& s, const MaterialSpec& m, double toughness)
{
    CleavageLaw l;
    l.toughness = toughness;
    l.mode_ratio = s.mode_ratio;
    l.flaw_size = s.flaw_size;
    l.friction = s.friction;
    l.poisson_ratio = m.poisson_ratio;
    l.young_modulus = m.young_modulus;
    // Irwin: initiation and propagation ask for the same energy (14.7)
    l.fracture_energy = toughness * toughness * (1.0 - m.poisson_ratio * m.poisson_ratio) / m.young_modulus;
    l.flaw = s.flaw == "edge" ? FlawShape::edge : s.flaw == "penny" ? FlawShape::penny : FlawShape::through;
    l.criterion = s.criterion == "shetty"   ? CleavageCriterion::shetty
                  : s.criterion == "energy" ? CleavageCriterion::energy
                                            : CleavageCriterion::ellipse;
    l.finite_width = s.finite_width;
    return l;
}

/// The new surface starts to soften from the traction that it inherits; the onset surface serves points that start
/// pressed and unsheared. A surface that is there from the start has to say itself when it softens: at the ellipse in
/// tension, at C sigma_th plus the friction of closed flaws under pressure (which stands for the other criteria too).
InterfaceLaw surface_law(const CleavageSpec& s, const CleavageLaw& c)
{
    InterfaceLaw l{};
    l.tensile_strength = c.threshold_stress();
    l.friction = l.residual_friction = s.residual_friction.value_or(default_residual_friction);
    l.cohesion = std::max(s.mode_ratio, l.friction) * l.tensile_strength;
    l.onset = OnsetSurface::mohr_coulomb;
    if (s.new_surface == "pre_cut") {
        l.onset = OnsetSurface::quadratic;
        l.cohesion = s.mode_ratio * l.tensile_strength;
        l.friction = s.friction;
        l.residual_friction = std::min(l.residual_friction, s.friction);  // else damage could release energy
    }
    l.fracture_energy_I = s.fracture_energy.value_or(c.fracture_energy);
    l.fracture_energy_II = s.fracture_energy_II.value_or(l.fracture_energy_I / (s.mode_ratio * s.mode_ratio));
    l.mixed_mode_exponent = 2.0;
    l.softening = Softening::bilinear;
    l.failure = FailureUnit::point;
    l.mixed_mode = MixedMode::benzeggagh_kenane;
    return l;
}

/// A new surface holds t^2/2k that no work put there (14.5). Stiff enough that this is at most a tenth of what the
/// surface costs where it opens at the threshold stress, and no softer than the grains.
double surface_stiffness(double of_grain, const CleavageLaw& c, const InterfaceLaw& surface)
{
    const double t = c.threshold_stress();
    return std::max(of_grain, 5.0 * t * t / surface.fracture_energy_I);
}

/// What a split along planes of this law makes.
SplitRules split_rules(const CleavageSpec& s, const CleavageLaw& c, double grain_stiffness, Model& model)
{
    SplitRules r;
    const InterfaceLaw surface = surface_law(s, c);
    r.cohesive = s.new_surface != "free";
    r.law = model.interface_laws.size();
    model.interface_laws.host().push_back(surface);
    r.normal_stiffness = s.normal_stiffness.value_or(surface_stiffness(grain_stiffness, c, surface));
    r.shear_stiffness = r.normal_stiffness;
    r.damping = s.damping;
    r.least_volume = s.min_fragment_volume;
    r.least_section = s.min_section;
    r.least_inradius = s.min_inradius;
    r.most_generations = static_cast<std::int32_t>(s.max_generation);
    return r;
}

/// Refusals are remembered by plane; a plane that is an interface from the start must not snap back within itself.
void check_planes(const MaterialSpec& m, const CleavageRules& r, const Model& model)
{
    std::size_t count = 0;
    for (const CleavageFamily& f : r.families) {
        count += f.planes.size();
        const InterfaceLaw law = model.interface_laws[f.split.law];
        const double t = law.tensile_strength, needed = t * t / (2.0 * law.fracture_energy_I);
        if (m.cleavage.new_surface == "pre_cut" && f.split.normal_stiffness <= needed) {
            throw InputError(
                fmt::format("materials.{}.cleavage.normal_stiffness", m.name),
                fmt::format("must be > {:.4g} Pa/m, sigma_th^2/(2 G_I), with new_surface = \"pre_cut\", or "
                            "the plane snaps back within itself",
                            needed));
        }
    }
    if (count > most_candidates) {
        throw InputError(fmt::format("materials.{}.cleavage.planes", m.name),
                         fmt::format("name {} planes of a grain; must be {} or fewer", count, most_candidates));
    }
}

/// The gate serves the planes that split most easily.
CleavageGate gate_of(const CleavageSpec& s, const CleavageLaw& l)
{
    CleavageGate g;
    g.kind = s.gate == "none"          ? CleavageGate::Kind::none
             : s.gate == "hydrostatic" ? CleavageGate::Kind::hydrostatic
                                       : CleavageGate::Kind::principal_and_shear;
    g.tension_threshold = l.threshold_stress();
    g.shear_threshold = s.mode_ratio * l.threshold_stress();
    g.hydrostatic_threshold = s.hydrostatic_threshold;
    return g;
}

}  // namespace

std::vector<CleavageRules> make_cleavage_rules(const Case& c, const std::vector<double>& spacing, Model& model)
{
    std::vector<CleavageRules> rules(model.groups.size());
    for (std::size_t g = 0; g < c.parts.size(); ++g) {
        const PartSpec& part = c.parts[g];
        const MaterialSpec& m = *std::find_if(c.materials.begin(), c.materials.end(),
                                              [&](const MaterialSpec& x) { return x.name == part.material; });
        const CleavageSpec& s = m.cleavage;
        if (s.planes.empty()) continue;
        CleavageRules& r = rules[g];
        const double crack = s.flaw == "edge" ? s.flaw_size : 2.0 * s.flaw_size;
        if (crack >= spacing[g]) {
            throw InputError(fmt::format("materials.{}.cleavage.flaw_size", m.name),
                             fmt::format("must be < {:.6g} m: the flaw would be longer than the ball that fits in a "
                                         "grain of \"{}\" is wide",
                                         spacing[g] * s.flaw_size / crack, part.name));
        }
        const double side = s.slabs && part.generator == "hexagonal_prisms" ? part.side : 0.0;
        for (std::size_t k = 0; k < s.planes.size(); ++k) {
            const CleavageLaw law = cleavage_law(s, m, s.toughness.size() == 1 ? s.toughness[0] : s.toughness[k]);
            r.families.push_back({law, cleavage_planes(parse_crystal_planes(s.planes[k]), side),
                                  split_rules(s, law, m.young_modulus / spacing[g], model)});
        }
        check_planes(m, r, model);
        r.gate = gate_of(s, cleavage_law(s, m, *std::min_element(s.toughness.begin(), s.toughness.end())));
        r.surface_flaws = s.flaw_site == "surface";
        r.pause = spacing[g] / std::sqrt(m.young_modulus / m.density);
    }
    return rules;
}

}  // namespace grainfrac
