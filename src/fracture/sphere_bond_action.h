// SPDX-License-Identifier: GPL-3.0-or-later
// One evaluation of a bond between spheres: from what it reads of its bodies and itself to what it writes.
#pragma once

#include "fracture/sphere_bond_law.h"
#include "model/lanes.h"

namespace grainfrac {

/// What a bond reads. The form of the bond decides which numbers are in use.
template <bool incremental, bool damped>
struct SphereBondReading {
    Vec3 branch;  ///< from a to b [m]
    double share = 0.0, rest = 0.0;
    BondSprings k{};
    // total
    Quat orientation_a, orientation_b, turn;
    Vec3 axis_a;
    // incremental
    BondHistory history;
    // incremental or damped
    Vec3 apart;           ///< velocity of b less that of a [m/s]
    Vec3 spin_a, spin_b;  ///< [rad/s]
    // damped
    double inverse_mass_a = 0.0, inverse_mass_b = 0.0, inverse_inertia_a = 0.0, inverse_inertia_b = 0.0;
    Vec3 viscous_force, viscous_moment;  ///< of the last evaluation

    template <class Visit>
    constexpr void for_each_number(Visit&& visit)
    {
        const auto all = [&](auto&... x) { (grainfrac::for_each_number(x, visit), ...); };
        all(branch, share, rest, k.normal, k.shear, k.bending, k.twist);
        if constexpr (incremental)
            all(history.shear_force, history.moment, history.twist, history.normal);
        else
            all(orientation_a, orientation_b, turn, axis_a);
        if constexpr (incremental || damped) all(apart, spin_a, spin_b);
        if constexpr (damped)
            all(inverse_mass_a, inverse_mass_b, inverse_inertia_a, inverse_inertia_b, viscous_force, viscous_moment);
    }
};

/// What a bond writes.
template <bool incremental, bool damped>
struct SphereBondWriting {
    Vec3 force, torque_a, torque_b;      ///< on b, about the centres of a and b
    Vec3 e;                              ///< unit, from a to b
    double arm_a = 0.0, arm_b = 0.0;     ///< [m]
    Vec3 elastic_force, elastic_moment;  ///< on b at the contact point
    double stored = 0.0;                 ///< [J]
    BondHistory history;                 // incremental
    Vec3 viscous_force, viscous_moment;  // damped: on b at the contact point
    double viscous_work = 0.0;           // damped: of this step [J]

    template <class Visit>
    constexpr void for_each_number(Visit&& visit)
    {
        const auto all = [&](auto&... x) { (grainfrac::for_each_number(x, visit), ...); };
        all(force, torque_a, torque_b, e, arm_a, arm_b, elastic_force, elastic_moment, stored);
        if constexpr (incremental) all(history.shear_force, history.moment, history.twist, history.normal);
        if constexpr (damped) all(viscous_force, viscous_moment, viscous_work);
    }
};

/// @param zeta share of critical damping of every mode [-]  @param dt [s]
template <bool incremental, bool damped>
GF_FN SphereBondWriting<incremental, damped> act(const SphereBondReading<incremental, damped>& x, double zeta,
                                                 double dt)
{
    BondGeometry g;
    g.length = norm(x.branch);
    g.e = x.branch * (1.0 / g.length);
    g.rest = x.rest;
    g.share = x.share;

    // of b against a at the contact point, at mid step like the velocities: with the branch of the end of the step
    // a turning pair would seem to stretch, and a stretching one to slide
    Vec3 velocity, relative_spin, middle;
    if constexpr (incremental || damped) {
        const Vec3 half = x.branch - (0.5 * dt) * x.apart;
        velocity = x.apart - cross((1.0 - g.share) * x.spin_b + g.share * x.spin_a, half);
        middle = normalized(half);
        relative_spin = x.spin_b - x.spin_a;
    }
    SphereBondWriting<incremental, damped> w;
    BondAction r;
    if constexpr (incremental) {
        w.history = x.history;
        r = incremental_bond(g, x.k, velocity, relative_spin, 0.5 * (x.spin_a + x.spin_b), dt, w.history);
    } else {
        r = total_bond(g, x.k, rotate(x.orientation_a, x.axis_a),
                       x.orientation_b * conjugate(x.orientation_a * x.turn));
    }
    w.elastic_force = r.force;
    w.elastic_moment = r.moment;
    if constexpr (damped) {
        const BondMasses m(g, x.inverse_mass_a, x.inverse_mass_b, x.inverse_inertia_a, x.inverse_inertia_b);
        const BondDashpots c(zeta, x.k, m);
        const Vec3 v_n = dot(velocity, middle) * middle, w_n = dot(relative_spin, middle) * middle;
        w.viscous_force = -c.normal * v_n - c.shear * (velocity - v_n);
        w.viscous_moment = -c.twist * w_n - c.bending * (relative_spin - w_n);
        w.viscous_work = -0.5 * dt *
                         (dot(x.viscous_force + w.viscous_force, velocity) +
                          dot(x.viscous_moment + w.viscous_moment, relative_spin));
        r.force += w.viscous_force;
        r.moment += w.viscous_moment;
    }
    w.e = g.e;
    w.arm_a = g.arm_a();
    w.arm_b = g.arm_b();
    w.stored = r.stored;
    w.force = r.force;
    w.torque_a = -(cross(w.arm_a * g.e, r.force) + r.moment);
    w.torque_b = r.moment - cross(w.arm_b * g.e, r.force);
    return w;
}

}  // namespace grainfrac
