// SPDX-License-Identifier: GPL-3.0-or-later
// Tractions on a planar polygon that have a given resultant, linear over it, and their integrals.
//
// With x_f the centroid, n the normal, xi = (xi_1, xi_2) the position from x_f on tangents e1, e2, e1 x e2 = n,
// I_ij = int xi_i xi_j dA, J = I_11 + I_22, and F, M the resultant about x_f,
//   t_n(xi) = F_n/A + a_1 xi_1 + a_2 xi_2,   [I_11 I_12; I_12 I_22] [a_1; a_2] = [-M_2; M_1]
//   t_s(xi) = F_s/A + (M_n/J) n x xi
// Six numbers for six resultants: the field does the same work as the forces in every rigid motion, and is what an
// interface of uniform stiffness carries.
// Source: Saleme Ruiz 2016 (3.6)-(3.19). Corrected: lever arms stand inside the sum over the forces; the inertia of the
// grain is no force on its faces (it enters where a part is cut off, plane_tractions.h); rotations are rotations, not
// slopes; a shear that turns about the normal carries M_n, which constant shear cannot.
#pragma once

#include "geometry/polyhedron.h"
#include "geometry/wrench.h"

namespace grainfrac {

/// Convex polygon as a fan of triangles, corner by corner, without storing the corners.
struct Fan {
    Vec3 first, last;
    int count = 0;

    /// visit(a, b, c) for the triangle that the corner x completes.
    template <class Visit>
    GF_FN void add(const Vec3& x, Visit&& visit)
    {
        if (count == 0) first = x;
        if (count >= 2) visit(first, last, x);
        last = x;
        ++count;
    }
};

/// Side of a plane for a point at `height` over it: 1 beyond, -1 before, 0 on it to within `tolerance` [m].
GF_FN int side_of(double height, double tolerance)
{
    return height > tolerance ? 1 : (height < -tolerance ? -1 : 0);
}
/// Where the edge from a to b, at heights of opposite sign, meets the plane: the same bits from either end.
GF_FN Vec3 crossing_point(const Vec3& a, double height_a, const Vec3& b, double height_b)
{
    return (height_a * b - height_b * a) / (height_a - height_b);
}

/// visit(a, b, c) for triangles that make up the part of a convex polygon with plane.normal . x >= plane.offset, in the
/// sense of the corners. Corners nearer to the plane than `tolerance` [m] count as on it.
template <class Visit>
GF_FN void triangles_beyond(const Vec3* corners, int count, const Plane& plane, double tolerance, Visit&& visit)
{
    Fan fan;
    for (int i = 0; i < count; ++i) {
        const Vec3 &a = corners[i], &b = corners[i + 1 < count ? i + 1 : 0];
        const double height_a = dot(plane.normal, a) - plane.offset, height_b = dot(plane.normal, b) - plane.offset;
        const int side_a = side_of(height_a, tolerance), side_b = side_of(height_b, tolerance);
        if (side_a >= 0) fan.add(a, visit);
        if (side_a * side_b < 0) fan.add(crossing_point(a, height_a, b, height_b), visit);
    }
}

/// Area and moments of a planar polygon in a frame of its plane.
struct PlaneMoments {
    double area = 0.0;                       ///< [m^2]
    Vec3 centroid;                           ///< x_f [m]
    Vec3 e1, e2, n;                          ///< orthonormal, e1 x e2 = n; the polygon is counter-clockwise about n [-]
    double i11 = 0.0, i22 = 0.0, i12 = 0.0;  ///< int xi_1^2, xi_2^2, xi_1 xi_2 dA about the centroid [m^4]
};

/// Moments of the polygon, which runs counter-clockwise about the unit vector `normal`; e1 is along the unit tangent
/// `e1`.
GF_FN PlaneMoments plane_moments(const Vec3* corners, int count, const Vec3& normal, const Vec3& e1)
{
    PlaneMoments m;
    m.n = normal;
    m.e1 = e1;
    m.e2 = cross(normal, e1);
    // about a corner first: the centroid comes out to round-off of the polygon's size, wherever the polygon lies
    Vec3 first;
    for (int i = 1; i + 1 < count; ++i) {
        const Vec3 b = corners[i] - corners[0], c = corners[i + 1] - corners[0];
        const double area = 0.5 * dot(normal, cross(b, c));
        m.area += area;
        first += (area / 3.0) * (b + c);
    }
    if (m.area <= 0.0) return m;
    const Vec3 centroid = first / m.area;
    m.centroid = corners[0] + centroid;
    for (int i = 1; i + 1 < count; ++i) {
        const Vec3 a = -centroid, b = corners[i] - corners[0] - centroid, c = corners[i + 1] - corners[0] - centroid;
        const double twelfth = dot(normal, cross(b - a, c - a)) / 24.0;
        // int x x^T over a triangle: A/12 (aa + bb + cc + ss), s = a + b + c
        const Vec3 points[4] = {a, b, c, a + b + c};
        for (const Vec3& x : points) {
            const double x1 = dot(m.e1, x), x2 = dot(m.e2, x);
            m.i11 += twelfth * x1 * x1;
            m.i22 += twelfth * x2 * x2;
            m.i12 += twelfth * x1 * x2;
        }
    }
    return m;
}
GF_FN PlaneMoments plane_moments(const Vec3* corners, int count, const Vec3& normal)
{
    return plane_moments(corners, count, normal, any_perpendicular(normal));
}
/// The same, with the normal from the corners (counter-clockwise about it).
GF_FN PlaneMoments plane_moments(const Vec3* corners, int count)
{
    Vec3 area;
    for (int i = 1; i + 1 < count; ++i) area += cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    return plane_moments(corners, count, normalized(area));
}

/// Traction that is linear over a plane: force per area on the side that n points out of.
struct TractionField {
    Vec3 centroid;              ///< x_f, where xi = 0 [m]
    Vec3 e1, e2, n;             ///< frame of the plane, e1 x e2 = n [-]
    Vec3 mean;                  ///< F/A [Pa]
    double a1 = 0.0, a2 = 0.0;  ///< slopes of the normal stress along e1 and e2 [Pa/m]
    double twist = 0.0;         ///< M_n/J [Pa/m]

