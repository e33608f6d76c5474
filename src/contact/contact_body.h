// SPDX-License-Identifier: GPL-3.0-or-later
// One body of a pair, and those of its faces and edges that can be in contact.
#pragma once

#include "geometry/gjk.h"
#include "model/shapes.h"

#include <cmath>
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
};

/// Faces that look along the contact's normal less than this cannot face one of the other body across the contact.
inline constexpr double least_facing = 0.3;

/// The faces of a body that may be in contact: those that look along a direction and are at its closest point.
class FacingFaces {
public:
    int count = 0;

    GF_FN FacingFaces(const PlacedBody& body, const Vec3& direction, const Vec3& closest, double reach)
    {
        const Vec3 d = transpose_times(body.rotation, direction);
        const Vec3 x = transpose_times(body.rotation, closest - body.centre);
        const ShapesView& s = body.shapes;
        for (int f = s.face_begin[body.shape]; f < s.face_begin[body.shape + 1]; ++f) {
            const Vec3 n = s.face_normals[f];
            const double offset = s.face_offsets[f];
            if (!(dot(n, d) > least_facing && offset - dot(n, x) < reach) || count == room) continue;
            PlacedFace& p = faces_[count++];
            p.normal = body.rotation * n;
            p.offset = offset + dot(p.normal, body.centre);
            p.begin = s.loop_begin[f];
            p.count = s.loop_begin[f + 1] - p.begin;
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

/// Edges of a body that reach to within `depth` of its farthest point in `direction`: the other body is beyond, so no
/// other edge can be in contact.
class FarthestEdges {
public:
    int count = 0;

    GF_FN FarthestEdges(const PlacedBody& body, const Vec3& direction, const Vec3& farthest, double depth)
    {
        const Vec3 d = transpose_times(body.rotation, direction);
        const double least = dot(farthest - body.centre, direction) - depth;
        constexpr int known = 64;
        double height[known];
        for (int v = 0; v < body.vertex_count && v < known; ++v) height[v] = dot(body.vertices[v], d);
        const auto reaches = [&](int v) { return (v < known ? height[v] : dot(body.vertices[v], d)) > least; };
        const ShapesView& s = body.shapes;
        for (int e = s.edge_begin[body.shape]; e < s.edge_begin[body.shape + 1]; ++e) {
            const Edge ends = s.edges[e];
            if (!(reaches(ends.from) || reaches(ends.to)) || count == room) continue;
            const Vec3 along = body.rotation * (body.vertices[ends.to] - body.vertices[ends.from]);
            PlacedEdge& p = edges_[count++];
            p.length = norm(along);
            p.from = body.at(ends.from);
            p.d = along * (1.0 / p.length);
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
