// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of two bodies that are not bonded: linear in the overlap, hysteretic or viscous, Coulomb friction.
//
//   loading    p_s = k_c V,  V the overlap volume: the penetration integrated over the manifold
//   unloading  p_s = <C k_c (V - V_p)>,  V_p = V_max (1 - 1/C), C = 1/e^2  (Walton and Braun 1986, in volumes, so that
//   a
//              contact whose area grows is not taken for one that unloads)
//   viscous    p = <p_s - c_n v_n>,  c_n = 2 zeta sqrt(K m*)
//   shear      F_t += K_s v_t dt, |F_t| <= mu p;  F_t is a history and turns with the contact (Rodrigues form)
//   twist      about the normal of an area contact, M += k_s J w_n dt, |M| <= 2/3 mu p R
// K is the stiffness of the manifold: k_c A for faces, k_c A_ref for points and lines.
#pragma once

#include "geometry/vec3.h"
#include "model/contacts.h"

namespace grainfrac {

/// History of one contact; see Contacts for units.
struct ContactHistory {
    Vec3 shear_force;
    Vec3 normal;
    double twist_moment = 0.0;
    double max_overlap = 0.0;
    double max_energy = 0.0;
    double offset_force = 0.0;
    double stiffness_scale = 1.0;
    double area = 0.0;
    double footprint = 0.0;
    double normal_energy = 0.0;
    double elastic_force = 0.0;  ///< p without its viscous part [N]
};

/// Motion of b against a at the contact.
struct ContactMotion {
    Vec3 velocity;              ///< v_b - v_a at the contact point [m/s]
    Vec3 mean_spin;             ///< (w_a + w_b)/2 [rad/s]
    double twist_rate = 0.0;    ///< (w_b - w_a) . n [rad/s]
    double reduced_mass = 0.0;  ///< m_a m_b/(m_a + m_b) [kg]
};

struct ContactResponse {
    Vec3 force;                    ///< on b [N]
    double twist_moment = 0.0;     ///< on a about n; b gets the opposite [N m]
    double normal_force = 0.0;     ///< p [N]
    double viscous_force = 0.0;    ///< on b along n [N]
    double stored = 0.0;           ///< [J]
    double friction_work = 0.0;    ///< of this step [J]
    double hysteresis_work = 0.0;  ///< of this step [J]
    double inserted_work = 0.0;    ///< of this step, signed [J]
};

/// Turn a vector with the contact: tilt n_old -> n, then spin about n (angle [rad], small).
GF_FN Vec3 turn_with_contact(const Vec3& f, const Vec3& n_old, const Vec3& n, double spin)
{
    const Vec3 w = cross(n_old, n);
    const double c = 1.0 + dot(n_old, n);
    const Vec3 wf = cross(w, f);
    const Vec3 tilted = c > 1e-6 ? f + wf + cross(w, wf) * (1.0 / c) : f;
    // exact for the angle 2 atan(spin/2), which differs from spin by its cube/12: no length is lost
    const double t = 0.5 * spin;
    const Vec3 nf = cross(n, tilted);
    return tilted + (2.0 * t / (1.0 + t * t)) * (nf + t * cross(n, nf));
}

/// Change of the footprint over the area below which it is round-off: the faces did not slide off each other.
inline constexpr double same_footprint = 1e-12;

struct LinearContact {
    double area_stiffness;  ///< k_c [Pa/m]
    double shear_ratio;     ///< k_s/k_n [-]
    double friction;        ///< mu [-]
    double unload_factor;   ///< C = 1/e^2, 1: elastic [-]
    double damping_ratio;   ///< zeta; hysteretic and viscous parts are alternatives [-]

    GF_FN ContactResponse operator()(const ContactPoint& c, const ContactMotion& m, double dt, ContactHistory& h) const
    {
        ContactResponse r;
        const double k = area_stiffness * h.stiffness_scale;
        const double K = k * c.area;
        const double loading = std::fmax(0.0, k * c.overlap_volume - h.offset_force);
        const double u = loading / K;  // mean penetration of a face, penetration of a point [m]

        double p = loading;
        r.stored = h.offset_force > 0.0 ? 0.5 * loading * u : k * c.overlap_square;
        if (unload_factor > 1.0) {
            const double volume = loading / k;
            if (volume >= h.max_overlap) {
                r.hysteresis_work = std::fmax(0.0, (1.0 - 1.0 / unload_factor) * (r.stored - h.max_energy));
                h.max_overlap = volume;
                h.max_energy = std::fmax(h.max_energy, r.stored);
            } else {
                p = std::fmax(0.0, unload_factor * k * (volume - h.max_overlap * (1.0 - 1.0 / unload_factor)));
            }
            const double share = loading > 0.0 ? p / loading : 0.0;
            r.stored *= share * share / unload_factor;
        }
        const double elastic_force = p, normal_energy = r.stored;
        if (damping_ratio > 0.0) {
            const double v_n = dot(m.velocity, c.normal);
            const double damped = std::fmax(0.0, p - 2.0 * damping_ratio * std::sqrt(K * m.reduced_mass) * v_n);
            r.viscous_force = damped - p;
            p = damped;
        }
        r.normal_force = p;

        const double K_s = shear_ratio * K;
        const Vec3 old_shear =
            tangential(turn_with_contact(h.shear_force, h.normal, c.normal, dot(m.mean_spin, c.normal) * dt), c.normal);
        Vec3 shear = old_shear + (K_s * dt) * tangential(m.velocity, c.normal);
        const double pull = norm(shear);
        if (pull > friction * p) {
            const double slip = K_s > 0.0 ? (pull - friction * p) / K_s : 0.0;
            const Vec3 direction = shear * (1.0 / pull);
            shear = (friction * p) * direction;
            r.friction_work = 0.5 * dot(old_shear + shear, direction) * slip;  // mean of both ends: second order
        }
        if (K_s > 0.0) r.stored += 0.5 * norm2(shear) / K_s;
        if (h.area > 0.0 && std::fabs(c.footprint - h.footprint) > same_footprint * c.area) {
            // The faces slid along each other: the overlap stores more or less over the new area though nothing pushed
            // along the slide. What the normal force did not do, and the shear spring's change of stiffness, is booked.
            const double pushed = -0.5 * (h.elastic_force + elastic_force) * dot(m.velocity, c.normal) * dt;
            r.inserted_work = normal_energy - h.normal_energy + r.hysteresis_work - pushed;
            if (K_s > 0.0)
                r.inserted_work += 0.5 * norm2(h.shear_force) * (1.0 / K_s - 1.0 / (shear_ratio * k * h.area));
        }

        const double polar = 0.5 * c.area * c.twist_radius * c.twist_radius;
        const double K_t = shear_ratio * k * polar;
        double twist = 0.0;
        if (K_t > 0.0) {
            twist = h.twist_moment + K_t * m.twist_rate * dt;
            const double cap = 2.0 / 3.0 * friction * p * c.twist_radius;
            if (std::fabs(twist) > cap) {
                const double kept = twist > 0.0 ? cap : -cap;
                r.friction_work += 0.5 * (h.twist_moment + kept) * (twist - kept) / K_t;
                twist = kept;
            }
            r.stored += 0.5 * twist * twist / K_t;
        }
        h.shear_force = shear;
        h.twist_moment = twist;
        h.normal = c.normal;
        h.area = c.area;
        h.footprint = c.footprint;
        h.normal_energy = normal_energy;
        h.elastic_force = elastic_force;
        r.twist_moment = twist;
        r.force = p * c.normal - shear;
        return r;
    }
};

}  // namespace grainfrac
