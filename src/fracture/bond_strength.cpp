// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/bond_strength.h"

#include "fracture/bond_forces.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace grainfrac {

namespace {

/// The moment from the slots is that of the law but for rounding, so that the bond breaks at this much less strength.
constexpr double least_less = 1e-12;

/// Share of its strength at which something breaks, if above `share`; else `share`.
template <class BreaksAt>
double largest_share(double share, const BreaksAt& breaks_at)
{
    if (!breaks_at(std::max(share, 1e-300))) return share;
    double low = std::max(share, 1e-300), high = low;
    while (breaks_at(high)) {
        low = high;
        high *= 16.0;
    }
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (breaks_at(middle) ? low : high) = middle;
    }
    return low;
}

}  // namespace

MostUsedBond most_used_bond(const Model& model, const State& state)
{
    MostUsedBond most;
    const Slots& s = state.slots;
    const SphereBonds& p = state.sphere_bonds;
    for (int i = 0; i < p.size(); ++i) {
        const ParallelLaw law = model.sphere_bond_laws[p.law[i]].strength;
        if (!law.breakable || p.cause[i] != static_cast<int>(BondCause::whole)) continue;
        const int slot = state.first_sphere_slot() + i;
        const Vec3 branch = state.bodies.position[p.b[i]] - state.bodies.position[p.a[i]], e = normalized(branch);
        const Vec3 F = s.force[slot], M = s.torque_b[slot] + cross((1.0 - p.kind_of(i).share) * branch, F);
        const double share = largest_share(most.share, [&](double strength) {
            return law.broken(-F, -M, e, p.kind_of(i).radius, strength * p.strength_factor[i]) != BondCause::whole;
        });
        if (share > most.share) most = {i, share};
    }
    return most;
}

void break_bond(const Model& model, State& state, const MostUsedBond& most)
{
    SphereBonds& p = state.sphere_bonds;
    const double factor = p.strength_factor[most.bond];
    const auto is_whole = [&] { return p.cause[most.bond] == static_cast<int>(BondCause::whole); };
    for (double less = least_less; is_whole() && less < 1.0; less *= 10.0) {
        p.strength_factor.at(most.bond) = (1.0 - less) * most.share * factor;
        bond_forces(model, state, {}, {}, {most.bond});
    }
    p.strength_factor.at(most.bond) = factor;
    if (is_whole()) throw std::logic_error("break_bond: bond " + std::to_string(most.bond) + " does not break");
}

HeldBonds::HeldBonds(Model& model) : model_(model), laws_(model.sphere_bond_laws.host())
{
    for (SphereBondLaw& law : model.sphere_bond_laws.host()) law.strength.breakable = false;
}

HeldBonds::~HeldBonds()
{
    model_.sphere_bond_laws.host() = laws_;
}

}  // namespace grainfrac
