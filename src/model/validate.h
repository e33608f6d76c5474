// SPDX-License-Identifier: GPL-3.0-or-later
// Is this state possible? After building, before every checkpoint, and when an energy is not finite.
#pragma once

#include "model/model.h"
#include "model/state.h"

#include <cstdint>
#include <string>

namespace grainfrac {

/// What is impossible about the state (non-finite numbers, orientations off unit length, dead indices, bonds that are
/// not sorted, damage out of range), naming the entity; empty if nothing is.
std::string why_not_valid(const Model& model, const State& state);

/// 64-bit FNV-1a over positions, orientations, velocities, angular momenta, damage, slip and contact histories: two
/// runs with equal hashes have the same bits.
std::uint64_t state_hash(const State& state);

}  // namespace grainfrac
