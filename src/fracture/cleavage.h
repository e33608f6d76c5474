// SPDX-License-Identifier: GPL-3.0-or-later
// Does a grain split along a plane? Stress intensities of a flaw in the plane, a criterion in them, and a cheap filter.
//
//   K_I = Y sigma sqrt(pi a) where sigma > 0, else 0;   K_II, K_III likewise from
//   tau_eff = |tau| where the flaw is open, <|tau| - mu |sigma|> where it is closed
// Criteria, each as the factor f by which the load would have to be divided to just meet it: f >= 1 splits, and f of
// twice the load is 2 f.
//   ellipse   f^2 = (K_I/K_c)^2 + (K_II/(C K_c))^2                       Saleme Ruiz 2016 (3.25)
//   shetty    (K_I/f)/K_c + (K_II/(C K_c f))^2 = 1                       Shetty 1987, J. Eng. Gas Turb. Power 109, 282
//   energy    f^2 = [(1 - nu^2)(K_I^2 + K_II^2) + (1 + nu) K_III^2]/(E G_c)
// Source of the flaws: Tada, Paris and Irwin. Corrected in Saleme Ruiz 2016 (3.24), (3.25): tractions are stresses
// already; both bending moments count, the torque about the normal is shear; a closed flaw has no K_I; Y is 1.12 for an
// edge crack and 1 for the through crack 2a.
#pragma once

#include "fracture/traction_field.h"

#include <cmath>
#include <numbers>

namespace grainfrac {

enum class FlawShape {
    through,  ///< through crack of length 2a, Y = 1
    edge,     ///< edge crack of depth a, Y = 1.12
    penny,    ///< circular crack of radius a, Y = 2/pi
};
enum class CleavageCriterion { ellipse, shetty, energy };

/// Flaws longer than this share of the least width of the plane are out of range of the formulas for an infinite body
/// [-].
inline constexpr double most_flaw_share = 0.25;
/// The factor for finite width, infinite at a = W/2, stays what it is at this a/W [-].
inline constexpr double last_finite_width = 0.45;

/// What a flaw feels and how near it is to running.
struct Cleavage {
    double f = 0.0;      ///< load over the load that splits [-]
    double K_I = 0.0;    ///< [Pa sqrt(m)]
    double K_II = 0.0;   ///< largest along the front [Pa sqrt(m)]
    double K_III = 0.0;  ///< largest along the front, a quarter turn away for a penny [Pa sqrt(m)]
    Vec3 where;          ///< position of the flaw [m]
};

/// Cleavage along one family of planes.
struct CleavageLaw {
    double toughness = 0.0;        ///< K_c [Pa sqrt(m)]
    double mode_ratio = 1.0;       ///< C = K_IIc/K_c, >= 1 for what shear hardly opens [-]
    double flaw_size = 0.0;        ///< a [m]
    double friction = 0.0;         ///< mu of closed flaws [-]
    double poisson_ratio = 0.0;    ///< nu [-]
    double young_modulus = 0.0;    ///< E, `energy` only [Pa]
    double fracture_energy = 0.0;  ///< G_c, `energy` only [J/m^2]
    FlawShape flaw = FlawShape::through;
    CleavageCriterion criterion = CleavageCriterion::ellipse;
    bool finite_width = false;  ///< K from the width of the plane; for flaws beyond most_flaw_share of it

