// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of two bodies that are not bonded: linear in the overlap, hysteretic or viscous, Coulomb friction.
//
//   overlap    h = <sqrt(2 U) - h_0>, U the potential of the manifold: h^2 = A g^2 for faces pressed by g
//   loading    E = k_c h^2/2
//   unloading  E = C k_c <h - h_p>^2/2,  h_p = h_max (1 - 1/C), C = 1/e^2  (Walton and Braun 1986)
//   normal     p = dE/dh |dh/dx|: k_c A g, and C k_c A (g - g_p); its couple by the same rule. E is a function of the
//              position on either branch, so a contact whose area changes makes no energy; what loading takes is lost.
//   viscous    p = <p_s - c_n v_n>,  c_n = 2 zeta sqrt(K m*), K = k_c A
//   shear      F_t += K_s v_t dt, |F_t| <= mu p;  F_t is a history and turns with the contact (Rodrigues form)
//   twist      about the normal of an area contact, M += k_s J w_n dt, |M| <= 2/3 mu p R
// A spring whose area grows keeps its force, one whose area shrinks its stretch: both lose energy, to friction (the new
// part is unstretched, the lost part slips).
#pragma once

#include "geometry/vec3.h"
#include "model/contacts.h"
#include "model/lanes.h"

namespace grainfrac {

/// History of one contact; see Contacts for units.
struct ContactHistory {
    Vec3 shear_force;
    Vec3 normal;
    double twist_moment = 0.0;
    double max_overlap = 0.0;
    double offset_overlap = 0.0;
    double stiffness_scale = 1.0;
    double shear_stiffness = 0.0;
    double twist_stiffness = 0.0;

    template <class Visit>
    constexpr void for_each_number(Visit&& visit)
    {
        const auto all = [&](auto&... x) { (grainfrac::for_each_number(x, visit), ...); };
        all(shear_force, normal, twist_moment, max_overlap, offset_overlap, stiffness_scale, shear_stiffness,
            twist_stiffness);
    }
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
    double couple = 0.0;           ///< on b about n; a gets the opposite [N m]
    double normal_force = 0.0;     ///< p [N]
    double viscous_force = 0.0;    ///< on b along n [N]
    double stored = 0.0;           ///< [J]
    double friction_work = 0.0;    ///< of this step [J]
    double hysteresis_work = 0.0;  ///< of this step [J]
};

/// Turn a vector with the contact: tilt n_old -> n, then spin about n (angle [rad], small).
GF_FN Vec3 turn_with_contact(const Vec3& f, const Vec3& n_old, const Vec3& n, double spin)
{
    const Vec3 w = cross(n_old, n);
    const double c = 1.0 + dot(n_old, n), carried = c > 1e-6 ? 1.0 : 0.0;  // opposite normals: nothing to follow
    const Vec3 wf = carried * cross(w, f);
    const Vec3 tilted = f + wf + cross(w, wf) * (c > 1e-6 ? 1.0 / c : 0.0);
    // exact for the angle 2 atan(spin/2), which differs from spin by its cube/12: no length is lost
    const double t = 0.5 * spin;
    const Vec3 nf = cross(n, tilted);
    return tilted + (2.0 * t / (1.0 + t * t)) * (nf + t * cross(n, nf));
}

/// A handed-over contact may be stiffer than its law by this factor at most; beyond it the geometry of the two laws has
/// little in common and a force jump is the lesser evil (the time step would suffer).
inline constexpr double most_stiffness_scale = 4.0;

/// Offset and stiffness of a contact that takes over with the force `pressed`, where its law alone would press `own`.
/// It was loaded to where it is by what it takes over from: hysteresis has nothing to lose on the way there.
GF_FN void match_force(double pressed, double own, const ContactPoint& c, double& offset_overlap,
                       double& stiffness_scale, double& max_overlap)
{
    const double root = std::sqrt(2.0 * c.overlap_energy);
    if (pressed <= own)
        offset_overlap = (1.0 - pressed / own) * root;
    else
        stiffness_scale = smaller(most_stiffness_scale, pressed / own);
    max_overlap = larger(0.0, root - offset_overlap);
}

/// What a spring keeps of its force when its stiffness goes from `before` to `now`, and the energy that is lost.
struct ReshapedSpring {
    double share = 1.0, lost = 0.0;

