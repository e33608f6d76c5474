// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/pre_cut.h"

#include "geometry/cut.h"
#include "geometry/mass_properties.h"

#include <algorithm>
#include <utility>

namespace grainfrac {

namespace {

/// Corners are points of the rule: the worst flaw of a linear field sits at one.
constexpr QuadratureRule with_corners = QuadratureRule::lobatto4;

BondRule rule_of(const SplitRules& s, bool surface_flaws)
{
    BondRule r;
    r.law = s.law;
    r.quadrature = surface_flaws ? with_corners : QuadratureRule::automatic;
    r.damping = s.damping;
    r.normal_stiffness = s.normal_stiffness;
    r.shear_ratio = s.shear_stiffness / s.normal_stiffness;
    return r;
}

/// `pieces` of one grain, each cut by the plane where the limits allow it. True if one was.
bool cut_all(std::vector<Polyhedron>& pieces, const Plane& plane, double radius, double volume, const SplitRules& rules)
{
    std::vector<Polyhedron> next;
    for (Polyhedron& p : pieces) {
        CutResult parts = cut(p, plane);
        if (why_not_parted(p, parts, radius, volume, rules) == SplitStatus::done) {
            next.push_back(std::move(parts.inside));
            next.push_back(std::move(parts.outside));
        } else {
            next.push_back(std::move(p));
        }
    }
    const bool any = next.size() > pieces.size();
    pieces = std::move(next);
    return any;
}

}  // namespace

PreCut::PreCut(const Case& c, std::vector<CleavageRules>& rules, std::vector<GrainSpec>& grains)
{
    std::vector<char> concerned(rules.size(), 0);
    std::vector<std::size_t> first_family(rules.size(), 0);
    for (std::size_t g = 0; g < c.parts.size() && g < rules.size(); ++g) {
        for (const MaterialSpec& m : c.materials) {
            if (m.name == c.parts[g].material && m.cleavage.new_surface == "pre_cut") concerned[g] = 1;
        }
        if (concerned[g] == 0) continue;
        first_family[g] = families_.size();
        for (const CleavageFamily& f : rules[g].families)
            families_.push_back({f.law, grainfrac::rule_of(f.split, rules[g].surface_flaws)});
    }
    if (families_.empty()) return;

    std::vector<GrainSpec> pieces;
    for (const GrainSpec& grain : grains) {
        const auto g = static_cast<std::size_t>(grain.group);
        if (g >= rules.size() || concerned[g] == 0) {
            pieces.push_back(grain);
            pieces_.push_back({});
            continue;
        }
        const MassProperties whole = mass_properties(grain.shape);
        std::vector<Polyhedron> parts{grain.shape};
        std::vector<Cut> cuts;
        for (std::size_t f = 0; f < rules[g].families.size(); ++f) {
            for (const Plane& p : rules[g].families[f].planes) {
                const Vec3 n = rotate(grain.crystal, p.normal);
                const Plane plane{n, p.offset + dot(n, whole.centroid)};
                if (cut_all(parts, plane, grain.dilation_radius, whole.volume, rules[g].families[f].split))
                    cuts.push_back({plane, first_family[g] + f});
            }
        }
        const auto origin = static_cast<std::int32_t>(cuts_.size()), first = static_cast<std::int32_t>(pieces.size());
        cuts_.push_back(std::move(cuts));
        for (Polyhedron& part : parts) {
            pieces_.push_back({origin, mass_properties(part).centroid});
            pieces.push_back(grain);
            pieces.back().shape = std::move(part);
            pieces.back().origin = first;
        }
    }
    grains = std::move(pieces);
    for (std::size_t g = 0; g < rules.size(); ++g) {
        if (concerned[g] != 0) rules[g].families.clear();
    }
    if (std::all_of(rules.begin(), rules.end(), [](const CleavageRules& r) { return r.families.empty(); }))
        rules.clear();
}

const BondRule* PreCut::rule_of(int a, int b) const
{
    if (families_.empty()) return nullptr;
    const Piece &x = pieces_[static_cast<std::size_t>(a)], &y = pieces_[static_cast<std::size_t>(b)];
    if (x.origin < 0 || x.origin != y.origin) return nullptr;
    for (const Cut& cut : cuts_[static_cast<std::size_t>(x.origin)]) {
        const double d = cut.plane.offset;
        if ((dot(cut.plane.normal, x.center) > d) != (dot(cut.plane.normal, y.center) > d))
            return &families_[cut.family].rule;
    }
    return nullptr;
}

void PreCut::finish(State& state) const
{
    InterfaceBonds& f = state.interfaces;
    for (int i = 0; i < f.size(); ++i) {
        const BondRule* rule = families_.empty() ? nullptr : rule_of(f.a[i], f.b[i]);
        if (rule == nullptr) continue;
        const auto is_it = [&](const Family& family) { return &family.rule == rule; };
        const CleavageLaw& law = std::find_if(families_.begin(), families_.end(), is_it)->law;
        std::vector<Vec3> corners;
        for (int k = f.corner_begin[i]; k < f.corner_begin[i + 1]; ++k) corners.push_back(state.corners.position_a[k]);
        const double width = least_width(corners.data(), static_cast<int>(corners.size()), f.normal_a[i]);
        f.transgranular.host()[static_cast<std::size_t>(i)] = 1;
        f.strength_factor.host()[static_cast<std::size_t>(i)] = 1.0 / law.width_factor(width);
    }
}

}  // namespace grainfrac
