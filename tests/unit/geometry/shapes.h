// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes and numbers that several geometry tests use; the same on every machine.
#pragma once

#include "geometry/cut.h"

#include <numbers>
#include <random>

namespace grainfrac::test {

/// std::uniform_real_distribution differs between libraries; this does not.
inline double uniform(std::mt19937_64& random, double low, double high)
{
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

inline Vec3 unit_vector(std::mt19937_64& random)
{
    const double z = uniform(random, -1.0, 1.0), angle = uniform(random, 0.0, 2.0 * std::numbers::pi);
    const double r = std::sqrt(1.0 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

inline Quat rotation(std::mt19937_64& random)
{
    return from_axis_angle(unit_vector(random), uniform(random, 0.0, std::numbers::pi));
}

/// Cube of edge 2 `scale` cut by 4 to 20 planes at 0.4 to 1 scale from its centre.
inline Polyhedron convex_polyhedron(std::mt19937_64& random, double scale = 1.0)
{
    std::vector<Plane> planes;
    const int n = 4 + static_cast<int>(random() % 17);
    for (int i = 0; i < n; ++i) {
        const Vec3 normal = unit_vector(random);
        planes.push_back({normal, scale * uniform(random, 0.4, 1.0)});
    }
    return clip(make_box({2.0 * scale, 2.0 * scale, 2.0 * scale}), planes, 100);
}

}  // namespace grainfrac::test