    /// Y [-]
    GF_FN double mode_I_factor() const
    {
        return flaw == FlawShape::through ? 1.0 : (flaw == FlawShape::edge ? 1.12 : 2.0 / std::numbers::pi);
    }
    /// K over K in an infinite body: sqrt(W/(pi a) tan(pi a/W)) for a crack 2a in the width W, in tension as in shear
    /// (collinear cracks). An edge crack is half of a crack in twice the width; for a penny the factor is an upper
    /// bound.
    GF_FN double width_factor(double width) const
    {
        if (!finite_width) return 1.0;
        const double share = std::fmin(last_finite_width, flaw_size / (flaw == FlawShape::edge ? 2.0 * width : width));
        const double angle = std::numbers::pi * share;
        return share > 0.0 ? std::sqrt(std::tan(angle) / angle) : 1.0;
    }
    /// K_I at which tension alone runs the flaw [Pa sqrt(m)].
    GF_FN double opening_toughness() const
    {
        if (criterion != CleavageCriterion::energy) return toughness;
        return std::sqrt(young_modulus * fracture_energy / (1.0 - poisson_ratio * poisson_ratio));
    }
    /// Normal stress that splits a wide plane without shear: sigma_th [Pa].
    GF_FN double threshold_stress() const
    {
        return opening_toughness() / (mode_I_factor() * std::sqrt(std::numbers::pi * flaw_size));
    }

    /// @param sigma normal stress on the plane, tension positive [Pa]  @param tau shear stress >= 0 [Pa]
    /// @param width least width of the plane, for `finite_width` [m]
    GF_FN Cleavage operator()(double sigma, double tau, double width) const
    {
        Cleavage c;
        const double root = width_factor(width) * std::sqrt(std::numbers::pi * flaw_size);
        const double sliding = sigma > 0.0 ? tau : std::fmax(0.0, tau + friction * sigma);
        c.K_I = mode_I_factor() * std::fmax(0.0, sigma) * root;
        if (flaw == FlawShape::penny) {
            c.K_II = 4.0 / (std::numbers::pi * (2.0 - poisson_ratio)) * sliding * root;
            c.K_III = (1.0 - poisson_ratio) * c.K_II;
        } else {
            c.K_II = mode_I_factor() * sliding * root;
        }
        c.f = load_factor(c.K_I, c.K_II, c.K_III);
        return c;
    }

