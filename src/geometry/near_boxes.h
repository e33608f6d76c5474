// SPDX-License-Identifier: GPL-3.0-or-later
// Which axis-aligned boxes overlap.
#pragma once

#include "geometry/vec3.h"

#include <utility>
#include <vector>

namespace grainfrac {

struct Box {
    Vec3 low, high;
};

/// Overlapping boxes by a hashed grid; boxes wider than four times the median against all. Pairs of indices (i < j),
/// sorted.
std::vector<std::pair<int, int>> overlapping_boxes(const std::vector<Box>& boxes);

}  // namespace grainfrac
