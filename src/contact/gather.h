// SPDX-License-Identifier: GPL-3.0-or-later
// Slots onto bodies, in a fixed order.
#pragma once

#include "model/model.h"
#include "model/state.h"

#include <vector>

namespace grainfrac {

/// Bodies::force and ::torque from all slots, and gravity.
void gather_forces(const Model& model, State& state);
/// The same for some bodies, on the host.
void gather_forces(const Model& model, State& state, const std::vector<int>& bodies);

/// Which interactions act on which body; after every change of bonds or pairs.
void build_incidence(State& state);

}  // namespace grainfrac
