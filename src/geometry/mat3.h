// SPDX-License-Identifier: GPL-3.0-or-later
// Plain 3x3 matrices for kernels, row by row.
#pragma once

#include "geometry/vec3.h"

namespace grainfrac {

struct Mat3 {
    Vec3 row[3];

    GF_FN Vec3& operator[](int i) { return row[i]; }
    GF_FN const Vec3& operator[](int i) const { return row[i]; }

    GF_FN static Mat3 identity() { return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; }
    GF_FN static Mat3 diagonal(const Vec3& d) { return {{{d.x, 0, 0}, {0, d.y, 0}, {0, 0, d.z}}}; }
    /// skew(a) b = a x b
    GF_FN static Mat3 skew(const Vec3& a) { return {{{0, -a.z, a.y}, {a.z, 0, -a.x}, {-a.y, a.x, 0}}}; }
    GF_FN static Mat3 outer(const Vec3& a, const Vec3& b) { return {{a.x * b, a.y * b, a.z * b}}; }
};

GF_FN Vec3 operator*(const Mat3& m, const Vec3& a)
{
    return {dot(m[0], a), dot(m[1], a), dot(m[2], a)};
}
GF_FN Mat3 transpose(const Mat3& m)
{
    return {{{m[0].x, m[1].x, m[2].x}, {m[0].y, m[1].y, m[2].y}, {m[0].z, m[1].z, m[2].z}}};
}
/// transpose(m) a
GF_FN Vec3 transpose_times(const Mat3& m, const Vec3& a)
{
    return a.x * m[0] + a.y * m[1] + a.z * m[2];
}
GF_FN Mat3 operator*(const Mat3& a, const Mat3& b)
{
    const Mat3 t = transpose(b);
    return {{{dot(a[0], t[0]), dot(a[0], t[1]), dot(a[0], t[2])},
             {dot(a[1], t[0]), dot(a[1], t[1]), dot(a[1], t[2])},
             {dot(a[2], t[0]), dot(a[2], t[1]), dot(a[2], t[2])}}};
}
GF_FN Mat3 operator+(const Mat3& a, const Mat3& b)
{
    return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
}
GF_FN Mat3 operator-(const Mat3& a, const Mat3& b)
{
    return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}
GF_FN Mat3 operator*(double s, const Mat3& m)
{
    return {{s * m[0], s * m[1], s * m[2]}};
}
GF_FN double trace(const Mat3& m)
{
    return m[0].x + m[1].y + m[2].z;
}

}  // namespace grainfrac