    GF_FN ReshapedSpring(double force2, double before, double now)
    {
        if (before <= 0.0) return;
        share = smaller(1.0, now / before);
        lost = 0.5 * force2 * (1.0 / before - (now > 0.0 ? share * share / now : 0.0));
    }
};

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
        const double root = std::sqrt(2.0 * c.overlap_energy);
        const double overlap = larger(0.0, root - h.offset_overlap);

        double stiffness = k, rest = 0.0;  // E = stiffness/2 (overlap - rest)^2
        if (unload_factor > 1.0) {
            const double lost = 1.0 - 1.0 / unload_factor;
            if (overlap > h.max_overlap) {
                r.hysteresis_work = 0.5 * k * lost * (overlap * overlap - h.max_overlap * h.max_overlap);
                h.max_overlap = overlap;
            }
            stiffness = unload_factor * k;  // on the loading branch both give the same force
            rest = h.max_overlap * lost;
        }
        const double stretch = larger(0.0, overlap - rest);
        r.stored = 0.5 * stiffness * stretch * stretch;
        const double scale = stiffness * stretch / root;
        double p = scale * c.overlap_force;
        if (damping_ratio > 0.0) {
            const double v_n = dot(m.velocity, c.normal);
            const double damped = larger(0.0, p - 2.0 * damping_ratio * std::sqrt(K * m.reduced_mass) * v_n);
            r.viscous_force = damped - p;
            p = damped;
        }
        r.normal_force = p;

        const double K_s = shear_ratio * K;
        const ReshapedSpring shear_spring(norm2(h.shear_force), h.shear_stiffness, K_s);
        r.friction_work = shear_spring.lost;
        const Vec3 old_shear =
            shear_spring.share *
            tangential(turn_with_contact(h.shear_force, h.normal, c.normal, dot(m.mean_spin, c.normal) * dt), c.normal);
        Vec3 shear = old_shear + (K_s * dt) * tangential(m.velocity, c.normal);
        const double pull = norm(shear);
        if (pull > friction * p) {
            const double slip = K_s > 0.0 ? (pull - friction * p) / K_s : 0.0;
            const Vec3 direction = shear * (1.0 / pull);
            shear = (friction * p) * direction;
            r.friction_work += 0.5 * dot(old_shear + shear, direction) * slip;  // mean of both ends: second order
        }
        if (K_s > 0.0) r.stored += 0.5 * norm2(shear) / K_s;

        const double polar = 0.5 * c.area * c.twist_radius * c.twist_radius;
        const double K_t = shear_ratio * k * polar;
        const ReshapedSpring twist_spring(h.twist_moment * h.twist_moment, h.twist_stiffness, K_t);
        r.friction_work += twist_spring.lost;
        double twist = 0.0;
        if (K_t > 0.0) {
            const double old_twist = twist_spring.share * h.twist_moment;
            twist = old_twist + K_t * m.twist_rate * dt;
            const double cap = 2.0 / 3.0 * friction * p * c.twist_radius;
            if (std::fabs(twist) > cap) {
                const double kept = twist > 0.0 ? cap : -cap;
                r.friction_work += 0.5 * (old_twist + kept) * (twist - kept) / K_t;
                twist = kept;
            }
            r.stored += 0.5 * twist * twist / K_t;
        }
        h.shear_force = shear;
        h.shear_stiffness = K_s;
        h.twist_moment = twist;
        h.twist_stiffness = K_t;
        h.normal = c.normal;
        r.couple = scale * c.overlap_couple - twist;
        r.force = p * c.normal - shear;
        return r;
    }
};

}  // namespace grainfrac
