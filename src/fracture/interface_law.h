// SPDX-License-Identifier: GPL-3.0-or-later
// Cohesive law of one interface point: onset, damage, friction.
//
//   t = n [(1-D) k_n <d_n> - k_n <-d_n>] + (1-D) k_s d_t + D t_fr        contact in compression is never damaged
//   t_fr = k_s (d_t - d_sl),  |t_fr| <= mu_r (k_n <-d_n> + p) + tau_r    d_sl: slip, starts at d_t of the onset
//   Y = k_n <d_n>^2 + k_s |d_t|^2,  lambda = sqrt(Y),  B = k_s |d_t|^2 / Y
//   D = lambda_f (lambda - lambda_0) / (lambda (lambda_f - lambda_0)),   lambda_f = 2 G_c(B) / lambda_0
//
// The energy norm lambda makes the dissipation of any proportional opening G_c(B) exactly, whatever k_n/k_s and
// G_I/G_II are. Onset surfaces and mode mix: Camacho and Ortiz (1996); Benzeggagh and Kenane (1996); friction in
// parallel with damage: Alfano and Sacco (2006). Deviation: lambda_0 is frozen at lambda/phi, the state at which the
// surface was met, so that a step that overshoots the onset lands on the envelope and dissipates no less.
#pragma once

#include "geometry/vec3.h"
#include "gpu/function.h"

#include <cmath>

namespace grainfrac {

enum class OnsetSurface { mohr_coulomb, quadratic };
enum class Softening { brittle, bilinear };
enum class FailureUnit { unbreakable, point, face };
enum class MixedMode { benzeggagh_kenane, power };

/// State of one point; see PointHistories for units.
struct InterfacePointState {
    double damage = 0.0;   ///< D [-]
    double onset = 0.0;    ///< lambda_0, 0 before onset [sqrt(J)/m]
    double failure = 0.0;  ///< lambda_f; lambda_0 where the point broke at once [sqrt(J)/m]
    double slip1 = 0.0;    ///< d_sl on the first tangent [m]
    double slip2 = 0.0;    ///< on the second [m]
};

/// Displacement jump in the frame of the interface.
struct InterfaceJump {
    double n = 0.0;   ///< opening, negative when closed [m]
    double s1 = 0.0;  ///< sliding along the first tangent [m]
    double s2 = 0.0;  ///< along the second [m]
};

/// What the point does now; works are those of this step, all per area.
struct InterfaceResponse {
    double normal = 0.0;         ///< traction of b on a along n, positive in tension [Pa]
    double shear1 = 0.0;         ///< along the first tangent [Pa]
    double shear2 = 0.0;         ///< along the second [Pa]
    double stored = 0.0;         ///< [J/m^2]
    double fracture_work = 0.0;  ///< [J/m^2]
    double friction_work = 0.0;  ///< [J/m^2]
    double shear_share = 0.0;    ///< B times the increase of D [-]
};

struct InterfaceLaw {
    double tensile_strength;     ///< sigma_c [Pa]
    double cohesion;             ///< c [Pa]
    double friction;             ///< tan(phi) of the onset surface [-]
    double residual_friction;    ///< mu_r, <= friction or damage under pressure could release energy [-]
    double residual_shear;       ///< tau_r of broken points without pressure [Pa]
    double fracture_energy_I;    ///< G_I [J/m^2]
    double fracture_energy_II;   ///< G_II [J/m^2]
    double mixed_mode_exponent;  ///< eta or alpha [-]
    OnsetSurface onset;
    Softening softening;
    FailureUnit failure;
    MixedMode mixed_mode;

    /// True if the traction (sigma tension positive, tau^2) lies inside the onset surface: onset_factor() < 1 without a
    /// root or a division, since nearly every point of every step asks.
    GF_FN bool below_onset(double sigma, double tau2, double strength) const
    {
        const double c = cohesion * strength, sigma_c = tensile_strength * strength;
        if (onset == OnsetSurface::quadratic && sigma >= 0.0) {
            return sigma * sigma * c * c + tau2 * sigma_c * sigma_c < sigma_c * sigma_c * c * c;
        }
        const double most_shear = c - sigma * friction;
        return sigma < sigma_c && most_shear > 0.0 && tau2 < most_shear * most_shear;
    }

