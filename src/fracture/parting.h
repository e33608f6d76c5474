// SPDX-License-Identifier: GPL-3.0-or-later
// A grain while it is being split: what the steps of a split tell each other.
#pragma once

#include "fracture/split_grains.h"
#include "model/grain_body.h"

#include <vector>

namespace grainfrac {

struct Parting {
    SplitRequest request;
    Placement before;                 ///< of the grain
    int part_1 = -1;                  ///< body; part 2 keeps the index of the grain
    double mass = 0.0;                ///< of the grain [kg]
    Vec3 inertia;                     ///< principal, of the grain [kg m^2]
    Vec3 velocity, angular_velocity;  ///< of the grain [m/s, rad/s]
    double on_plane = 0.0;            ///< points this far below the plane still go to part 1 [m]
    std::vector<Vec3> section;        ///< corners of the cut in space [m]

    bool is_in_part_1(const Vec3& x) const { return dot(request.plane.normal, x) - request.plane.offset > -on_plane; }
};

}  // namespace grainfrac
