// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/grain_body.h"

#include "geometry/cut.h"
#include "geometry/mass_properties.h"

#include <algorithm>
#include <stdexcept>

namespace grainfrac {

namespace {

template <class T>
T& at(Buffer<T>& buffer, int i)
{
    return buffer.host()[static_cast<std::size_t>(i)];
}

}  // namespace

PrincipalFrame set_grain_shape(Model& model, Bodies& b, int i, const Polyhedron& given, const Placement& frame,
                               double density, double dilation_radius)
{
    const MassProperties m = mass_properties(given);
    Polyhedron shape = rotated(translated(given, -m.centroid), conjugate(m.principal_axes));
    const double radius = std::min(dilation_radius, most_dilation * inscribed_ball(shape).radius);
    const Polyhedron core = erode(shape, radius);
    if (core.faces.empty())
        throw std::invalid_argument("grain: nothing is left of it after erosion by its dilation radius");

    const Vec3 inertia = density * m.principal_inertia;
    at(b.position, i) = frame.to_space(m.centroid);
    at(b.orientation, i) = frame.orientation * m.principal_axes;
    at(b.mass, i) = density * m.volume;
    at(b.inverse_mass, i) = 1.0 / (density * m.volume);
    at(b.inertia, i) = inertia;
    at(b.inverse_inertia, i) = {1.0 / inertia.x, 1.0 / inertia.y, 1.0 / inertia.z};
    at(b.shape, i) = add_shape(model.shapes, core, radius);
    model.grain_shapes.at(static_cast<std::size_t>(i)) = std::move(shape);
    return {m.centroid, m.principal_axes};
}

void set_spin(Bodies& b, int i, const Vec3& angular_velocity)
{
    const Vec3 spin = rotate_back(b.orientation[i], angular_velocity), inertia = b.inertia[i];
    at(b.angular_momentum, i) = {inertia.x * spin.x, inertia.y * spin.y, inertia.z * spin.z};
    at(b.angular_velocity, i) = angular_velocity;
}

}  // namespace grainfrac
