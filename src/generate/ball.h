// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/vec3.h"

namespace grainfrac {

/// A sphere before it belongs to a part.
struct Ball {
    Vec3 center;          ///< [m]
    double radius = 0.0;  ///< [m]
};

}  // namespace grainfrac
