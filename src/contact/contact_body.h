// SPDX-License-Identifier: GPL-3.0-or-later
// One body of a pair, and those of its faces and edges that can be in contact.
#pragma once

#include "geometry/gjk.h"
#include "model/shapes.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace grainfrac {

/// Where a body is.
struct ContactBody {
    const ShapesView& shapes;
    int shape = 0;
    Vec3 position;
    Quat orientation;

    GF_FN double radius() const { return shapes.radius[shape]; }
    GF_FN bool is_ball() const { return shapes.is_ball(shape); }
    GF_FN bool has_one_edge() const { return shapes.edge_begin[shape + 1] - shapes.edge_begin[shape] == 1; }
    GF_FN PlacedCore core() const
    {
        const int first = shapes.vertex_begin[shape];
        return {shapes.vertices.data + first, shapes.vertex_begin[shape + 1] - first, position, orientation};
    }
};

/// Its core; points from an origin near the contact.
struct PlacedBody {
    const ShapesView& shapes;
    int shape;
    const Vec3* vertices;  ///< body frame [m]
    int vertex_count;
    Mat3 rotation;  ///< body to world
    Vec3 centre;    ///< of mass [m]

    GF_FN PlacedBody(const ContactBody& b, const PlacedCore& core, const Vec3& origin)
        : shapes(b.shapes),
          shape(b.shape),
          vertices(core.vertices),
          vertex_count(core.count),
          rotation(core.rotation),
          centre(core.position - origin)
    {
    }
    GF_FN Vec3 at(int vertex) const { return centre + rotation * vertices[vertex]; }
};

/// A face in space: normal . x = offset, x from the origin of its body.
struct PlacedFace {
    Vec3 normal;
    double offset;
    int begin, count;  // into loops
    bool bears;        // whether anything of the other body can be pressed over it
};

/// Faces that look along the contact's normal less than this cannot face one of the other body across the contact.
inline constexpr double least_facing = 0.3;
/// Squared sine of the angle from which edges do not count as lying side by side (8 degrees).
inline constexpr double crossing_sine2 = 1.9e-2;

/// Two cores between which there is a slab: thick `distance`, across the unit `normal` from a to b. What presses over a
/// face of normal N is nearer than `reach` along N, and farther than the slab is thick along `normal`:
///   distance/reach < N . normal.
/// Across an edge of b it is so too, but up to the line of that edge, which may be met beyond its end by the reach
/// times the tangent of the angle theta between both edges:
///   angle of b's edge to the slab < theta + arccos(distance/reach cos(theta)) <= 2 theta + arccos(distance/reach),
/// and of a's edge theta more. Of stiff bodies, which press little, few faces and edges are left to be looked at.
struct Slab {
    Vec3 normal;
    double distance, reach;

    GF_FN Slab seen_from_b() const { return {-normal, distance, reach}; }
    /// Squared sine of the angle to the slab above which no edge of b can be in contact, and none of a.
    GF_FN double steepest2_of_b() const { return steepest2(2.0); }
    GF_FN double steepest2_of_a() const { return steepest2(3.0); }
    GF_FN double steepest2(double thetas) const
    {
        const double share = distance / reach;
        const double s = std::sqrt(1.0 - share * share) + thetas * std::sqrt(crossing_sine2);  // >= sine of the sum
        return s * s;
    }
};

/// The faces of a body that may be in contact: those that look into the slab and are at the closest point.
class FacingFaces {
public:
    int count = 0;

    /// `closest`: the body's point at the slab.
    GF_FN FacingFaces(const PlacedBody& body, const Slab& slab, const Vec3& closest)
    {
        const Vec3 d = transpose_times(body.rotation, slab.normal);
        const Vec3 x = transpose_times(body.rotation, closest - body.centre);
        const ShapesView& s = body.shapes;
        for (int f = s.face_begin[body.shape]; f < s.face_begin[body.shape + 1]; ++f) {
            const Vec3 n = s.face_normals[f];
            const double facing = dot(n, d), offset = s.face_offsets[f];
            if (!(facing > least_facing && offset - dot(n, x) < slab.reach) || count == room) continue;
            PlacedFace& p = faces_[count++];
            p.normal = body.rotation * n;
            p.offset = offset + dot(p.normal, body.centre);
            p.begin = s.loop_begin[f];
            p.count = s.loop_begin[f + 1] - p.begin;
            p.bears = facing * slab.reach > slab.distance;
        }
    }
    GF_FN const PlacedFace& operator[](int i) const { return faces_[i]; }

private:
    static constexpr int room = 32;  // a rounded rim of many facets has a dozen or two within the reach of one point
    union {                          // not set to zero, though few are used
        PlacedFace faces_[room];
    };
};

/// An edge in space.
struct PlacedEdge {
    Vec3 from, d;  // unit
    double length;
};

/// Edges of a body that reach to within `depth` of the slab, and are not steeper to it than given.
class FacingEdges {
public:
    int count = 0;

    GF_FN FacingEdges(const PlacedBody& body, const Slab& slab, const Vec3& closest, double depth, double steepest2)
    {
        const Vec3 d = transpose_times(body.rotation, slab.normal);
        const double least = dot(closest - body.centre, slab.normal) - depth;
        constexpr int known = 64;  // vertices looked at once, not with each edge
        double heights[known];
        std::uint64_t reaching = 0;
        for (int v = 0; v < body.vertex_count && v < known; ++v) {
            heights[v] = dot(body.vertices[v], d);
            reaching |= static_cast<std::uint64_t>(heights[v] > least) << v;
        }
        const auto height = [&](int v) { return v < known ? heights[v] : dot(body.vertices[v], d); };
        const auto reaches = [&](int v) { return v < known ? (reaching >> v & 1U) != 0 : height(v) > least; };
        const ShapesView& s = body.shapes;
        for (int e = s.edge_begin[body.shape]; e < s.edge_begin[body.shape + 1]; ++e) {
            const Edge ends = s.edges[e];
            if (!(reaches(ends.from) || reaches(ends.to)) || count == room) continue;
            const double rise = height(ends.to) - height(ends.from);
            const Vec3 between = body.vertices[ends.to] - body.vertices[ends.from];
            const double length2 = norm2(between);
            if (rise * rise > steepest2 * length2) continue;
            PlacedEdge& p = edges_[count++];
            p.length = std::sqrt(length2);
            p.from = body.at(ends.from);
            p.d = body.rotation * between * (1.0 / p.length);
        }
    }
    GF_FN const PlacedEdge& operator[](int i) const { return edges_[i]; }

private:
    static constexpr int room = max_face_vertices;
    union {
        PlacedEdge edges_[room];
    };
};

/// A_ref: of the body with the smaller corners [m^2].
GF_FN double reference_area(const ContactBody& a, const ContactBody& b)
{
    const double area_a = a.shapes.point_area[a.shape], area_b = b.shapes.point_area[b.shape];
    if (area_a > 0.0 && area_b > 0.0) return area_a < area_b ? area_a : area_b;
    if (area_a + area_b > 0.0) return area_a + area_b;
    // two round bodies: the circle of their harmonic mean radius
    const double r = a.radius() * b.radius() / (a.radius() + b.radius());
    return std::numbers::pi * r * r;
}

}  // namespace grainfrac
