// SPDX-License-Identifier: GPL-3.0-or-later
// Plain 3-vectors for kernels. Eigen stays on the host: a kernel with plain structs compiles seven times faster under
// nvcc and has no alignment that depends on compiler flags.
#pragma once

#include "gpu/function.h"

#include <cmath>

namespace grainfrac {

/// Of two numbers; a where one is no number. std::fmax, which may not do so, is a call of the C library.
GF_FN double larger(double a, double b)
{
    return b > a ? b : a;
}
GF_FN double smaller(double a, double b)
{
    return b < a ? b : a;
}

struct Vec3 {
    double x = 0.0, y = 0.0, z = 0.0;

    GF_FN double& operator[](int i) { return i == 0 ? x : (i == 1 ? y : z); }
    GF_FN double operator[](int i) const { return i == 0 ? x : (i == 1 ? y : z); }

    GF_FN Vec3& operator+=(const Vec3& b)
    {
        x += b.x;
        y += b.y;
        z += b.z;
        return *this;
    }
    GF_FN Vec3& operator-=(const Vec3& b)
    {
        x -= b.x;
        y -= b.y;
        z -= b.z;
        return *this;
    }
    GF_FN Vec3& operator*=(double s)
    {
        x *= s;
        y *= s;
        z *= s;
        return *this;
    }
    friend bool operator==(const Vec3&, const Vec3&) = default;
};

GF_FN Vec3 operator+(Vec3 a, const Vec3& b)
{
    return a += b;
}
GF_FN Vec3 operator-(Vec3 a, const Vec3& b)
{
    return a -= b;
}
GF_FN Vec3 operator-(const Vec3& a)
{
    return {-a.x, -a.y, -a.z};
}
GF_FN Vec3 operator*(double s, Vec3 a)
{
    return a *= s;
}
GF_FN Vec3 operator*(Vec3 a, double s)
{
    return a *= s;
}
GF_FN Vec3 operator/(Vec3 a, double s)
{
    return a *= 1.0 / s;
}

GF_FN double dot(const Vec3& a, const Vec3& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
GF_FN Vec3 cross(const Vec3& a, const Vec3& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
GF_FN double norm2(const Vec3& a)
{
    return dot(a, a);
}
GF_FN double norm(const Vec3& a)
{
    return std::sqrt(dot(a, a));
}
/// a/|a|; the zero vector stays zero.
GF_FN Vec3 normalized(const Vec3& a)
{
    const double n = norm(a);
    return a * (n > 0.0 ? 1.0 / n : 1.0);
}
/// Part of a across the unit vector n.
GF_FN Vec3 tangential(const Vec3& a, const Vec3& n)
{
    return a - dot(a, n) * n;
}
/// Some unit vector across the unit vector n, always the same one for the same n.
GF_FN Vec3 any_perpendicular(const Vec3& n)
{
    const double ax = std::fabs(n.x), ay = std::fabs(n.y), az = std::fabs(n.z);
    const Vec3 axis = (ax <= ay && ax <= az) ? Vec3{1, 0, 0} : (ay <= az ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
    return normalized(cross(n, axis));
}

/// Two unit vectors that make a right-handed frame with the unit vector n (Duff et al. 2017, J. Comput. Graph. Tech.
/// 6).
GF_FN void frame_of(const Vec3& n, Vec3& e1, Vec3& e2)
{
    const double sign = n.z >= 0.0 ? 1.0 : -1.0, a = -1.0 / (sign + n.z), b = n.x * n.y * a;
    e1 = {1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    e2 = {b, sign + n.y * n.y * a, -n.y};
}

}  // namespace grainfrac
