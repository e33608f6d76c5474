// SPDX-License-Identifier: GPL-3.0-or-later
// Unit quaternions as rotations, body to world.
#pragma once

#include "geometry/mat3.h"

namespace grainfrac {

struct Quat {
    double w = 1.0, x = 0.0, y = 0.0, z = 0.0;
    friend bool operator==(const Quat&, const Quat&) = default;
};

GF_FN Quat operator*(const Quat& a, const Quat& b)
{
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
GF_FN Quat conjugate(const Quat& q)
{
    return {q.w, -q.x, -q.y, -q.z};
}
GF_FN Quat normalized(const Quat& q)
{
    const double s = 1.0 / std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.w * s, q.x * s, q.y * s, q.z * s};
}
/// q a q*, for a unit quaternion.
GF_FN Vec3 rotate(const Quat& q, const Vec3& a)
{
    const Vec3 u{q.x, q.y, q.z};
    const Vec3 t = 2.0 * cross(u, a);
    return a + q.w * t + cross(u, t);
}
/// q* a q: world to body.
GF_FN Vec3 rotate_back(const Quat& q, const Vec3& a)
{
    return rotate(conjugate(q), a);
}
GF_FN Mat3 to_matrix(const Quat& q)
{
    const double x = 2.0 * q.x, y = 2.0 * q.y, z = 2.0 * q.z;
    const double xx = x * q.x, yy = y * q.y, zz = z * q.z, xy = x * q.y, yz = y * q.z, zx = z * q.x;
    const double wx = x * q.w, wy = y * q.w, wz = z * q.w;
    return {{{1.0 - yy - zz, xy - wz, zx + wy}, {xy + wz, 1.0 - zz - xx, yz - wx}, {zx - wy, yz + wx, 1.0 - xx - yy}}};
}
struct SineCosine {
    double sine, cosine;
};
/// Of the turns of a time step, which are small, from their series: the terms left out are below 1e-18 of what is kept.
/// The same bits on any device.
GF_FN SineCosine sine_cosine(double angle)
{
    if (std::fabs(angle) > 0.06) return {std::sin(angle), std::cos(angle)};
    const double x2 = angle * angle;
    const double s = 1.0 / 6.0 - x2 * (1.0 / 120.0 - x2 * (1.0 / 5040.0 - x2 * (1.0 / 362880.0)));
    const double c = 1.0 / 2.0 - x2 * (1.0 / 24.0 - x2 * (1.0 / 720.0 - x2 * (1.0 / 40320.0 - x2 * (1.0 / 3628800.0))));
    return {angle - angle * x2 * s, 1.0 - x2 * c};
}
/// Rotation by `angle` [rad] about the unit vector `axis`.
GF_FN Quat from_axis_angle(const Vec3& axis, double angle)
{
    const SineCosine half = sine_cosine(0.5 * angle);
    return {half.cosine, half.sine * axis.x, half.sine * axis.y, half.sine * axis.z};
}
/// Rotation vector (axis times angle [rad], angle in [0, pi]) of a unit quaternion.
GF_FN Vec3 rotation_vector(const Quat& q)
{
    const Vec3 u = q.w < 0.0 ? Vec3{-q.x, -q.y, -q.z} : Vec3{q.x, q.y, q.z};
    const double s = norm(u);
    if (s == 0.0) return {};
    return (2.0 * std::atan2(s, std::fabs(q.w)) / s) * u;
}

/// Unit quaternion of a proper rotation matrix (Shepperd's choice of the largest component).
GF_FN Quat from_matrix(const Mat3& m)
{
    const double t = trace(m);
    Quat q;
    if (t > 0.0) {
        q = {1.0 + t, m[2].y - m[1].z, m[0].z - m[2].x, m[1].x - m[0].y};
    } else if (m[0].x >= m[1].y && m[0].x >= m[2].z) {
        q = {m[2].y - m[1].z, 1.0 + m[0].x - m[1].y - m[2].z, m[0].y + m[1].x, m[0].z + m[2].x};
    } else if (m[1].y >= m[2].z) {
        q = {m[0].z - m[2].x, m[0].y + m[1].x, 1.0 - m[0].x + m[1].y - m[2].z, m[1].z + m[2].y};
    } else {
        q = {m[1].x - m[0].y, m[0].z + m[2].x, m[1].z + m[2].y, 1.0 - m[0].x - m[1].y + m[2].z};
    }
    return normalized(q);
}

}  // namespace grainfrac