    /// f of the criterion, from the largest K along the front.
    GF_FN double load_factor(double K_I, double K_II, double K_III) const
    {
        if (criterion == CleavageCriterion::energy) {
            // Along the front of a penny K_II goes with the cosine and K_III with the sine of one angle: the energy
            // release is largest at an end, where one of them is zero.
            const double nu = poisson_ratio, plane_strain = 1.0 - nu * nu;
            const double shear = std::fmax(plane_strain * K_II * K_II, (1.0 + nu) * K_III * K_III);
            return std::sqrt((plane_strain * K_I * K_I + shear) / (young_modulus * fracture_energy));
        }
        const double x = K_I / toughness, y = K_II / (mode_ratio * toughness);
        if (criterion == CleavageCriterion::ellipse) return std::sqrt(x * x + y * y);
        return 0.5 * (x + std::sqrt(x * x + 4.0 * y * y));  // f^2 - x f - y^2 = 0
    }
};

/// Least width of a convex polygon in a plane with normal n [m].
GF_FN double least_width(const Vec3* corners, int count, const Vec3& n)
{
    double least = 0.0;
    for (int i = 0; i < count; ++i) {
        const Vec3 inward = normalized(cross(n, corners[i + 1 < count ? i + 1 : 0] - corners[i]));
        double width = 0.0;
        for (int k = 0; k < count; ++k) width = std::fmax(width, std::fabs(dot(inward, corners[k] - corners[i])));
        if (width > 0.0 && (least == 0.0 || width < least)) least = width;
    }
    return least;
}

/// A flaw at x in the plane of the field.
GF_FN Cleavage flaw_at(const CleavageLaw& law, const TractionField& field, const Vec3& x, double width)
{
    Cleavage c = law(field.normal_stress(x), norm(field.shear_stress(x)), width);
    c.where = x;
    return c;
}

/// The worst flaw on the edge of the plane's polygon; the first corner of several that are equally bad. Exact for the
/// linear field: each side of the line sigma = 0, f is a convex function of position, so that it is largest at a
/// corner, or, for flaws with friction, where an edge meets that line (without friction f is convex across it too).
GF_FN Cleavage surface_flaw(const CleavageLaw& law, const TractionField& field, const Vec3* corners, int count)
{
    const double width = law.finite_width ? least_width(corners, count, field.n) : 0.0;
    Cleavage worst;
    const auto try_at = [&](const Vec3& x, bool first) {
        const Cleavage c = flaw_at(law, field, x, width);
        if (first || c.f > worst.f) worst = c;
    };
    for (int i = 0; i < count; ++i) try_at(corners[i], i == 0);
    for (int i = 0; i < count && law.friction > 0.0; ++i) {
        const Vec3 &a = corners[i], &b = corners[i + 1 < count ? i + 1 : 0];
        const double sigma_a = field.normal_stress(a), sigma_b = field.normal_stress(b);
        if (sigma_a * sigma_b < 0.0) try_at(crossing_point(a, sigma_a, b, sigma_b), false);
    }
    return worst;
}
/// A flaw inside, at the centroid of the polygon.
GF_FN Cleavage buried_flaw(const CleavageLaw& law, const TractionField& field, const Vec3* corners, int count)
{
    return flaw_at(law, field, field.centroid, law.finite_width ? least_width(corners, count, field.n) : 0.0);
}

/// Principal values of a symmetric matrix, falling (cyclic Jacobi: nothing but + - * / sqrt, so that every device finds
/// the same).
GF_FN Vec3 principal_values(const Mat3& m)
{
    Mat3 a = m;
    constexpr int most_sweeps = 8;  // convergence is quadratic: after five nothing is left of any matrix
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        for (int k = 0; k < 3; ++k) {
            const int p = k == 2 ? 1 : 0, q = k == 0 ? 1 : 2, r = 3 - p - q;
            const double off = a[p][q];
            if (off == 0.0) continue;
            const double theta = (a[q][q] - a[p][p]) / (2.0 * off);
            const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::fabs(theta) + std::sqrt(theta * theta + 1.0));
            const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
            const double to_p = c * a[r][p] - s * a[r][q], to_q = s * a[r][p] + c * a[r][q];
            a[p][p] -= t * off;
            a[q][q] += t * off;
            a[p][q] = a[q][p] = 0.0;
            a[r][p] = a[p][r] = to_p;
            a[r][q] = a[q][r] = to_q;
        }
    }
    const double x = a[0].x, y = a[1].y, z = a[2].z;
    const double high = std::fmax(x, std::fmax(y, z)), low = std::fmin(x, std::fmin(y, z));
    return {high, std::fmax(std::fmin(x, y), std::fmin(std::fmax(x, y), z)), low};
}

/// Which grains are worth the look at their planes. Only a filter on the mean stress of the grain: where tractions vary
/// over the grain by more than their mean, as in a grain bent with little stress in the mean, only `none` is safe.
struct CleavageGate {
    enum class Kind {
        none,
        principal_and_shear,  ///< largest principal stress >= share sigma_th, or largest shear >= share C sigma_th
        hydrostatic,          ///< tr/3 >= hydrostatic_threshold: Saleme Ruiz 2016 (3.22); keeps axial cleavage out
    } kind = Kind::principal_and_shear;
    double share = 0.3;                  ///< chi: below 1/sqrt(2) no plane of a uniformly stressed grain is missed [-]
    double tension_threshold = 0.0;      ///< least sigma_th of the families [Pa]
    double shear_threshold = 0.0;        ///< least C sigma_th of the families [Pa]
    double hydrostatic_threshold = 0.0;  ///< tension positive [Pa]

    /// @param stress mean stress of the grain, symmetric, tension positive [Pa]
    GF_FN bool operator()(const Mat3& stress) const
    {
        if (kind == Kind::none) return true;
        if (kind == Kind::hydrostatic) return trace(stress) / 3.0 >= hydrostatic_threshold;
        const Vec3 s = principal_values(stress);
        return s.x >= share * tension_threshold || 0.5 * (s.x - s.z) >= share * shear_threshold;
    }
};

}  // namespace grainfrac
