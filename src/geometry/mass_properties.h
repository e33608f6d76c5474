// SPDX-License-Identifier: GPL-3.0-or-later
// Volume, centroid and inertia of a homogeneous polyhedron (physics/grains 2.5).
#pragma once

#include "geometry/polyhedron.h"

namespace grainfrac {

struct MassProperties {
    double volume = 0.0;     ///< [m^3]
    Vec3 centroid;           ///< [m]
    Mat3 euler;              ///< centroidal int (x-c)(x-c)^T dV, per unit density [m^5]
    Mat3 inertia;            ///< tr(euler) 1 - euler, per unit density [m^5]
    Vec3 principal_inertia;  ///< eigenvalues of `inertia` in the order of `principal_axes`, per unit density [m^5]
    Quat principal_axes;     ///< principal frame to the polyhedron's frame, proper rotation [-]
};

/// Sum of signed tetrahedra about an interior point. A frame that is already principal is kept (identity axes) when the
/// products of inertia are below 1e-12 of the trace.
MassProperties mass_properties(const Polyhedron& p);

/// Volume of core (+) ball(radius), Steiner's formula (2.4) [m^3].
double dilated_volume(const Polyhedron& core, double radius);

}  // namespace grainfrac
