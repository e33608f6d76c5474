// SPDX-License-Identifier: GPL-3.0-or-later
// Bonds between spheres: total form for what stays elastic, incremental form for what may roll without limit.
//
// Total (Kuzkin and Asonov 2012, for unequal arms): e along the branch, e_a and e_b the bond's axis as it turned with a
// and with b, D the turn of b against a since the bond was made, w the arm of a over the length l_0, G = K_s l_0^2,
// B = K_b - G w (1 - w) - K_t/2:
//
//   U   = K_n (l - l_0)^2/2 + G [w (1 - e_a.e) + (1 - w)(1 - e_b.e)] + B (1 - e_a.e_b) + K_t/2 (2 - t_a.t_b - s_a.s_b)
//   g   = G [w e_a + (1 - w) e_b];   F_b = -K_n (l - l_0) e + [g - (g.e) e]/l
//   M_a = G w e_a x e + B e_a x e_b + K_t/2 (t_a x t_b + s_a x s_b),   M_b = G (1 - w) e_b x e - the other two
//
// The sums over t and s need neither: with D = (d_0, d), t_a.t_b + s_a.s_b + e_a.e_b = 3 - 4 |d|^2 and the sum of the
// three vector products is 4 d_0 d. Differences from one are written as squares: they are 1e-12 in a stiff solid.
//
// Incremental (Potyondy and Cundall 2004, frame-indifferent): F_n from the length; F_t, M_t carried from the old normal
// to the new one and turned with the mean spin, then changed by the motion of the step, split along the mid-step
// normal.
#pragma once

#include "contact/linear_contact.h"
#include "fracture/parallel_law.h"
#include "geometry/quat.h"

namespace grainfrac {

struct SphereBondLaw {
    ParallelLaw strength;
    double damping;    ///< zeta of every mode, share of critical [-]
    bool incremental;  ///< else total
};

/// Stiffnesses of one bond.
struct BondSprings {
    double normal, shear;   ///< K_n, K_s [N/m]
    double bending, twist;  ///< K_b, K_t [N m]
};

/// Where the two spheres of a bond are.
struct BondGeometry {
    Vec3 e;               ///< unit, from a to b [-]
    double length = 0.0;  ///< l [m]
    double rest = 0.0;    ///< l_0 [m]
    double share = 0.0;   ///< w [-]

    GF_FN double arm_a() const { return share * length; }
    GF_FN double arm_b() const { return (1.0 - share) * length; }
};

/// Elastic action of a bond on b at the contact point, c_a e from a; on a the opposite.
struct BondAction {
    Vec3 force;           ///< [N]
    Vec3 moment;          ///< [N m]
    double stored = 0.0;  ///< [J]
};

/// @param axis_a the bond's axis as it turned with a  @param turned D, of b against a, world frame
GF_FN BondAction total_bond(const BondGeometry& g, const BondSprings& k, const Vec3& axis_a, const Quat& turned)
{
    const Vec3 axis_b = rotate(turned, axis_a), v{turned.x, turned.y, turned.z};
    const double w = g.share, G = k.shear * g.rest * g.rest, B = k.bending - G * w * (1.0 - w) - 0.5 * k.twist;
    const double stretch = g.length - g.rest;
    const double tilt_a = norm2(axis_a - g.e), tilt_b = norm2(axis_b - g.e), bent = norm2(axis_a - axis_b);
    BondAction r;
    r.stored = 0.5 * (k.normal * stretch * stretch + G * (w * tilt_a + (1.0 - w) * tilt_b) + B * bent +
                      k.twist * (4.0 * norm2(v) - 0.5 * bent));
    r.force =
        (-k.normal * stretch) * g.e + (G / g.length) * tangential(w * (axis_a - g.e) + (1.0 - w) * (axis_b - g.e), g.e);
    const Vec3 bend = cross(axis_a, axis_b);
    const Vec3 between = B * bend + (0.5 * k.twist) * (4.0 * turned.w * v - bend);
    const Vec3 on_b = G * (1.0 - w) * cross(axis_b, g.e) - between;  // about the centre of b
    r.moment = on_b + cross(g.arm_b() * g.e, r.force);
    return r;
}

/// What an incremental bond remembers; see SphereBonds for units.
struct BondHistory {
    Vec3 shear_force, moment;
    double twist = 0.0;
    Vec3 normal;
};

/// @param velocity, turn of b against a at the contact point and in rotation, mid step [m/s], [rad/s]
/// @param mean_spin of a and b [rad/s]
GF_FN BondAction incremental_bond(const BondGeometry& g, const BondSprings& k, const Vec3& velocity, const Vec3& turn,
                                  const Vec3& mean_spin, double dt, BondHistory& h)
{
    const Vec3 middle = normalized(h.normal + g.e);
    const double spin = dt * dot(mean_spin, g.e);
    // what was added at mid step still turns with the second half of the spin: else first order only
    const Vec3 sheared = turn_with_contact(tangential(velocity, middle), middle, g.e, 0.5 * spin);
    const Vec3 bent = turn_with_contact(tangential(turn, middle), middle, g.e, 0.5 * spin);
    h.shear_force = turn_with_contact(h.shear_force, h.normal, g.e, spin) - (k.shear * dt) * sheared;
    h.moment = turn_with_contact(h.moment, h.normal, g.e, spin) - (k.bending * dt) * bent;
    h.twist -= k.twist * dt * dot(turn, middle);
    h.normal = g.e;
    const double stretch = g.length - g.rest;
    BondAction r;
    r.force = (-k.normal * stretch) * g.e + h.shear_force;
    r.moment = h.moment + h.twist * g.e;
    r.stored = 0.5 * k.normal * stretch * stretch;
    r.stored += k.shear > 0.0 ? 0.5 * norm2(h.shear_force) / k.shear : 0.0;
    r.stored += k.bending > 0.0 ? 0.5 * norm2(h.moment) / k.bending : 0.0;
    r.stored += k.twist > 0.0 ? 0.5 * h.twist * h.twist / k.twist : 0.0;
    return r;
}

/// Reduced masses of the modes of a bond, for dashpots c = 2 zeta sqrt(M K).
struct BondMasses {
    double normal, shear;  ///< [kg]
    double rotation;       ///< [kg m^2]

    GF_FN BondMasses(const BondGeometry& g, double inverse_mass_a, double inverse_mass_b, double inverse_inertia_a,
                     double inverse_inertia_b)
    {
        const double p = g.share * g.rest, q = (1.0 - g.share) * g.rest, m = inverse_mass_a + inverse_mass_b;
        normal = inverse(m);
        shear = inverse(m + p * p * inverse_inertia_a + q * q * inverse_inertia_b);
        rotation = inverse(inverse_inertia_a + inverse_inertia_b);
    }
    GF_FN static double inverse(double x) { return x > 0.0 ? 1.0 / x : 0.0; }
};

/// Dashpots of a bond.
struct BondDashpots {
    double normal = 0.0, shear = 0.0;   ///< [N s/m]
    double bending = 0.0, twist = 0.0;  ///< [N m s]

    GF_FN BondDashpots(double zeta, const BondSprings& k, const BondMasses& m)
    {
        normal = 2.0 * zeta * std::sqrt(m.normal * k.normal);
        shear = 2.0 * zeta * std::sqrt(m.shear * k.shear);
        bending = 2.0 * zeta * std::sqrt(m.rotation * k.bending);
        twist = 2.0 * zeta * std::sqrt(m.rotation * k.twist);
    }
};

}  // namespace grainfrac
