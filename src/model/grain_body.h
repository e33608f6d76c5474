// SPDX-License-Identifier: GPL-3.0-or-later
// A rigid body from a polyhedron: for grains when they are made and for their parts when they split.
#pragma once

#include "model/bodies.h"
#include "model/model.h"

namespace grainfrac {

/// The dilation radius may take this share of a grain's inradius; more and erosion eats small faces.
inline constexpr double most_dilation = 1.0 / 3.0;

/// Where a body is in space.
struct Placement {
    Vec3 position;
    Quat orientation;

    Vec3 to_space(const Vec3& x) const { return position + rotate(orientation, x); }
    Vec3 to_body(const Vec3& x) const { return rotate_back(orientation, x - position); }
};
inline Placement placement(const Bodies& b, int i)
{
    return {b.position[i], b.orientation[i]};
}

/// Principal frame of a body within the frame that its polyhedron was given in.
struct PrincipalFrame {
    Vec3 centroid;  ///< [m]
    Quat axes;
};

/// Make body i of the polyhedron, given in the frame `frame`: place, mass, inertia, sharp shape and dilated contact
/// shape. Motion and all else stay as they are. Throws std::invalid_argument if erosion by the dilation radius, reduced
/// to `most_dilation` of the inradius where it is larger, leaves nothing.
PrincipalFrame set_grain_shape(Model& model, Bodies& bodies, int i, const Polyhedron& shape, const Placement& frame,
                               double density, double dilation_radius);

/// Rate of the angular velocity [rad/s^2] by Euler's equations, all in the principal frame: inertia [kg m^2], angular
/// velocity [rad/s], torque [N m].
inline Vec3 angular_acceleration(const Vec3& inertia, const Vec3& w, const Vec3& torque)
{
    const Vec3 L{inertia.x * w.x, inertia.y * w.y, inertia.z * w.z}, t = torque - cross(w, L);
    return {t.x / inertia.x, t.y / inertia.y, t.z / inertia.z};
}

/// Angular momentum and velocity of body i for a spin given in space [rad/s].
void set_spin(Bodies& bodies, int i, const Vec3& angular_velocity);

}  // namespace grainfrac
