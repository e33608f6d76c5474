// SPDX-License-Identifier: GPL-3.0-or-later
// Damage in events instead of in steps: how far a state at rest is from the next damage, and a chosen amount of it at
// once. For the quasi-static path of what softens (experiment/pull_out_path.h).
#pragma once

#include "model/model.h"
#include "model/state.h"

#include <vector>

namespace grainfrac {

/// Factor on the present jumps at which the first point of these interfaces would soften; 0 if none can. Law points
/// only: faces that fail as a whole never soften.
double factor_to_softening(const Model& model, const State& state, const std::vector<int>& interfaces);

/// Mean damage over the area of the interfaces [-].
double mean_damage(const State& state, const std::vector<int>& interfaces);
/// What it would be with the present jumps times `reach`.
double mean_damage_at(const Model& model, const State& state, const std::vector<int>& interfaces, double reach);

/// The damage that the present jumps times `reach` cause. What the points release at the present jumps and the law
/// does not count as fracture energy goes to inserted work, so that the account closes. Call bond_forces afterwards.
void soften(const Model& model, State& state, const std::vector<int>& interfaces, double reach);

}  // namespace grainfrac
