// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/sphere_bonds.h"

#include "experiment/lattice_stiffness.h"
#include "experiment/specimen.h"
#include "model/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace grainfrac {

namespace {

/// A pair of spheres with its rule; radius of the bond's section.
struct Candidate {
    int x = 0, y = 0;  // in the list of spheres
    const BondRule* rule = nullptr;
    double radius = 0.0, length = 0.0;
    bool in_chain = false;
};

const PartSpec& part_of(const Case& c, const SphereSpec& s)
{
    return c.parts[static_cast<std::size_t>(s.group)];
}

/// The part whose packing a sphere lies in: of spheres that were taken, the one that they come from.
const PartSpec& packed_part(const Case& c, const SphereSpec& s)
{
    const PartSpec* p = &part_of(c, s);
    while (p->generator == "taken") {
        p = &*std::find_if(c.parts.begin(), c.parts.end(), [&](const PartSpec& q) { return q.name == p->inside; });
    }
    return *p;
}

double section_of(const SphereSpec& s)
{
    return s.section_radius > 0.0 ? s.section_radius : s.radius;
}

std::vector<Candidate> candidates(const Case& c, const std::vector<SphereSpec>& spheres, const BondTable& table)
{
    const auto rule_of = [&](const SphereSpec& x, const SphereSpec& y) -> const BondRule* {
        const BondRule* r = table.rule_of(x.group, y.group);
        return r != nullptr && r->kind == BondRule::Kind::sphere ? r : nullptr;
    };
    std::vector<Candidate> found;
    const auto add = [&](int i, int j, bool in_chain) {
        const SphereSpec &x = spheres[static_cast<std::size_t>(i)], &y = spheres[static_cast<std::size_t>(j)];
        const BondRule* rule = rule_of(x, y);
        if (rule == nullptr) return;
        const double radius = rule->bond_radius.value_or(0.5 * (section_of(x) + section_of(y)));
        found.push_back({i, j, rule, radius, norm(y.position - x.position), in_chain});
    };
    double widest = 0.0;
    for (const BondSpec& b : c.bonds) widest = std::max(widest, b.gap_factor);
    for (const auto& [i, j] : touching_spheres(spheres, widest)) {
        const SphereSpec &x = spheres[static_cast<std::size_t>(i)], &y = spheres[static_cast<std::size_t>(j)];
        const BondRule* rule = rule_of(x, y);
        if (rule == nullptr || (x.chain >= 0 && x.chain == y.chain)) continue;
        const double gap = c.bonds[static_cast<std::size_t>(table.entry_of(*rule))].gap_factor;
        if (norm(y.position - x.position) <= (1.0 + gap) * (x.radius + y.radius)) add(i, j, false);
    }
    for (int i = 0; i + 1 < static_cast<int>(spheres.size()); ++i) {
        const int chain = spheres[static_cast<std::size_t>(i)].chain;
        if (chain >= 0 && spheres[static_cast<std::size_t>(i) + 1].chain == chain) add(i, i + 1, true);
    }
    std::sort(found.begin(), found.end(), [](const Candidate& p, const Candidate& q) {
        return std::pair{p.x, p.y} < std::pair{q.x, q.y};
    });
    return found;
}

Packing packing_of(const PartSpec& part)
{
    return part.generator == "hcp" ? Packing::hcp : (part.generator == "fcc" ? Packing::fcc : Packing::random);
}

double region_volume(const RegionSpec& r)
{
    if (r.shape == "sphere") return std::numbers::pi / 6.0 * r.diameter * r.diameter * r.diameter;
    if (r.shape == "cylinder" || r.shape == "disc") return 0.25 * std::numbers::pi * r.diameter * r.diameter * r.height;
    return r.size.x * r.size.y * r.size.z;
}

/// K_n and K_s/K_n of "auto", for the bonds of one rule.
struct AutoStiffness {
    double normal = 0.0;   // K_n of a bond whose section is `section` [N/m]
    double section = 0.0;  // [m^2]
    double shear_ratio = 1.0;
};

class Stiffener {
public:
    Stiffener(const Case& c, const Model& model, const std::vector<SphereSpec>& spheres, const BondTable& table,
              const std::vector<Candidate>& all)
        : c_(c), model_(model), spheres_(spheres), table_(table), all_(all)
    {
    }

    BondSprings springs(const Candidate& p)
    {
        const BondSpec& spec = c_.bonds[static_cast<std::size_t>(table_.entry_of(*p.rule))];
        const bool moments = spec.law != "spring";
        if (p.in_chain) return chain_springs(spec, p, moments);
        double k_n = 0.0, ratio = 1.0;
        if (spec.normal_stiffness && spec.shear_ratio) {
            k_n = *spec.normal_stiffness;
            ratio = *spec.shear_ratio;
        } else {
            const AutoStiffness& a = of_rule(spec, p);
            k_n = spec.normal_stiffness.value_or(a.normal / a.section);
            ratio = a.shear_ratio;
        }
        return circular_bond(k_n, k_n * ratio, p.radius, moments);
    }

private:
    const Material& material(int i) const
    {
        return model_.materials[static_cast<std::size_t>(spheres_[static_cast<std::size_t>(i)].material)];
    }

