// SPDX-License-Identifier: GPL-3.0-or-later
// Contact shapes as pictures: a dilated core as a closed surface of polygons.
#pragma once

#include "model/shapes.h"

#include <vector>

namespace grainfrac {

struct Surface {
    std::vector<Vec3> points;             ///< [m]
    std::vector<std::vector<int>> faces;  ///< counter-clockwise seen from outside
};

/// Surface of shape `shape` in its body frame. Balls and capsules are tessellated; a polyhedral core is drawn with its
/// faces shifted out by the dilation radius and sharp edges, which overstates it there by less than that radius.
Surface shape_surface(const Shapes& shapes, int shape);

}  // namespace grainfrac
