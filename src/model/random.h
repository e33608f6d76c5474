// SPDX-License-Identifier: GPL-3.0-or-later
// Counter-based random numbers (Philox 4x32-10, Salmon et al. 2011), keyed by seed, purpose and entity: no draw depends
// on the order in which others are made.
#pragma once

#include "geometry/quat.h"

#include <cstdint>

namespace grainfrac {

enum class RandomPurpose : std::uint32_t { orientation = 1, strength = 2, test = 3, packing = 4 };

/// Uniform in (0, 1), never 0 or 1. `draw` numbers several draws of one entity.
double uniform_random(std::int64_t seed, RandomPurpose purpose, std::uint32_t entity_a, std::uint32_t entity_b = 0,
                      int draw = 0);

/// Rotation uniform on SO(3) (Shoemake 1992).
Quat uniform_rotation(std::int64_t seed, RandomPurpose purpose, std::uint32_t entity);

}  // namespace grainfrac