    /// A bar of the section: EA/h, EI/h, GJ/h; K_s so that the nodes follow a Timoshenko beam exactly, 1/(h K_s) =
    /// h^2/(6 EI) + 1/(kappa G A) with kappa = 6 (1 + nu)/(7 + 6 nu) (Cowper 1966).
    BondSprings chain_springs(const BondSpec& spec, const Candidate& p, bool moments) const
    {
        const Material &x = material(p.x), &y = material(p.y);
        const double E = 2.0 / (1.0 / x.young_modulus + 1.0 / y.young_modulus),
                     nu = 0.5 * (x.poisson_ratio + y.poisson_ratio), h = p.length;
        const CircularSection s(p.radius);
        const double k_n = spec.normal_stiffness.value_or(E / h), modulus = k_n * h, G = modulus / (2.0 * (1.0 + nu));
        if (spec.shear_ratio) return circular_bond(k_n, k_n * *spec.shear_ratio, p.radius, moments);
        const double kappa = 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu);
        const double flexible = h * h / (6.0 * modulus * s.bending) + 1.0 / (kappa * G * s.area);
        return {k_n * s.area, 1.0 / (h * flexible), moments ? k_n * s.bending : 0.0, moments ? G * s.polar / h : 0.0};
    }

    const AutoStiffness& of_rule(const BondSpec& spec, const Candidate& p)
    {
        const auto found = of_rule_.find(p.rule);
        if (found != of_rule_.end()) return found->second;
        const Material &x = material(p.x), &y = material(p.y);
        const double E = 2.0 / (1.0 / x.young_modulus + 1.0 / y.young_modulus),
                     nu = 0.5 * (x.poisson_ratio + y.poisson_ratio);
        const PartSpec& part = packed_part(c_, spheres_[static_cast<std::size_t>(p.x)]);
        const Packing packing = packing_of(part);
        AutoStiffness a;
        a.section = CircularSection(p.radius).area;
        const double density =
            packing == Packing::random ? bond_density(spec, part, p, a.section) : 1.0 / part.diameter;
        const std::string key = fmt::format("bonds[{}].", table_.entry_of(*p.rule));
        LatticeStiffness k{};
        if (spec.shear_ratio) {
            k = lattice_stiffness_at(packing, E, *spec.shear_ratio, density);
        } else if (const auto fit = lattice_stiffness(packing, E, nu, density)) {
            k = *fit;
        } else {
            throw InputError(
                key + "shear_ratio",
                fmt::format("\"auto\" needs poisson_ratio <= {:.3g} for springs in this packing, found {:.3g}; give "
                            "shear_ratio (0: the largest ratio)",
                            largest_poisson_ratio(packing), nu));
        }
        a.normal = k.normal * fibre_share(c_, p);
        a.shear_ratio = k.shear_ratio;
        return of_rule_.emplace(p.rule, a).first->second;
    }

    /// Sum of w l^2 over the bonds of the packing, w their section over `section`, over its volume [1/m].
    double bond_density(const BondSpec& spec, const PartSpec& part, const Candidate& p, double section) const
    {
        const bool no_region = part.region.diameter == 0.0 && norm2(part.region.size) == 0.0;
        if (no_region) {
            const char* key = spec.normal_stiffness ? "shear_ratio" : "normal_stiffness";
            throw InputError(fmt::format("bonds[{}].{}", table_.entry_of(*p.rule), key),
                             "\"auto\" needs the region that the spheres fill; give a value, or the part's region");
        }
        double sum = 0.0;
        for (const Candidate& q : all_) {
            if (&packed_part(c_, spheres_[static_cast<std::size_t>(q.x)]) == &part)
                sum += CircularSection(q.radius).area / section * q.length * q.length;
        }
        return sum / region_volume(part.region);
    }

    /// Spheres of a lattice that stand for a fibre fill more or less than its section: pi a^2 L over their cells.
    double fibre_share(const Case& c, const Candidate& p) const
    {
        const SphereSpec &x = spheres_[static_cast<std::size_t>(p.x)], &y = spheres_[static_cast<std::size_t>(p.y)];
        const PartSpec& part = part_of(c, x);
        if (x.group != y.group || part.generator != "taken" || packing_of(packed_part(c, x)) == Packing::random)
            return 1.0;
        const auto n =
            std::count_if(spheres_.begin(), spheres_.end(), [&](const SphereSpec& s) { return s.group == x.group; });
        const double d = 2.0 * x.radius;
        return region_volume(part.region) * std::sqrt(2.0) / (static_cast<double>(n) * d * d * d);
    }

    const Case& c_;
    const Model& model_;
    const std::vector<SphereSpec>& spheres_;
    const BondTable& table_;
    const std::vector<Candidate>& all_;
    std::map<const BondRule*, AutoStiffness> of_rule_;
};

}  // namespace

void bond_spheres(const Case& c, Model& model, State& state, const std::vector<SphereSpec>& spheres, int first_body,
                  const BondTable& table)
{
    const std::vector<Candidate> pairs = candidates(c, spheres, table);
    Stiffener stiffener(c, model, spheres, table, pairs);
    std::map<const BondRule*, std::pair<double, int>> sections;
    for (const Candidate& p : pairs) {
        sections[p.rule].first += CircularSection(p.radius).area;
        sections[p.rule].second += 1;
    }
    for (const Candidate& p : pairs) {
        SpherePair bond{first_body + p.x, first_body + p.y, p.radius, stiffener.springs(p), p.rule->law, 1.0};
        if (p.rule->weibull_modulus) {
            const auto& [sum, count] = sections[p.rule];
            const double u = uniform_random(c.simulation.seed, RandomPurpose::strength,
                                            static_cast<std::uint32_t>(bond.a), static_cast<std::uint32_t>(bond.b));
            bond.strength = weibull_factor(u, *p.rule->weibull_modulus, CircularSection(p.radius).area,
                                           p.rule->weibull_area.value_or(sum / count));
        }
        add_sphere_bond(model, state, bond);
    }
}

}  // namespace grainfrac
