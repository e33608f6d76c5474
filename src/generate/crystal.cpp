// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/crystal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace grainfrac {

namespace {

/// Six turns about c and six half turns about the a and [10-10] directions.
std::array<Quat, 12> hexagonal_symmetry()
{
    std::array<Quat, 12> s;
    for (int k = 0; k < 6; ++k) {
        const double angle = k * std::numbers::pi / 3.0;
        s[static_cast<std::size_t>(k)] = from_axis_angle({0, 0, 1}, angle);
        s[static_cast<std::size_t>(k) + 6] =
            from_axis_angle({std::cos(0.5 * angle), std::sin(0.5 * angle), 0}, std::numbers::pi);
    }
    return s;
}

}  // namespace

double hexagonal_misorientation(const Quat& q_a, const Quat& q_b)
{
    static const std::array<Quat, 12> symmetry = hexagonal_symmetry();
    const Quat between = conjugate(q_a) * q_b;
    double least = std::numbers::pi;
    for (const Quat& s : symmetry) least = std::min(least, norm(rotation_vector(between * s)));
    return least;
}

double read_shockley(double theta, double theta_m)
{
    if (theta >= theta_m) return 1.0;
    if (theta <= 0.0) return 0.0;
    const double t = theta / theta_m;
    return t * (1.0 - std::log(t));
}

double boundary_toughness_factor(double theta, double theta_m, double chi)
{
    return 1.0 - chi * read_shockley(theta, theta_m);
}

}  // namespace grainfrac
