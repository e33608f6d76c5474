// SPDX-License-Identifier: GPL-3.0-or-later
// A force and its moment about a point.
#pragma once

#include "geometry/vec3.h"

namespace grainfrac {

struct Wrench {
    Vec3 force, moment;

    GF_FN void add(const Vec3& f, const Vec3& arm)
    {
        force += f;
        moment += cross(arm, f);
    }
    GF_FN void add(const Wrench& w, double factor)
    {
        force += factor * w.force;
        moment += factor * w.moment;
    }
};

}  // namespace grainfrac
