// SPDX-License-Identifier: GPL-3.0-or-later
// How much of its strength a bond of spheres bears, and breaking one of them at rest: for rows of equilibria, in which
// one bond breaks after the other, the most loaded first.
#pragma once

#include "model/model.h"
#include "model/state.h"

#include <vector>

namespace grainfrac {

struct MostUsedBond {
    int bond = -1;       ///< of State::sphere_bonds; -1: none can break
    double share = 0.0;  ///< of its strength [-]
};
/// Of the bonds that are whole, by the forces in their slots.
MostUsedBond most_used_bond(const Model& model, const State& state);

/// Breaks it under the force that it bears, as if its strength were that or, for rounding, a trace less; the next step
/// finds it broken. The model must let bonds break.
void break_bond(const Model& model, State& state, const MostUsedBond& most);

/// No bond of spheres breaks as long as this is there.
class HeldBonds {
public:
    explicit HeldBonds(Model& model);
    ~HeldBonds();
    HeldBonds(const HeldBonds&) = delete;
    HeldBonds& operator=(const HeldBonds&) = delete;

private:
    Model& model_;
    std::vector<SphereBondLaw> laws_;
};

}  // namespace grainfrac
