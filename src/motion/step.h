// SPDX-License-Identifier: GPL-3.0-or-later
// One time step, every stage by name.
#pragma once

#include "model/model.h"
#include "model/state.h"

namespace grainfrac {

/// Forces at the present positions without moving: neighbour list, slots, resultants, E_0 of the ledger. Call once
/// before the first step.
void start(const Model& model, State& state);

/// Advance by dt. `want_stress`: fill the dyads of the slots for grain_stress().
void step(const Model& model, State& state, double dt, bool want_stress = false);

}  // namespace grainfrac
