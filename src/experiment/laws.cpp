// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/laws.h"

#include "experiment/lattice_stiffness.h"

#include <fmt/format.h>

#include <cmath>

namespace grainfrac {

namespace {

/// A rigid wall is stiffer than the grains it meets by this factor: it must not add compliance to the specimen.
constexpr double wall_stiffness_factor = 10.0;

/// How closely a word names a group: 3 its name, 2 its family, 1 its material, 0 anything, -1 not at all.
int closeness(const std::string& word, const Model& model, int group)
{
    const Group& g = model.groups[static_cast<std::size_t>(group)];
    if (word == g.name) return 3;
    const bool family = word == "platen" || word == "roller";
    if (family && g.is_wall && g.name.rfind(word + "_", 0) == 0) return 2;
    if (g.material >= 0 && word == model.materials[static_cast<std::size_t>(g.material)].name) return 1;
    return word == "*" ? 0 : -1;
}

QuadratureRule rule_named(const std::string& word)
{
    using enum QuadratureRule;
    static const std::vector<std::pair<std::string, QuadratureRule>> names = {
        {"auto", automatic},    {"cross", cross},       {"fan3", fan3},         {"fan7", fan7},
        {"gauss2", gauss2},     {"gauss3", gauss3},     {"gauss4", gauss4},     {"gauss6", gauss6},
        {"gauss8", gauss8},     {"lobatto3", lobatto3}, {"lobatto4", lobatto4}, {"lobatto5", lobatto5},
        {"lobatto6", lobatto6}, {"lobatto8", lobatto8}};
    for (const auto& [name, rule] : names) {
        if (name == word) return rule;
    }
    throw std::logic_error("quadrature rule " + word + " passed the input check");
}

InterfaceLaw interface_law(const BondSpec& s)
{
    InterfaceLaw l{};
    l.tensile_strength = s.tensile_strength;
    l.cohesion = s.cohesion;
    l.friction = s.friction;
    l.residual_friction = s.residual_friction.value_or(s.friction);
    l.residual_shear = 0.0;
    l.fracture_energy_I = s.fracture_energy_I;
    l.fracture_energy_II = s.fracture_energy_II;
    l.mixed_mode_exponent = s.mixed_mode_exponent;
    l.onset = s.onset == "quadratic" ? OnsetSurface::quadratic : OnsetSurface::mohr_coulomb;
    l.softening = s.softening == "brittle" ? Softening::brittle : Softening::bilinear;
    l.failure = s.failure == "unbreakable" ? FailureUnit::unbreakable
                                           : (s.failure == "face" ? FailureUnit::face : FailureUnit::point);
    l.mixed_mode = s.mixed_mode == "power" ? MixedMode::power : MixedMode::benzeggagh_kenane;
    return l;
}

/// Shear only, with yield and failure slip (docs/theory/pull_out.md): in the energy norm of the law the same line.
InterfaceLaw fibre_law(const BondSpec& s)
{
    InterfaceLaw l{};
    const double most = 1e300;  // neither opening nor an unset slip is a limit
    l.tensile_strength = most;
    l.cohesion = s.yield_slip ? s.shear_stiffness * *s.yield_slip : most;
    l.residual_friction = s.residual_friction.value_or(s.friction);
    l.residual_shear = s.residual_shear;
    l.fracture_energy_I = l.fracture_energy_II = s.failure_slip ? 0.5 * l.cohesion * *s.failure_slip : most;
    l.mixed_mode_exponent = 2.0;
    l.softening = s.failure_slip ? Softening::bilinear : Softening::brittle;
    l.failure = s.yield_slip ? FailureUnit::point : FailureUnit::unbreakable;
    return l;
}

ParallelLaw parallel_law(const BondSpec& s)
{
    return {s.tensile_strength,    s.cohesion,       s.friction,
            s.moment_contribution, s.law == "point", s.failure != "unbreakable"};
}

}  // namespace

int most_specific(const std::vector<std::array<std::string, 2>>& betweens, const Model& model, int group_a, int group_b)
{
    int best = -1, best_score = -1;
    for (std::size_t i = 0; i < betweens.size(); ++i) {
        const auto& [x, y] = betweens[i];
        const int xa = closeness(x, model, group_a), yb = closeness(y, model, group_b);
        const int xb = closeness(x, model, group_b), ya = closeness(y, model, group_a);
        const int score = std::max(xa >= 0 && yb >= 0 ? xa + yb : -1, xb >= 0 && ya >= 0 ? xb + ya : -1);
        if (score >= 0 && score >= best_score) {
            best_score = score;
            best = static_cast<int>(i);
        }
    }
    return best;
}

NetworkStiffness network_stiffness(const std::string& kind, double E, double nu, std::optional<double> shear_ratio)
{
    if (kind == "plane") {
        const double s =
            shear_ratio ? *shear_ratio : lattice_stiffness(Packing::honeycomb, E, nu, 1.0).value().shear_ratio;
        return {lattice_stiffness_at(Packing::honeycomb, E, s, 1.0).normal, s};
    }
    if (kind == "solid") {
        // cells fill space: the sum of k_n A h over a volume is three times k_n h
        const double s =
            shear_ratio ? *shear_ratio : lattice_stiffness(Packing::random, E, nu, 3.0).value().shear_ratio;
        return {lattice_stiffness_at(Packing::random, E, s, 3.0).normal, s};
    }
    return {E, shear_ratio.value_or(1.0)};
}

namespace {

BondRule::Kind kind_of(const Case& c, int group_a, int group_b, const std::string& law)
{
    const auto spheres = [&](int g) { return c.parts[static_cast<std::size_t>(g)].kind == "spheres"; };
    if (spheres(group_a) || spheres(group_b))
        return law == "interface" ? BondRule::Kind::fibre : BondRule::Kind::sphere;
    if (law == "interface") return BondRule::Kind::interface;
    return law == "parallel" ? BondRule::Kind::parallel : BondRule::Kind::point;
}

}  // namespace

BondTable::BondTable(const Case& c, Model& model, const std::string& made_in)
    : groups_(static_cast<int>(model.groups.size())), of_pair_(model.groups.size() * model.groups.size(), -1)
{
    std::vector<std::array<std::string, 2>> betweens;
    std::vector<int> entries;  // of [[bonds]]
    for (std::size_t i = 0; i < c.bonds.size(); ++i) {
        if (c.bonds[i].made_in != made_in) continue;
        betweens.push_back(c.bonds[i].between);
        entries.push_back(static_cast<int>(i));
    }
    for (int a = 0; a < groups_; ++a) {
        for (int b = a; b < groups_; ++b) {
            const Group& ga = model.groups[static_cast<std::size_t>(a)];
            const Group& gb = model.groups[static_cast<std::size_t>(b)];
            if (ga.is_wall || gb.is_wall) continue;
            const int closest = most_specific(betweens, model, a, b);
            if (closest < 0) continue;
            const int entry = entries[static_cast<std::size_t>(closest)];
            const BondSpec& s = c.bonds[static_cast<std::size_t>(entry)];
            const Material& ma = model.materials[static_cast<std::size_t>(ga.material)];
            const Material& mb = model.materials[static_cast<std::size_t>(gb.material)];
            const double E = 2.0 / (1.0 / ma.young_modulus + 1.0 / mb.young_modulus);
            const NetworkStiffness k =
                network_stiffness(s.elasticity, E, 0.5 * (ma.poisson_ratio + mb.poisson_ratio), s.shear_ratio);
            BondRule r;
            r.kind = kind_of(c, a, b, s.law);
            if (r.kind == BondRule::Kind::interface) {
                r.law = model.interface_laws.size();
                model.interface_laws.host().push_back(interface_law(s));
            } else if (r.kind == BondRule::Kind::fibre) {
                r.law = model.interface_laws.size();
                model.interface_laws.host().push_back(fibre_law(s));
                r.shear_stiffness = s.shear_stiffness;
            } else if (r.kind == BondRule::Kind::sphere) {
                r.law = model.sphere_bond_laws.size();
                model.sphere_bond_laws.host().push_back(
                    {parallel_law(s), s.damping, s.law == "spring" || s.form == "incremental"});
            } else {
                r.law = model.parallel_laws.size();
                model.parallel_laws.host().push_back(parallel_law(s));
            }
            r.quadrature = r.kind == BondRule::Kind::fibre ? QuadratureRule::centroid : rule_named(s.quadrature);
            r.damping = s.damping;
            r.normal_stiffness = s.normal_stiffness;
            r.modulus = k.modulus;
            r.shear_ratio = k.shear_ratio;
            r.bond_radius = s.bond_radius;
            r.weibull_modulus = s.weibull_modulus;
            r.weibull_area = s.weibull_area;
            r.weibull_scales_energy = s.weibull_scales_energy;
            r.misorientation_angle = s.misorientation_angle;
            r.misorientation_effect = s.misorientation_effect;
            const auto at = static_cast<int>(rules_.size());
            of_pair_[entry_of_pair(a, b, groups_)] = of_pair_[entry_of_pair(b, a, groups_)] = at;
            rules_.push_back(r);
            entry_.push_back(entry);
        }
    }
}

const BondRule* BondTable::rule_of(int group_a, int group_b) const
{
    const int at = of_pair_[entry_of_pair(group_a, group_b, groups_)];
    return at < 0 ? nullptr : &rules_[static_cast<std::size_t>(at)];
}

int BondTable::entry_of(const BondRule& rule) const
{
    return entry_[static_cast<std::size_t>(&rule - rules_.data())];
}

void check_snap_back(const Model& model, const State& state, const BondTable& table)
{
    struct Worst {
        double needed_I = 0.0, needed_II = 0.0;
    };
    const InterfaceBonds& f = state.interfaces;
    std::vector<Worst> worst(static_cast<std::size_t>(model.interface_laws.size()));
    std::vector<int> entry(worst.size(), -1);
    const auto made_by = [&](int i) {  // by this table, else nullptr
        const BondRule* rule = table.rule_of(state.bodies.group[f.a[i]], state.bodies.group[f.b[i]]);
        const bool own = rule != nullptr && rule->kind == BondRule::Kind::interface && rule->law == f.law[i];
        return own ? rule : nullptr;
    };
    for (int i = 0; i < f.size(); ++i) {
        const InterfaceLaw law = model.interface_laws[f.law[i]];
        const BondRule* rule = made_by(i);
        if (rule == nullptr || law.softening != Softening::bilinear || law.failure == FailureUnit::unbreakable)
            continue;
        Worst& w = worst[static_cast<std::size_t>(f.law[i])];
        const double scale = f.strength_factor[i] * f.strength_factor[i] / f.toughness_factor[i];
        w.needed_I =
            std::max(w.needed_I, scale * law.tensile_strength * law.tensile_strength / (2.0 * f.normal_stiffness[i]));
        w.needed_II = std::max(w.needed_II, scale * law.cohesion * law.cohesion / (2.0 * f.shear_stiffness[i]));
        entry[static_cast<std::size_t>(f.law[i])] = table.entry_of(*rule);
    }
    std::vector<InputProblem> problems;
    for (std::size_t l = 0; l < worst.size(); ++l) {
        const InterfaceLaw law = model.interface_laws[static_cast<int>(l)];
        const auto refuse = [&](const char* key, double found, double needed, const char* formula) {
            if (needed < found) return;
            problems.push_back({fmt::format("bonds[{}].{}", entry[l], key),
                                fmt::format("must be > {} = {:.4g} J/m^2 for the stiffest face, or the bond snaps back "
                                            "within itself; raise it, "
                                            "lower the strength, refine the grains, or set softening = \"brittle\"",
                                            formula, needed)});
        };
        if (worst[l].needed_I > 0.0)
            refuse("fracture_energy_I", law.fracture_energy_I, worst[l].needed_I, "tensile_strength^2/(2 k_n)");
        if (worst[l].needed_II > 0.0)
            refuse("fracture_energy_II", law.fracture_energy_II, worst[l].needed_II, "cohesion^2/(2 k_s)");
    }
    if (!problems.empty()) throw InputError(std::move(problems));
}

namespace {

/// Restitution of a linear spring and dashpot that cannot pull: the contact ends when the force, not the overlap, is
/// zero (Schwager and Poschel 2007, Granular Matter 9, 465).
double restitution_of(double zeta)
{
    const double root = std::sqrt(1.0 - zeta * zeta);
    const double angle = std::atan2(2.0 * zeta * root, 2.0 * zeta * zeta - 1.0);
    return std::exp(-zeta / root * angle);
}

}  // namespace

double damping_ratio_of(double restitution)
{
    double low = 0.0, high = 1.0 - 1e-12;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (restitution_of(middle) > restitution ? low : high) = middle;
    }
    return restitution >= 1.0 ? 0.0 : 0.5 * (low + high);
}

