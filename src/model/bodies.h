// SPDX-License-Identifier: GPL-3.0-or-later
// All bodies: grains, spheres, walls and, without rotation, peridynamic nodes. One array per quantity, entry i is body
// i.
#pragma once

#include "geometry/quat.h"
#include "gpu/buffer.h"

#include <cstdint>

namespace grainfrac {

struct Bodies {
    Buffer<Vec3> position;          ///< centre of mass, world frame [m]
    Buffer<Quat> orientation;       ///< body (principal axes) to world, unit length [-]
    Buffer<Vec3> velocity;          ///< of the centre of mass [m/s]
    Buffer<Vec3> angular_momentum;  ///< body frame [kg m^2/s]
    Buffer<Vec3> angular_velocity;  ///< world frame; follows from angular_momentum, prescribed where driven [rad/s]
    Buffer<Vec3> force;             ///< resultant of contacts, bonds and gravity [N]
    Buffer<Vec3> torque;            ///< about the centre of mass, world frame [N m]
    Buffer<double> mass;            ///< [kg]
    Buffer<double> inverse_mass;    ///< 0 where driven [1/kg]
    Buffer<Vec3> inertia;           ///< principal moments [kg m^2]
    Buffer<Vec3>
        inverse_inertia;  ///< 0 where driven (but for pins, which turn), and for bodies that do not rotate [1/(kg m^2)]
    Buffer<double> external_work;  ///< done on the system by moving this driven body [J]
    Buffer<double> damping_work;   ///< taken by local damping [J]
    Buffer<double> gravity_work;   ///< done by gravity [J]
    Buffer<std::int32_t> id;       ///< never changes and is never reused; index may change [-]
    Buffer<std::int32_t> shape;    ///< into Shapes [-]
    Buffer<std::int32_t> group;    ///< part or wall: index into Model::groups [-]
    Buffer<std::int32_t> wall;     ///< index into Model::walls, -1 if the body is free [-]
    Buffer<std::int32_t> held;     ///< of a body that moves: bits 1, 2, 4: x, y, z go as its wall does, 8: no rotation
    Buffer<Vec3> start_position;   ///< for displacement fields [m]
    Buffer<Quat> start_orientation;   ///< for rotation fields [-]
    Buffer<Quat> crystal;             ///< crystal frame to body frame [-]
    Buffer<std::int32_t> origin;      ///< id of the grain that it was at the start [-]
    Buffer<std::int32_t> parent;      ///< id of what it was split from, -1 if it is whole [-]
    Buffer<std::int32_t> generation;  ///< number of splits behind it [-]
    Buffer<double> split_time;        ///< of the last split behind it, -1 if it is whole [s]
    Buffer<std::int64_t> saturated;   ///< bit k: a split along candidate plane k was refused [-]
    Buffer<double> cleavage_factor;   ///< f of the worst plane that may split, at the last look for cleavage [-]
    Buffer<std::int64_t> last_look;   ///< step of that look [-]
    Buffer<std::int64_t> next_look;   ///< step from which on it is looked at again [-]
    Buffer<double> origin_volume;     ///< of the sharp grain that it was at the start; 0 for walls [m^3]

    int size() const { return position.size(); }

    /// The one list: resizing, checkpoints, checks and the state hash all walk it.
    template <class Visit>
    void for_each_array(Visit&& visit)
    {
        visit("position", position);
        visit("orientation", orientation);
        visit("velocity", velocity);
        visit("angular_momentum", angular_momentum);
        visit("angular_velocity", angular_velocity);
        visit("force", force);
        visit("torque", torque);
        visit("mass", mass);
        visit("inverse_mass", inverse_mass);
        visit("inertia", inertia);
        visit("inverse_inertia", inverse_inertia);
        visit("external_work", external_work);
        visit("damping_work", damping_work);
        visit("gravity_work", gravity_work);
        visit("id", id);
        visit("shape", shape);
        visit("group", group);
        visit("wall", wall);
        visit("held", held);
        visit("start_position", start_position);
        visit("start_orientation", start_orientation);
        visit("crystal", crystal);
        visit("origin", origin);
        visit("parent", parent);
        visit("generation", generation);
        visit("split_time", split_time);
        visit("saturated", saturated);
        visit("cleavage_factor", cleavage_factor);
        visit("last_look", last_look);
        visit("next_look", next_look);
        visit("origin_volume", origin_volume);
    }
};

}  // namespace grainfrac
