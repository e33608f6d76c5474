// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/servo.h"

#include "gpu/parallel.h"
#include "model/views.h"

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

/// beta of the header, 0.3 to 0.5: 1 would cancel the error of a lone contact in one step, 2 make it swing.
constexpr double servo_gain = 0.4;

struct Push {
    int which;
    Vec3 direction;
    View<const std::int32_t> wall;
    View<const Vec3> force;
    GF_FN double operator()(int i) const { return wall[i] == which ? -dot(force[i], direction) : 0.0; }
};

/// What a wall's contacts set against a speed that lasts a step: K dt + c, with the stiffer branch, unloading, so that
/// the gain does not depend on which way the wall goes [N s/m].
struct Resistance {
    int which;
    double dt;
    View<const std::int32_t> wall, a, b, law, contact;  // the last four of pairs
    View<const std::int32_t> active;
    View<const double> inverse_mass;
    View<const LinearContact> laws;
    View<const double> scale;
    View<const ContactPoint> point;
    GF_FN double operator()(int i) const
    {
        const int k = contact[i];
        if ((wall[a[i]] != which && wall[b[i]] != which) || k < 0 || active[k] != 1) return 0.0;
        const LinearContact& l = laws[law[i]];
        const double K = l.area_stiffness * scale[k] * point[k].area;
        const double m = reduced_mass(inverse_mass[a[i]], inverse_mass[b[i]]);
        return l.unload_factor * K * dt + 2.0 * l.damping_ratio * std::sqrt(K * m);
    }
};

struct SetVelocity {
    static constexpr const char* name = "drive servos";
    int which;
    Vec3 value;
    View<const std::int32_t> wall;
    View<Vec3> velocity;
    GF_FN void operator()(int i) const
    {
        if (wall[i] == which) velocity[i] = value;
    }
};

double resistance(const Model& model, const State& state, int wall, double dt)
{
    const Device d = model.device;
    const CandidatePairs& p = state.pairs;
    const Contacts& c = state.contacts;
    const Bodies& b = state.bodies;
    return parallel_sum(d, p.size(),
                        Resistance{wall, dt, b.wall.read(d), p.a.read(d), p.b.read(d), p.law.read(d), p.contact.read(d),
                                   c.active.read(d), b.inverse_mass.read(d), model.contact_laws.read(d),
                                   c.stiffness_scale.read(d), c.point.read(d)});
}

}  // namespace

double wall_push(const Model& model, const State& state, int wall, const Vec3& direction)
{
    const Device d = model.device;
    const Bodies& b = state.bodies;
    return parallel_sum(d, b.size(), Push{wall, direction, b.wall.read(d), b.force.read(d)});
}

void drive_servos(const Model& model, State& state, double dt)
{
    const Device d = model.device;
    Bodies& b = state.bodies;
    for (std::size_t w = 0; w < model.walls.size(); ++w) {
        const WallMotion motion = model.wall_motion[static_cast<int>(w)];
        if (!motion.has_servo()) continue;
        const int wall = static_cast<int>(w);
        const double missing =
            motion.push_at(state.time + 0.5 * dt) - wall_push(model, state, wall, motion.push_direction);
        const double R = resistance(model, state, wall, dt);
        const double wanted = R > 0.0 ? servo_gain * missing / R : std::copysign(motion.max_speed, missing);
        const double speed = missing == 0.0 ? 0.0 : std::clamp(wanted, -motion.max_speed, motion.max_speed);
        parallel_for(d, b.size(),
                     SetVelocity{wall, speed * motion.push_direction, b.wall.read(d), b.velocity.write(d)});
    }
}

bool servos_hold(const Model& model, const State& state)
{
    for (std::size_t w = 0; w < model.walls.size(); ++w) {
        const WallMotion motion = model.wall_motion[static_cast<int>(w)];
        if (!motion.has_servo()) continue;
        const double push = wall_push(model, state, static_cast<int>(w), motion.push_direction);
        if (std::fabs(push - motion.push) > servo_tolerance * motion.push) return false;
    }
    return true;
}

}  // namespace grainfrac
