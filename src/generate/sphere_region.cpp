// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/sphere_region.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainfrac {

int axis_index(const std::string& name)
{
    return name == "x" ? 0 : (name == "y" ? 1 : 2);
}

SphereRegion::SphereRegion(const RegionSpec& spec)
    : center(spec.center), half(0.5 * spec.size), radius(0.5 * spec.diameter), axis(axis_index(spec.axis))
{
    if (spec.shape == "cylinder" || spec.shape == "disc") {
        shape = Shape::cylinder;
        half = {radius, radius, radius};
        half[axis] = 0.5 * spec.height;
    } else if (spec.shape == "sphere") {
        shape = Shape::ball;
        half = {radius, radius, radius};
    }
}

double SphereRegion::volume() const
{
    constexpr double pi = std::numbers::pi;
    if (shape == Shape::cylinder) return pi * radius * radius * 2.0 * half[axis];
    if (shape == Shape::ball) return 4.0 / 3.0 * pi * radius * radius * radius;
    return 8.0 * half.x * half.y * half.z;
}

double SphereRegion::thinnest() const
{
    return 2.0 * std::min({half.x, half.y, half.z});
}

bool SphereRegion::contains(const Vec3& x) const
{
    const double slack = 1e-9 * norm(half);  // a site that is meant to lie on the surface does, but for round-off
    Vec3 r = x - center;
    if (shape == Shape::ball) return norm(r) <= radius + slack;
    if (shape == Shape::cylinder) {
        const double along = std::fabs(r[axis]);
        r[axis] = 0.0;
        return along <= half[axis] + slack && norm(r) <= radius + slack;
    }
    return std::fabs(r.x) <= half.x + slack && std::fabs(r.y) <= half.y + slack && std::fabs(r.z) <= half.z + slack;
}

Vec3 SphereRegion::shift_inside(const Vec3& x, double r) const
{
    const Vec3 at = x - center;
    const auto along = [&](int k) { return std::clamp(at[k], -(half[k] - r), half[k] - r) - at[k]; };
    const auto inwards = [&](const Vec3& a) {
        const double n = norm(a);
        return n > radius - r ? ((radius - r) / n - 1.0) * a : Vec3{};
    };
    if (shape == Shape::ball) return inwards(at);
    if (shape == Shape::cylinder) {
        Vec3 across = at;
        across[axis] = 0.0;
        Vec3 shift = inwards(across);
        shift[axis] = along(axis);
        return shift;
    }
    return {along(0), along(1), along(2)};
}

double SphereRegion::surface() const
{
    constexpr double pi = std::numbers::pi;
    if (shape == Shape::cylinder) return 2.0 * pi * radius * (radius + 2.0 * half[axis]);
    if (shape == Shape::ball) return 4.0 * pi * radius * radius;
    return 8.0 * (half.x * half.y + half.y * half.z + half.z * half.x);
}

}  // namespace grainfrac
