// SPDX-License-Identifier: GPL-3.0-or-later
// Closest points of two convex cores (Gilbert, Johnson and Keerthi 1988), sub-distances by Voronoi regions as in
// Ericson, Real-Time Collision Detection (2005), 5.1. Works on vertex sets: balls and edges are sets of one and two.
#pragma once

#include "geometry/quat.h"

#include <cstdint>

namespace grainfrac {

/// Vertex set in its own frame, placed in space.
struct PlacedCore {
    const Vec3* vertices = nullptr;  ///< body frame [m]
    int count = 0;
    Vec3 position;  ///< [m]
    Mat3 rotation;  ///< body to world

    PlacedCore() = default;
    GF_FN PlacedCore(const Vec3* v, int n, const Vec3& x, const Quat& q)
        : vertices(v), count(n), position(x), rotation(to_matrix(q))
    {
    }

    GF_FN Vec3 at(int i) const { return position + rotation * vertices[i]; }
    /// Index of the vertex farthest along `direction` (world frame), the lowest of equals.
    GF_FN int support(const Vec3& direction) const
    {
        if (count == 1) return 0;
        const Vec3 d = transpose_times(rotation, direction);
        int best = 0;
        double most = dot(vertices[0], d);
        for (int i = 1; i < count; ++i) {
            const double h = dot(vertices[i], d);
            if (h > most) {
                most = h;
                best = i;
            }
        }
        return best;
    }
};

/// Which corners of two cores their closest points lie between, to begin with when the cores have hardly moved.
struct ClosestCorners {
    std::int16_t a[3] = {0, 0, 0}, b[3] = {0, 0, 0};  ///< into the vertices of each
    std::int16_t count = 0;                           ///< 0: not known
};

struct ClosestPoints {
    double distance = 0.0;  ///< 0: the cores overlap [m]
    Vec3 a, b;              ///< the closest points [m]
};

namespace gjk_detail {

struct Corner {
    Vec3 w;  // from a vertex of a to one of b
    double weight = 0.0;
    int at_a = 0, at_b = 0;
};

struct Simplex {
    Corner corner[4];
    int count = 0;

