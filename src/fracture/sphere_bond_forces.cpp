// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/bond_forces.h"
#include "fracture/sphere_bond_action.h"
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

    View<const std::int32_t> a, b, law, kind;
    View<const SphereBondKind> kinds;
    View<const double> strength_factor;
    View<const Vec3> axis_a;

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

    template <bool incremental, bool damped>
    GF_FN SphereBondReading<incremental, damped> read(int i) const
    {
        const int A = a[i], B = b[i];
        SphereBondReading<incremental, damped> x;
        x.branch = body.position[B] - body.position[A];
        const SphereBondKind& k = kinds[kind[i]];
        x.share = k.share;
        x.rest = k.length;
        x.k = {k.normal_stiffness, k.shear_stiffness, k.bending_stiffness, k.twist_stiffness};
        if constexpr (incremental) {
            x.history = {shear_force[i], moment[i], twist[i], normal[i]};
        } else {
            x.orientation_a = body.orientation[A];
            x.orientation_b = body.orientation[B];
            x.turn = k.turn;
            x.axis_a = axis_a[i];
        }
        if constexpr (incremental || damped) {
            x.apart = body.velocity[B] - body.velocity[A];
            x.spin_a = body.angular_velocity[A];
            x.spin_b = body.angular_velocity[B];
        }
        if constexpr (damped) {
            x.inverse_mass_a = body.inverse_mass[A];
            x.inverse_mass_b = body.inverse_mass[B];
            x.inverse_inertia_a = body.inverse_inertia[A].x;
            x.inverse_inertia_b = body.inverse_inertia[B].x;
            x.viscous_force = viscous_force[i];
            x.viscous_moment = viscous_moment[i];
        }
        return x;
    }

    template <bool incremental, bool damped>
    GF_FN void write(int i, const SphereBondLaw& l, const SphereBondWriting<incremental, damped>& w) const
    {
        const int s = first_slot + i;
        if constexpr (incremental) {
            shear_force[i] = w.history.shear_force;
            moment[i] = w.history.moment;
            twist[i] = w.history.twist;
            normal[i] = w.history.normal;
        }
        if constexpr (damped) {
            viscous_work[i] += w.viscous_work;
            viscous_force[i] = w.viscous_force;
            viscous_moment[i] = w.viscous_moment;
        }
        stored_energy[i] = w.stored;
        slot.force[s] = w.force;
        slot.torque_a[s] = w.torque_a;
        slot.torque_b[s] = w.torque_b;
        if (slot.dyad_a.size > 0) {
            slot.dyad_a[s] = Mat3::outer(w.arm_a * w.e, -w.force);
            slot.dyad_b[s] = Mat3::outer(-w.arm_b * w.e, w.force);
        }
        if (!fracture_active || !l.strength.breakable) return;
        const BondCause broken =
            l.strength.broken(-w.elastic_force, -w.elastic_moment, w.e, kinds[kind[i]].radius, strength_factor[i]);
        if (broken != BondCause::whole) {  // this force still acts in this step; the contact takes over in the next
            cause[i] = static_cast<int>(broken);
            slot.bond_acts[s] = 0;
            failure_time[i] = time;
            fracture_work[i] += w.stored;
            stored_energy[i] = 0.0;
        }
    }

    GF_FN bool is_whole(int i) const { return cause[i] == static_cast<int>(BondCause::whole); }
    GF_FN bool damps(const SphereBondLaw& l) const { return l.damping > 0.0 && dashpots_active; }

    template <bool incremental, bool damped>
    GF_FN void one(int i, const SphereBondLaw& l) const
    {
        write(i, l, act(read<incremental, damped>(i), l.damping, dt));
    }

    GF_FN void operator()(int i) const
    {
        if (!is_whole(i)) {
            clear(i, first_slot + i);
            return;
        }
        const SphereBondLaw l = laws[law[i]];
        if (l.incremental)
            damps(l) ? one<true, true>(i, l) : one<true, false>(i, l);
        else
            damps(l) ? one<false, true>(i, l) : one<false, false>(i, l);
    }

    template <bool incremental, bool damped>
    GF_FLATTEN void block(int begin, int n, const SphereBondLaw& l) const
    {
        Lanes<SphereBondReading<incremental, damped>> in;
        Lanes<SphereBondWriting<incremental, damped>> out;
        for (int k = 0; k < n; ++k) in.put(k, read<incremental, damped>(begin + k));
        for_lanes(n, [&in, &out, zeta = l.damping, dt = dt](int k) { out.put(k, act(in.get(k), zeta, dt)); });
        for (int k = 0; k < n; ++k) write(begin + k, l, out.get(k));
    }

    /// Host: whole bonds of one law together.
    void range(int begin, int end) const
    {
        while (begin < end) {
            int n = 0;
            while (n < lanes && begin + n < end && is_whole(begin + n) && law[begin + n] == law[begin]) ++n;
            if (n == 0) {
                (*this)(begin++);
                continue;
            }
            const SphereBondLaw l = laws[law[begin]];
            if (l.incremental)
                damps(l) ? block<true, true>(begin, n, l) : block<true, false>(begin, n, l);
            else
                damps(l) ? block<false, true>(begin, n, l) : block<false, false>(begin, n, l);
            begin += n;
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
            s.kind.read(d),
            s.kinds.read(d),
            s.strength_factor.read(d),
            s.axis_a.read(d),
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

void sphere_bond_forces(const Model& model, State& state, const std::vector<int>& bonds, double dt)
{
    serial_for(bonds, kernel(model, state, dt, Device::cpu));
}

}  // namespace grainfrac