    /// phi >= 1: the effective traction (sigma tension positive, tau >= 0) lies on or beyond the onset surface scaled
    /// by `strength`.
    GF_FN double onset_factor(double sigma, double tau, double strength) const
    {
        const double c = cohesion * strength;
        if (sigma < 0.0) return tau / (c - sigma * friction);
        const double in_tension = sigma / (tensile_strength * strength);
        if (onset == OnsetSurface::quadratic) {
            const double in_shear = tau / c;
            return std::sqrt(in_tension * in_tension + in_shear * in_shear);
        }
        return larger(in_tension, (tau + sigma * friction) / c);
    }

    /// G_c at mode mix B in [0, 1] (0: opening) [J/m^2].
    GF_FN double fracture_energy(double B) const
    {
        const double e = mixed_mode_exponent;
        if (mixed_mode == MixedMode::benzeggagh_kenane) {
            const double weight = e == 2.0 ? B * B : std::pow(B, e);
            return fracture_energy_I + (fracture_energy_II - fracture_energy_I) * weight;
        }
        if (e == 1.0) return 1.0 / ((1.0 - B) / fracture_energy_I + B / fracture_energy_II);
        return std::pow(std::pow((1.0 - B) / fracture_energy_I, e) + std::pow(B / fracture_energy_II, e), -1.0 / e);
    }

    /// Largest friction of a broken point that is pressed by its own closing and from outside [Pa].
    GF_FN double friction_cap(double pressed, double pressure) const
    {
        return residual_friction * (pressed + pressure) + residual_shear;
    }

    /// lambda at which a point goes on to soften [sqrt(J)/m]; only of points past their onset.
    GF_FN static double softening_threshold(const InterfacePointState& p)
    {
        return p.failure * p.onset / (p.failure - p.damage * (p.failure - p.onset));
    }