    GF_FN Vec3 closest() const
    {
        Vec3 v;
        for (int i = 0; i < count; ++i) v += corner[i].weight * corner[i].w;
        return v;
    }
    /// All of them, in their order, or up to three.
    GF_FN void keep(const int* which, const double* weight, int n)
    {
        if (n < count) {
            Corner kept[3];
            for (int i = 0; i < n; ++i) kept[i] = corner[which[i]];
            for (int i = 0; i < n; ++i) corner[i] = kept[i];
            count = n;
        }
        for (int i = 0; i < n; ++i) corner[i].weight = weight[i];
    }
};

/// Closest point of segment i-j to the origin: squared distance, and its corners and weights.
struct Part {
    double distance2 = 0.0;
    int which[3] = {0, 0, 0};
    double weight[3] = {1.0, 0.0, 0.0};
    int count = 1;
};

GF_FN Part on_segment(const Simplex& s, int i, int j)
{
    const Vec3 p = s.corner[i].w, d = s.corner[j].w - p;
    const double length2 = norm2(d);
    const double t = length2 > 0.0 ? -dot(p, d) / length2 : 0.0;
    Part part;
    if (t <= 0.0) {
        part.which[0] = i;
        part.distance2 = norm2(p);
    } else if (t >= 1.0) {
        part.which[0] = j;
        part.distance2 = norm2(s.corner[j].w);
    } else {
        part.which[0] = i;
        part.which[1] = j;
        part.weight[0] = 1.0 - t;
        part.weight[1] = t;
        part.count = 2;
        part.distance2 = norm2(p + t * d);
    }
    return part;
}

GF_FN Part nearer(const Part& a, const Part& b)
{
    return b.distance2 < a.distance2 ? b : a;
}

GF_FN Part on_triangle(const Simplex& s, int i, int j, int k)
{
    const Vec3 p = s.corner[i].w, q = s.corner[j].w, r = s.corner[k].w;
    const Vec3 n = cross(q - p, r - p);
    const double n2 = norm2(n);
    // barycentric coordinates of the origin's projection, as areas
    const double u = dot(cross(q, r), n), v = dot(cross(r, p), n), w = dot(cross(p, q), n);
    if (n2 > 0.0 && u > 0.0 && v > 0.0 && w > 0.0) {
        Part part;
        const double sum = 1.0 / (u + v + w);
        part.which[0] = i;
        part.which[1] = j;
        part.which[2] = k;
        part.weight[0] = u * sum;
        part.weight[1] = v * sum;
        part.weight[2] = w * sum;
        part.count = 3;
        const double h = dot(p, n);
        part.distance2 = h * h / n2;
        return part;
    }
    return nearer(nearer(on_segment(s, i, j), on_segment(s, j, k)), on_segment(s, k, i));
}

/// Height over size below which a tetrahedron is flat: the sign of its volume is round-off then, and all four faces are
/// looked at. Prisms side by side make such tetrahedra all the time. Larger sends true overlaps through the slow path.
constexpr double flat_tetrahedron = 1e-10;

/// Reduce the simplex to the part nearest the origin; false if the origin is inside a tetrahedron.
GF_FN bool reduce(Simplex& s)
{
    Part best;
    if (s.count == 1) {
        s.corner[0].weight = 1.0;
        return true;
    }
    if (s.count == 2) {
        best = on_segment(s, 0, 1);
    } else if (s.count == 3) {
        best = on_triangle(s, 0, 1, 2);
    } else {
        const int face[4][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
        bool outside_any = false;
        for (const auto& f : face) {
            const Vec3 p = s.corner[f[0]].w;
            const Vec3 n = cross(s.corner[f[1]].w - p, s.corner[f[2]].w - p);
            const Vec3 rest = s.corner[f[3]].w - p;
            const double origin_side = -dot(p, n), inner_side = dot(rest, n);
            const bool is_flat =
                inner_side * inner_side <= flat_tetrahedron * flat_tetrahedron * norm2(n) * norm2(rest);
            if (!is_flat && origin_side * inner_side > 0.0) continue;  // the origin is behind this face
            const Part part = on_triangle(s, f[0], f[1], f[2]);
            if (!outside_any || part.distance2 < best.distance2) best = part;
            outside_any = true;
        }
        if (!outside_any) return false;
    }
    s.keep(best.which, best.weight, best.count);
    return true;
}

}  // namespace gjk_detail

/// @param guess direction from a to b to start with, any non-zero vector
/// @param corners where the last search of this pair ended, or none; brought up to date
GF_FN ClosestPoints closest_points(const PlacedCore& a, const PlacedCore& b, const Vec3& guess, ClosestCorners& corners)
{
    using gjk_detail::Corner;
    constexpr int most_rounds = 64;        // a dozen is usual; round-off can make the last rounds cycle
    constexpr double no_progress = 1e-14;  // relative decrease of the squared distance that counts as progress
    gjk_detail::Simplex s;
    const Vec3 centres = b.position - a.position;
    const auto between = [&](int i, int j) {
        return Corner{centres + b.rotation * b.vertices[j] - a.rotation * a.vertices[i], 1.0, i, j};
    };
    const auto corner = [&](const Vec3& direction) { return between(a.support(direction), b.support(-direction)); };
    const auto known_vertex = [](int i, const PlacedCore& core) { return i >= 0 && i < core.count; };
    for (int i = 0; i < corners.count; ++i) {
        if (known_vertex(corners.a[i], a) && known_vertex(corners.b[i], b))
            s.corner[s.count++] = between(corners.a[i], corners.b[i]);
    }
    corners.count = 0;
    if (s.count == 0) s.corner[s.count++] = corner(guess);
    gjk_detail::reduce(s);
    Vec3 v = s.closest();
    for (int round = 0; round < most_rounds; ++round) {
        const double v2 = norm2(v);
        if (v2 == 0.0) return {};
        const Corner next = corner(v);
        if (v2 - dot(v, next.w) <= no_progress * v2) break;
        bool known = false;
        for (int i = 0; i < s.count; ++i) known = known || s.corner[i].w == next.w;
        if (known) break;
        const gjk_detail::Simplex before = s;
        s.corner[s.count++] = next;
        if (!gjk_detail::reduce(s)) return {};
        const Vec3 nearer = s.closest();
        if (norm2(nearer) >= v2) {
            s = before;
            break;
        }
        v = nearer;
    }
    ClosestPoints r;
    for (int i = 0; i < s.count; ++i) {
        const Corner& c = s.corner[i];
        r.a += c.weight * a.at(c.at_a);
        r.b += c.weight * b.at(c.at_b);
        corners.a[i] = static_cast<std::int16_t>(c.at_a);
        corners.b[i] = static_cast<std::int16_t>(c.at_b);
    }
    corners.count = static_cast<std::int16_t>(s.count);
    r.distance = norm(r.b - r.a);
    return r;
}

GF_FN ClosestPoints closest_points(const PlacedCore& a, const PlacedCore& b, const Vec3& guess)
{
    ClosestCorners unknown;
    return closest_points(a, b, guess, unknown);
}

}  // namespace grainfrac