    /// t_n at the position x, tension positive [Pa].
    GF_FN double normal_stress(const Vec3& x) const
    {
        const Vec3 xi = x - centroid;
        return dot(mean, n) + a1 * dot(e1, xi) + a2 * dot(e2, xi);
    }
    /// t_s at the position x, in the plane [Pa].
    GF_FN Vec3 shear_stress(const Vec3& x) const { return tangential(mean, n) + twist * cross(n, x - centroid); }
    /// The traction at the position x [Pa].
    GF_FN Vec3 at(const Vec3& x) const { return normal_stress(x) * n + shear_stress(x); }
};

/// The field on the polygon of `m` whose resultant about its centroid is `resultant`: F [N], M [N m].
GF_FN TractionField fit_tractions(const PlaneMoments& m, const Wrench& resultant)
{
    TractionField t;
    t.centroid = m.centroid;
    t.e1 = m.e1;
    t.e2 = m.e2;
    t.n = m.n;
    t.mean = resultant.force / m.area;
    const double m1 = dot(m.e1, resultant.moment), m2 = dot(m.e2, resultant.moment);
    const double determinant = m.i11 * m.i22 - m.i12 * m.i12;
    t.a1 = -(m2 * m.i22 + m1 * m.i12) / determinant;
    t.a2 = (m1 * m.i11 + m2 * m.i12) / determinant;
    t.twist = dot(m.n, resultant.moment) / (m.i11 + m.i22);
    return t;
}

/// Force, and moment about `point`, of the field over a triangle: midpoints of the sides, exact to degree 2, which is
/// that of x times t.
GF_FN Wrench resultant_on_triangle(const TractionField& t, const Vec3& a, const Vec3& b, const Vec3& c,
                                   const Vec3& point)
{
    Wrench w;
    const double third = norm(cross(b - a, c - a)) / 6.0;
    const Vec3 middles[3] = {0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)};
    for (const Vec3& x : middles) w.add(third * t.at(x), x - point);
    return w;
}
/// The same over a convex polygon.
GF_FN Wrench resultant(const TractionField& t, const Vec3* corners, int count, const Vec3& point)
{
    Wrench w;
    for (int i = 1; i + 1 < count; ++i)
        w.add(resultant_on_triangle(t, corners[0], corners[i], corners[i + 1], point), 1.0);
    return w;
}
/// The same over the part of it with plane.normal . x >= plane.offset.
GF_FN Wrench resultant_beyond(const TractionField& t, const Vec3* corners, int count, const Plane& plane,
                              double tolerance, const Vec3& point)
{
    Wrench w;
    triangles_beyond(corners, count, plane, tolerance, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        w.add(resultant_on_triangle(t, a, b, c, point), 1.0);
    });
    return w;
}

}  // namespace grainfrac
