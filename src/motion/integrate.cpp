// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/integrate.h"

#include "gpu/parallel.h"

namespace grainfrac {

namespace {

/// Local non-viscous damping (Cundall 1987) in a form that does not know the axes: alpha |F.v|/|v| against the motion.
/// Of one component it is alpha |F|.
GF_FN Vec3 local_drag(double alpha, const Vec3& f, const Vec3& v)
{
    const double v2 = norm2(v);
    return v2 > 0.0 ? (-alpha * std::fabs(dot(f, v)) / v2) * v : Vec3{};
}

GF_FN Vec3 scaled(const Vec3& a, const Vec3& b)
{
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

/// Bits of Bodies::held.
constexpr std::int32_t held_x = 1, held_y = 2, held_z = 4, held_rotation = 8;

/// The components that a partly held body does not choose itself are put back to those of `driven`.
GF_FN Vec3 with_held(const Vec3& v, const Vec3& driven, std::int32_t held)
{
    return {(held & held_x) != 0 ? driven.x : v.x, (held & held_y) != 0 ? driven.y : v.y,
            (held & held_z) != 0 ? driven.z : v.z};
}

/// All but driven bodies and those without rotation; a pin is driven and turns.
GF_FN bool turns_freely(const Vec3& inverse_inertia)
{
    return norm2(inverse_inertia) > 0.0;
}

struct Kick {
    static constexpr const char* name = "kick";
    double dt, local_damping, kept;  // kept: share of the motion that the drag leaves
    Vec3 gravity;
    View<const Vec3> force, torque, inverse_inertia;
    View<const double> mass, inverse_mass;
    View<const std::int32_t> held;
    View<const Quat> orientation;
    View<Vec3> velocity, angular_momentum, angular_velocity;
    View<double> external_work, damping_work, gravity_work;

    GF_FN void operator()(int i) const
    {
        double braked = 0.0;           // power of the drag [W]
        if (inverse_mass[i] == 0.0) {  // driven: the system pushes back, we push with the opposite force
            if (!turns_freely(inverse_inertia[i])) {
                external_work[i] -= dt * (dot(force[i], velocity[i]) + dot(torque[i], angular_velocity[i]));
                return;
            }
            external_work[i] -= dt * dot(force[i], velocity[i]);
        } else {
            const Vec3 v = velocity[i];
            Vec3 drag;  // what is held has no say in its direction
            if (local_damping > 0.0)
                drag = local_drag(local_damping, with_held(force[i], {}, held[i]), with_held(v, {}, held[i]));
            Vec3 v_new = v + (dt * inverse_mass[i]) * (force[i] + drag);
            if (held[i] != 0) {  // the system pushes back along what is held, we push with the opposite force
                v_new = with_held(v_new, v, held[i]);
                external_work[i] -= dt * dot(force[i] - with_held(force[i], {}, held[i]), v);
                drag = with_held(drag, {}, held[i]);
            }
            const Vec3 mean = 0.5 * (v + v_new);
            gravity_work[i] += dt * mass[i] * dot(gravity, mean);
            braked = dot(drag, mean);
            if (kept < 1.0) {
                damping_work[i] += 0.5 * (1.0 - kept * kept) * mass[i] * norm2(with_held(v_new, {}, held[i]));
                v_new = with_held(kept * v_new, v_new, held[i]);
            }
            velocity[i] = v_new;
        }

        const Vec3 t = rotate_back(orientation[i], torque[i]);
        const Vec3 spin = scaled(inverse_inertia[i], angular_momentum[i]);
        Vec3 brake = local_damping > 0.0 ? local_drag(local_damping, t, spin) : Vec3{};
        Vec3 L = angular_momentum[i] + dt * (t + brake);
        if ((held[i] & held_rotation) != 0) {
            L = angular_momentum[i];
            brake = Vec3{};
        }
        const Vec3 spin_new = scaled(inverse_inertia[i], L);
        damping_work[i] -= dt * (braked + dot(brake, 0.5 * (spin + spin_new)));
        double turning = 1.0;
        if (kept < 1.0 && (held[i] & held_rotation) == 0) {
            damping_work[i] += 0.5 * (1.0 - kept * kept) * dot(L, spin_new);
            turning = kept;
        }
        angular_momentum[i] = turning * L;
        angular_velocity[i] = rotate(orientation[i], turning * spin_new);
    }
};

struct Drift {
    static constexpr const char* name = "drift";
    double dt;
    View<const Vec3> velocity, inverse_inertia;
    View<Vec3> position, angular_momentum, angular_velocity;
    View<Quat> orientation;

    GF_FN void operator()(int i) const
    {
        position[i] += dt * velocity[i];
        if (!turns_freely(inverse_inertia[i])) return;
        Vec3 L = angular_momentum[i];
        Quat q = orientation[i];
        rotate_freely(inverse_inertia[i], dt, L, q);
        angular_momentum[i] = L;
        orientation[i] = q;
        angular_velocity[i] = rotate(q, scaled(inverse_inertia[i], L));
    }
};

struct MoveWalls {
    static constexpr const char* name = "move walls";
    double time;
    View<const std::int32_t> wall, held;
    View<const double> inverse_mass;
    View<const WallMotion> motion;
    View<Vec3> velocity;
    GF_FN void operator()(int i) const
    {
        if (wall[i] < 0) return;
        const Vec3 v = motion[wall[i]].at(time);
        velocity[i] = inverse_mass[i] > 0.0 ? with_held(velocity[i], v, held[i]) : v;
    }
};

struct UpdateAngularVelocity {
    static constexpr const char* name = "update angular velocity";
    View<const Quat> orientation;
    View<const Vec3> inverse_inertia, angular_momentum;
    View<Vec3> angular_velocity;
    GF_FN void operator()(int i) const
    {
        if (!turns_freely(inverse_inertia[i])) return;
        angular_velocity[i] = rotate(orientation[i], scaled(inverse_inertia[i], angular_momentum[i]));
    }
};

}  // namespace

void kick(const Model& model, State& state, double dt, double drag_time)
{
    const Device d = model.device;
    Bodies& b = state.bodies;
    const double half_drag = 0.5 * drag_time * model.drag_rate;
    const double kept = (1.0 - half_drag) / (1.0 + half_drag);
    parallel_for(
        d, b.size(),
        Kick{dt, model.local_damping, kept, model.gravity, b.force.read(d), b.torque.read(d), b.inverse_inertia.read(d),
             b.mass.read(d), b.inverse_mass.read(d), b.held.read(d), b.orientation.read(d), b.velocity.write(d),
             b.angular_momentum.write(d), b.angular_velocity.write(d), b.external_work.write(d),
             b.damping_work.write(d), b.gravity_work.write(d)});
}

void drift(const Model& model, State& state, double dt)
{
    const Device d = model.device;
    Bodies& b = state.bodies;
    parallel_for(d, b.size(),
                 Drift{dt, b.velocity.read(d), b.inverse_inertia.read(d), b.position.write(d),
                       b.angular_momentum.write(d), b.angular_velocity.write(d), b.orientation.write(d)});
}

void move_walls(const Model& model, State& state, double time)
{
    if (model.walls.empty()) return;
    const Device d = model.device;
    Bodies& b = state.bodies;
    parallel_for(d, b.size(),
                 MoveWalls{time, b.wall.read(d), b.held.read(d), b.inverse_mass.read(d), model.wall_motion.read(d),
                           b.velocity.write(d)});
}

void update_angular_velocity(const Model& model, State& state)
{
    const Device d = model.device;
    Bodies& b = state.bodies;
    parallel_for(d, b.size(),
                 UpdateAngularVelocity{b.orientation.read(d), b.inverse_inertia.read(d), b.angular_momentum.read(d),
                                       b.angular_velocity.write(d)});
}

}  // namespace grainfrac
