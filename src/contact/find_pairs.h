// SPDX-License-Identifier: GPL-3.0-or-later
// Broad phase: the neighbour list, kept until something moved far.
#pragma once

#include "model/model.h"
#include "model/state.h"

namespace grainfrac {

/// True once any surface point may have used up half the skin. Advances State::travel by the motion over dt.
bool pairs_are_stale(const Model& model, State& state, double dt);

/// All pairs whose dilated boxes, grown by half the skin, overlap; two driven bodies are no pair. Histories of pairs
/// that stay are kept, energies of those that go are added to State::past_contacts. Rebuilds the incidence.
void find_pairs(const Model& model, State& state);

}  // namespace grainfrac
