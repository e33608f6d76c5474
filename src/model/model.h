// SPDX-License-Identifier: GPL-3.0-or-later
// What never changes in a step: materials, laws by pair, walls, gravity.
#pragma once

#include "contact/linear_contact.h"
#include "fracture/interface_law.h"
#include "fracture/parallel_law.h"
#include "fracture/sphere_bond_law.h"
#include "model/bodies.h"
#include "model/shapes.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace grainfrac {

struct Material {
    std::string name;
    double density = 0.0;        ///< [kg/m^3]
    double young_modulus = 0.0;  ///< [Pa]
    double poisson_ratio = 0.0;  ///< [-]
};

/// A part or a wall: what `between` in the input can name.
struct Group {
    std::string name;
    std::int32_t material = -1;  ///< into Model::materials, -1 for walls
    bool is_wall = false;
};

/// From 0 to 1 as s^3 (10 - 15 s + 6 s^2) in `ramp` after `start`.
GF_FN double smooth_rise(double time, double start, double ramp)
{
    if (ramp <= 0.0 || time >= start + ramp) return 1.0;
    const double s = time > start ? (time - start) / ramp : 0.0;
    return s * s * s * (10.0 + s * (6.0 * s - 15.0));
}

/// A driven body or several that move as one, at a speed that rises over `ramp`, or by a servo: see motion/servo.h.
struct WallMotion {
    Vec3 from_velocity;  ///< [m/s]
    Vec3 velocity;       ///< [m/s]
    double start = 0.0;  ///< [s]
    double ramp = 0.0;   ///< [s]
    // servo, where push_direction is not zero
    Vec3 push_direction;     ///< unit [-]
    double from_push = 0.0;  ///< at `start` [N]
    double push = 0.0;       ///< wanted after the ramp [N]
    double max_speed = 0.0;  ///< [m/s]

    GF_FN Vec3 at(double time) const
    {
        const double rise = smooth_rise(time, start, ramp);
        return rise < 1.0 ? from_velocity + rise * (velocity - from_velocity) : velocity;
    }
    GF_FN double push_at(double time) const { return from_push + smooth_rise(time, start, ramp) * (push - from_push); }
    bool has_servo() const { return norm2(push_direction) > 0.0; }
};

/// Entry of groups a and b in a table of `groups` rows and columns, row by row.
inline std::size_t entry_of_pair(int a, int b, std::size_t groups)
{
    return static_cast<std::size_t>(a) * groups + static_cast<std::size_t>(b);
}

struct Model {
    std::vector<Material> materials;
    std::vector<Group> groups;
    std::vector<std::string> walls;  ///< names; Bodies::wall points here
    Buffer<WallMotion> wall_motion;  ///< one per wall, set by the stage
    Shapes shapes;
    std::vector<Polyhedron> grain_shapes;  ///< sharp polyhedron of each body in its frame; empty for walls
    Buffer<InterfaceLaw> interface_laws;
    Buffer<ParallelLaw> parallel_laws;
    Buffer<SphereBondLaw> sphere_bond_laws;
    Buffer<LinearContact> contact_laws;
    std::vector<std::int32_t> contact_law_of;  ///< entry_of_pair -> contact law
    Vec3 gravity;                              ///< [m/s^2]
    double local_damping = 0.0;                ///< alpha [-]
    bool resolve_impacts = false;        ///< the time step resolves rebounds of fragments too, not of loose grains only
    bool fracture_active = true;         ///< bonds may break or soften in this stage
    bool dashpots_active = true;         ///< of bonds; relaxation brings its own damping
    double drag_rate = 0.0;              ///< of relaxation: drag per mass and velocity [1/s]
    bool fibres_contract = false;        ///< an interface loses pressure with the stress of its fibre
    Buffer<std::int32_t> spread_bodies;  ///< stay put in the mean, under a stress that varies linearly over them
    Buffer<double> spread_area;          ///< share of the face of each, in any unit
    Vec3 spread_direction;               ///< along which they do [-]
    double skin = 0.0;                   ///< of the neighbour list [m]
    double nominal_length = 0.0;         ///< mean grain spacing, for scales and tolerances [m]
    Device device = Device::cpu;
};

/// A body of a part that is no polyhedron.
inline bool is_sphere(const Model& model, const Bodies& bodies, int i)
{
    return !model.groups[static_cast<std::size_t>(bodies.group[i])].is_wall &&
           model.grain_shapes[static_cast<std::size_t>(i)].faces.empty();
}

}  // namespace grainfrac
