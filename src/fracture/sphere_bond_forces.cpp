// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/bond_forces.h"
#include "gpu/parallel.h"
#include "model/views.h"

namespace grainfrac {

namespace {

struct SphereBondForces {
    static constexpr const char* name = "sphere bond forces";
    MotionView body;
    SlotsView slot;
    View<const SphereBondLaw> laws;
    double dt, time;
    bool fracture_active, dashpots_active;
    int first_slot;

    View<const std::int32_t> a, b, law;
    View<const double> share, length, radius, normal_stiffness, shear_stiffness, bending_stiffness, twist_stiffness;
    View<const double> strength_factor;
    View<const Vec3> axis_a;
    View<const Quat> turn;

    View<Vec3> shear_force, moment, normal;
    View<double> twist;
    View<std::int32_t> cause;
    View<double> stored_energy, fracture_work, viscous_work, failure_time;
    View<Vec3> viscous_force, viscous_moment;

    /// After the step in which the bond broke its force falls to nothing: half of it did work on the way.
    GF_FN void clear(int i, int s) const
    {
        if (norm2(slot.force[s]) + norm2(slot.torque_a[s]) + norm2(slot.torque_b[s]) > 0.0) {
            const double power = dot(slot.force[s], body.velocity[b[i]] - body.velocity[a[i]]) +
                                 dot(slot.torque_a[s], body.angular_velocity[a[i]]) +
                                 dot(slot.torque_b[s], body.angular_velocity[b[i]]);
            fracture_work[i] -= 0.5 * dt * power;
            slot.force[s] = slot.torque_a[s] = slot.torque_b[s] = Vec3{};
        }
        if (slot.dyad_a.size > 0) slot.dyad_a[s] = slot.dyad_b[s] = Mat3{};
    }

    GF_FN void operator()(int i) const
    {
        const int s = first_slot + i, A = a[i], B = b[i];
        if (cause[i] != static_cast<int>(BondCause::whole)) {
            clear(i, s);
            return;
        }
        const SphereBondLaw l = laws[law[i]];
        const Vec3 branch = body.position[B] - body.position[A];
        BondGeometry g;
        g.length = norm(branch);
        g.e = branch * (1.0 / g.length);
        g.rest = length[i];
        g.share = share[i];
        const BondSprings k{normal_stiffness[i], shear_stiffness[i], bending_stiffness[i], twist_stiffness[i]};
        const bool damped = l.damping > 0.0 && dashpots_active;

        // of b against a at the contact point, at mid step like the velocities: with the branch of the end of the step
        // a turning pair would seem to stretch, and a stretching one to slide
        Vec3 velocity, relative_spin, mean_spin, middle;
        if (damped || l.incremental) {
            const Vec3 wa = body.angular_velocity[A], wb = body.angular_velocity[B];
            const Vec3 apart = body.velocity[B] - body.velocity[A];
            const Vec3 half = branch - (0.5 * dt) * apart;
            velocity = apart - cross((1.0 - g.share) * wb + g.share * wa, half);
            middle = normalized(half);
            relative_spin = wb - wa;
            mean_spin = 0.5 * (wa + wb);
        }
        BondAction r;
        if (l.incremental) {
            BondHistory h{shear_force[i], moment[i], twist[i], normal[i]};
            r = incremental_bond(g, k, velocity, relative_spin, mean_spin, dt, h);
            shear_force[i] = h.shear_force;
            moment[i] = h.moment;
            twist[i] = h.twist;
            normal[i] = h.normal;
        } else {
            const Quat qa = body.orientation[A];
            r = total_bond(g, k, rotate(qa, axis_a[i]), body.orientation[B] * conjugate(qa * turn[i]));
        }
        const Vec3 elastic_force = r.force, elastic_moment = r.moment;
        if (damped) {
            const BondMasses m(g, body.inverse_mass[A], body.inverse_mass[B], body.inverse_inertia[A].x,
                               body.inverse_inertia[B].x);
            const BondDashpots c(l.damping, k, m);
            const Vec3 v_n = dot(velocity, middle) * middle, w_n = dot(relative_spin, middle) * middle;
            const Vec3 drag = -c.normal * v_n - c.shear * (velocity - v_n);
            const Vec3 brake = -c.twist * w_n - c.bending * (relative_spin - w_n);
            viscous_work[i] -=
                0.5 * dt * (dot(viscous_force[i] + drag, velocity) + dot(viscous_moment[i] + brake, relative_spin));
            viscous_force[i] = drag;
            viscous_moment[i] = brake;
            r.force += drag;
            r.moment += brake;
        }
        stored_energy[i] = r.stored;
        slot.force[s] = r.force;
        slot.torque_a[s] = -(cross(g.arm_a() * g.e, r.force) + r.moment);
        slot.torque_b[s] = r.moment - cross(g.arm_b() * g.e, r.force);
        if (slot.dyad_a.size > 0) {
            slot.dyad_a[s] = Mat3::outer(g.arm_a() * g.e, -r.force);
            slot.dyad_b[s] = Mat3::outer(-g.arm_b() * g.e, r.force);
        }
        if (!fracture_active || !l.strength.breakable) return;
        const BondCause broken = l.strength.broken(-elastic_force, -elastic_moment, g.e, radius[i], strength_factor[i]);
        if (broken != BondCause::whole) {  // this force still acts in this step; the contact takes over in the next
            cause[i] = static_cast<int>(broken);
            slot.bond_acts[s] = 0;
            failure_time[i] = time;
            fracture_work[i] += r.stored;
            stored_energy[i] = 0.0;
        }
    }
};

SphereBondForces kernel(const Model& model, State& state, double dt, Device d)
{
    SphereBonds& s = state.sphere_bonds;
    return {motion_view(state.bodies, d),
            slots_view(state.slots, d),
            model.sphere_bond_laws.read(d),
            dt,
            state.time,
            model.fracture_active,
            model.dashpots_active,
            state.first_sphere_slot(),
            s.a.read(d),
            s.b.read(d),
            s.law.read(d),
            s.share.read(d),
            s.length.read(d),
            s.radius.read(d),
            s.normal_stiffness.read(d),
            s.shear_stiffness.read(d),
            s.bending_stiffness.read(d),
            s.twist_stiffness.read(d),
            s.strength_factor.read(d),
            s.axis_a.read(d),
            s.turn.read(d),
            s.shear_force.write(d),
            s.moment.write(d),
            s.normal.write(d),
            s.twist.write(d),
            s.cause.write(d),
            s.stored_energy.write(d),
            s.fracture_work.write(d),
            s.viscous_work.write(d),
            s.failure_time.write(d),
            s.viscous_force.write(d),
            s.viscous_moment.write(d)};
}

}  // namespace

void sphere_bond_forces(const Model& model, State& state, double dt)
{
    parallel_for(model.device, state.sphere_bonds.size(), kernel(model, state, dt, model.device));
}

void sphere_bond_forces(const Model& model, State& state, const std::vector<int>& bonds)
{
    serial_for(bonds, kernel(model, state, 0.0, Device::cpu));
}

}  // namespace grainfrac