    /// Traction for the jump `d` and the new state. Dissipation is booked with the mean over the step from `before`, so
    /// that the energy account closes to second order even when the traction drops at once.
    /// @param k_n, k_s stiffness per area [Pa/m]  @param strength, toughness scatter factors [-]
    /// @param may_start false: no new onset this step (whole-face law decides, or fracture is off)
    /// @param fail break now, whatever the onset surface says
    /// @param may_soften false: damage stays as it is  @param pressure on the face from outside, for friction [Pa]
    GF_FN InterfaceResponse operator()(const InterfaceJump& d, const InterfaceJump& before, double k_n, double k_s,
                                       double strength, double toughness, bool may_start, bool fail,
                                       InterfacePointState& p, bool may_soften = true, double pressure = 0.0) const
    {
        const double d_n = d.n, d_1 = d.s1, d_2 = d.s2;
        const double slid2 = d_1 * d_1 + d_2 * d_2;
        if (p.onset == 0.0 && !fail && (!may_start || below_onset(k_n * d_n, k_s * k_s * slid2, strength))) {
            InterfaceResponse whole;
            whole.normal = k_n * d_n;
            whole.shear1 = k_s * d_1;
            whole.shear2 = k_s * d_2;
            whole.stored = 0.5 * (k_n * d_n * d_n + k_s * slid2);
            return whole;
        }
        const double opening = d_n > 0.0 ? d_n : 0.0;
        const double closing = d_n < 0.0 ? -d_n : 0.0;
        const double shear_energy = k_s * slid2;
        const double Y = k_n * opening * opening + shear_energy;
        const double lambda = std::sqrt(Y);
        InterfaceResponse r;

        double new_damage = p.damage;
        if (p.onset == 0.0 && Y > 0.0) {
            const double phi = may_start ? onset_factor(k_n * d_n, std::sqrt(k_s * shear_energy), strength) : 0.0;
            if (phi >= 1.0 || fail) {
                p.onset = phi >= 1.0 ? lambda / phi : lambda;
                p.failure = softening == Softening::bilinear
                                ? 2.0 * toughness * fracture_energy(shear_energy / Y) / p.onset
                                : 0.0;
                p.slip1 = d_1;
                p.slip2 = d_2;
            }
        }
        if (p.onset > 0.0 && p.damage < 1.0 && may_soften) {
            if (p.failure <= p.onset) {
                new_damage = 1.0;  // brittle, or confinement raised the onset above what G_c can carry
            } else if (lambda > p.onset) {
                const double envelope = p.failure * (lambda - p.onset) / (lambda * (p.failure - p.onset));
                new_damage = larger(p.damage, smaller(1.0, envelope));
            }
        }

        // friction: elastic slip s = d_t - d_sl, returned to the Coulomb cap
        double s_1 = d_1 - p.slip1, s_2 = d_2 - p.slip2;
        if (p.onset > 0.0) {
            const double cap = friction_cap(k_n * closing, pressure) / k_s;  // as a slip [m]
            const double length = std::sqrt(s_1 * s_1 + s_2 * s_2);
            if (length > cap) {
                const double lost = 1.0 - cap / length;
                const double slid_1 = lost * s_1, slid_2 = lost * s_2;
                s_1 -= slid_1;
                s_2 -= slid_2;
                p.slip1 = d_1 - s_1;
                p.slip2 = d_2 - s_2;
                // mean friction over the step times the slip; the elastic slip before cannot have been beyond its own
                // cap
                double b_1 = before.s1 - (p.slip1 - slid_1), b_2 = before.s2 - (p.slip2 - slid_2);
                const double cap_before = friction_cap(before.n < 0.0 ? -k_n * before.n : 0.0, pressure) / k_s;
                const double length_before = std::sqrt(b_1 * b_1 + b_2 * b_2);
                if (length_before > cap_before) {
                    b_1 *= cap_before / length_before;
                    b_2 *= cap_before / length_before;
                }
                r.friction_work = new_damage * k_s * larger(0.0, 0.5 * ((b_1 + s_1) * slid_1 + (b_2 + s_2) * slid_2));
            }
        }
        const double friction_energy = k_s * (s_1 * s_1 + s_2 * s_2);

        if (new_damage > p.damage) {
            // int 1/2 Y dD: with the mean of Y where D jumps, in closed form along the bilinear envelope, so that G_c
            // is met whatever the step
            const double opening_before = before.n > 0.0 ? before.n : 0.0;
            const double Y_before =
                k_n * opening_before * opening_before + k_s * (before.s1 * before.s1 + before.s2 * before.s2);
            double released = 0.25 * (Y + Y_before) * (new_damage - p.damage);
            if (p.failure > p.onset) released = envelope_work(new_damage, p) - envelope_work(p.damage, p);
            r.fracture_work = released - 0.5 * friction_energy * (new_damage - p.damage);
            r.shear_share = (Y > 0.0 ? shear_energy / Y : 0.0) * (new_damage - p.damage);
            p.damage = new_damage;
        }

        const double whole = 1.0 - p.damage;
        r.normal = whole * k_n * opening - k_n * closing;
        r.shear1 = k_s * (whole * d_1 + (p.onset > 0.0 ? p.damage * s_1 : 0.0));
        r.shear2 = k_s * (whole * d_2 + (p.onset > 0.0 ? p.damage * s_2 : 0.0));
        r.stored =
            0.5 * whole * Y + 0.5 * k_n * closing * closing + (p.onset > 0.0 ? 0.5 * p.damage * friction_energy : 0.0);
        return r;
    }

    /// int_0^D 1/2 Y dD along the envelope, up to a constant: 1/2 lambda_f lambda_0/(lambda_f - lambda_0) lambda(D).
    GF_FN static double envelope_work(double damage, const InterfacePointState& p)
    {
        const double lambda = p.failure * p.onset / (p.failure - damage * (p.failure - p.onset));
        return 0.5 * p.failure * p.onset / (p.failure - p.onset) * lambda;
    }
};

}  // namespace grainfrac
