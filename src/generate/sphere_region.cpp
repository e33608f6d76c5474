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

Vec3 SphereRegion::drawn_in(const Vec3& x, double r) const
{
    const auto along = [&](double at, int k) { return std::clamp(at, -(half[k] - r), half[k] - r); };
    const auto towards_center = [&](const Vec3& a) {
        const double n = norm(a);
        return n > radius - r ? (radius - r) / n * a : a;
    };
    Vec3 a = x - center;
    if (shape == Shape::ball) return center + towards_center(a);
    if (shape == Shape::cylinder) {
        const double height = along(a[axis], axis);
        a[axis] = 0.0;
        a = towards_center(a);
        a[axis] = height;
        return center + a;
    }
    return center + Vec3{along(a.x, 0), along(a.y, 1), along(a.z, 2)};
}

}  // namespace grainfrac
