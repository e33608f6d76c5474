// SPDX-License-Identifier: GPL-3.0-or-later
// Dense packings without order, by removal of overlaps (docs/theory/packings.md).
#pragma once

#include "generate/ball.h"
#include "generate/sphere_region.h"

#include <cstdint>
#include <vector>

namespace grainfrac {

/// Diameters are spread evenly between the smallest and the largest.
struct RandomPackingSpec {
    SphereRegion region;          ///< its surface is a wall
    double diameter = 0.0;        ///< mean [m]
    double size_ratio = 1.0;      ///< largest over smallest [-]
    double solid_fraction = 0.6;  ///< volume of the spheres over that of the region [-]
    std::int64_t seed = 1;
    std::uint32_t part = 0;  ///< parts of one case are packed differently
};

/// Largest overlap of a packing, over the mean diameter of the two; against a wall, over the sphere's diameter.
inline constexpr double packing_overlap = 5e-4;

/// As many spheres as come nearest to the solid fraction, neighbours in space near in the list. Throws InputError (key
/// "diameter", "solid_fraction") if none fits, or if the overlaps do not go away.
std::vector<Ball> random_packing(const RandomPackingSpec& spec);

/// Solid fraction of random close packing of spheres whose diameters are uniform between d and `size_ratio` d, far from
/// walls: 0.634 + 0.0658 delta, delta their standard deviation over their mean (Desmond and Weeks 2014).
double densest_random_packing(double size_ratio);
/// About what `random_packing` reaches in a region: walls keep spheres from half a layer or so [-].
double densest_random_packing(const RandomPackingSpec& spec);

}  // namespace grainfrac
