// SPDX-License-Identifier: GPL-3.0-or-later
// Fragments: grains that bonds still hold together.
#pragma once

#include "model/state.h"

#include <cstdint>
#include <vector>

namespace grainfrac {

/// Bonded component of each body, numbered from the heaviest (0) down, ties by lowest id; -1 for driven bodies. A bond
/// holds until its last point has failed.
std::vector<std::int32_t> bonded_clusters(const State& state);

}  // namespace grainfrac