void make_contact_laws(const Case& c, const std::vector<double>& spacing, Model& model)
{
    std::vector<std::array<std::string, 2>> betweens;
    for (const ContactSpec& s : c.contacts) betweens.push_back(s.between);
    const int n = static_cast<int>(model.groups.size());
    model.contact_law_of.assign(model.groups.size() * model.groups.size(), -1);
    for (int a = 0; a < n; ++a) {
        for (int b = a; b < n; ++b) {
            const int entry = most_specific(betweens, model, a, b);
            const ContactSpec s = entry >= 0 ? c.contacts[static_cast<std::size_t>(entry)] : ContactSpec{};
            double compliance = 0.0;  // h/E of both sides, in series [m/Pa]
            int grains = 0;
            for (const int g : {a, b}) {
                const std::int32_t m = model.groups[static_cast<std::size_t>(g)].material;
                if (m < 0) continue;
                compliance +=
                    spacing[static_cast<std::size_t>(g)] / model.materials[static_cast<std::size_t>(m)].young_modulus;
                ++grains;
            }
            LinearContact law{};
            if (grains > 0) law.area_stiffness = grains * (grains == 1 ? wall_stiffness_factor : 1.0) / compliance;
            law.area_stiffness = s.normal_stiffness.value_or(law.area_stiffness);
            law.shear_ratio = s.shear_ratio;
            law.friction = s.friction;
            law.unload_factor = s.dissipation == "hysteretic" ? 1.0 / (s.restitution * s.restitution) : 1.0;
            law.damping_ratio = s.dissipation == "viscous" ? damping_ratio_of(s.restitution) : 0.0;
            model.contact_law_of[entry_of_pair(a, b, n)] = model.contact_law_of[entry_of_pair(b, a, n)] =
                model.contact_laws.size();
            model.contact_laws.host().push_back(law);
        }
    }
}

}  // namespace grainfrac
