// SPDX-License-Identifier: GPL-3.0-or-later
// Strength of a circular parallel bond (Potyondy and Cundall 2004, IJRMMS 41, 1329-1364).
#pragma once

#include "geometry/vec3.h"

#include <numbers>

namespace grainfrac {

/// Section constants of a circle of radius R [m].
struct CircularSection {
    double area;     ///< A [m^2]
    double bending;  ///< I [m^4]
    double polar;    ///< J = 2 I [m^4]
    GF_FN explicit CircularSection(double R)
        : area(std::numbers::pi * R * R), bending(0.25 * area * R * R), polar(2.0 * bending)
    {
    }
};

enum class BondCause { whole = 0, tension = 1, shear = 2 };

struct ParallelLaw {
    double tensile_strength;     ///< sigma_c [Pa]
    double cohesion;             ///< c [Pa]
    double friction;             ///< tan(phi) [-]
    double moment_contribution;  ///< beta in [0, 1] [-]
    bool separate_limits;        ///< true: Saleme Ruiz (2.15), (2.16): each resultant has its own limit
    bool breakable;

    /// Peak stresses sigma = F_n/A + beta |M_s| R/I against sigma_c, tau = |F_s|/A + beta |M_n| R/J against
    /// c - sigma_n tan(phi). `force` and `moment` act on a; n points from a to b, so F.n > 0 is tension.
    GF_FN BondCause broken(const Vec3& force, const Vec3& moment, const Vec3& n, double R, double strength) const
    {
        if (!breakable) return BondCause::whole;
        const CircularSection s(R);
        const double f_n = dot(force, n), f_s = norm(tangential(force, n));
        const double m_n = std::fabs(dot(moment, n)), m_s = norm(tangential(moment, n));
        const double sigma_c = tensile_strength * strength, c = cohesion * strength;
        if (separate_limits) {
            if (f_n >= sigma_c * s.area || m_s >= sigma_c * s.bending / R) return BondCause::tension;
            return f_s >= c * s.area || m_n >= c * s.polar / R ? BondCause::shear : BondCause::whole;
        }
        const double sigma = f_n / s.area;
        if (sigma + moment_contribution * m_s * R / s.bending >= sigma_c) return BondCause::tension;
        const double tau = f_s / s.area + moment_contribution * m_n * R / s.polar;
        return tau >= c - sigma * friction ? BondCause::shear : BondCause::whole;
    }
};

}  // namespace grainfrac
