// SPDX-License-Identifier: GPL-3.0-or-later
// Dense packings without order (docs/theory/packings.md).
#pragma once

#include "generate/sphere_region.h"

#include <cstdint>
#include <vector>

namespace grainfrac {

/// Solid fraction of random close packing of spheres whose diameters are uniform between d and `size_ratio` d, far from
/// walls: 0.634 + 0.0658 delta, delta their standard deviation over their mean (Desmond and Weeks 2014).
double densest_random_packing(double size_ratio);

}  // namespace grainfrac
