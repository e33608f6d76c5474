// SPDX-License-Identifier: GPL-3.0-or-later
// What one part of a rigid grain exerts on the other across a plane that would cut it.
//
// The plane n.x = d cuts the grain into part 1 (n.x > d) and part 2. Part 1 moves with the grain, so that part 2 exerts
// on it, about the centroid x_p of the polygon between them,
//   F* = int_1 rho (a - g) dV - sum_1 f_k
//   M* = int_1 rho (x - x_p) x (a - g) dV - sum_1 (x_k - x_p) x f_k,   a(x) = a_c + dw/dt x (x - c) + w x (w x (x - c))
// Written with the moments V, S, Q of part 1 about a point o of the plane (1, y, y y^T integrated, y = x - o),
//   int rho (a - g) = rho [V b + dw/dt x S + w x (w x S)],   b = a(o) - g
//   int rho y x (a - g) = rho [S x b + I dw/dt + w x I w],   I = tr(Q) 1 - Q
// which is m_1 (a_1 - g) and I_1 dw/dt + w x I_1 w + (c_1 - x_p) x m_1 (a_1 - g) without the division by the volume of
// the part. The stress vector on the plane acts on part 2, out of which n points: the field with resultant (-F*, -M*).
// Part 2 gives the opposite of the same to round-off, as long as the accelerations are those that the loads cause.
// Source: Saleme Ruiz 2016 (3.20), (3.21). Corrected: moments refer to the centroid of the plane's polygon, not to that
// of the part; the inertia of the part, gravity and the moments of the faces count; tractions vary over the plane.
//
// All positions and vectors are in one frame, of any orientation; for round-off its origin should lie in or near the
// grain (the body frame, say). Nothing here allocates: a kernel can ask for one plane of one grain.
#pragma once

#include "fracture/traction_field.h"
#include "geometry/cut.h"
#include "model/shapes.h"

namespace grainfrac {

/// A convex polyhedron as kernels see it.
struct FacesView {
    const Vec3* vertices = nullptr;            ///< [m]
    const std::int32_t* loop_begin = nullptr;  ///< per face, into loops; one more entry at the end
    const std::int32_t* loops = nullptr;       ///< vertex indices, counter-clockwise from outside
    int faces = 0;
};
GF_FN FacesView faces_view(const ShapesView& s, int shape)
{
    const int first = s.face_begin[shape];
    return {s.vertices.data + s.vertex_begin[shape], s.loop_begin.data + first, s.loops.data,
            s.face_begin[shape + 1] - first};
}

/// Volume and moments of a part about a point o, y = x - o.
struct PartMoments {
    double volume = 0.0;  ///< [m^3]
    Vec3 first;           ///< S = int y dV [m^4]
    Mat3 second;          ///< Q = int y y^T dV [m^5]

    /// The tetrahedron of o with the triangle a, b, c (from o), counter-clockwise seen from outside.
    GF_FN void add(const Vec3& a, const Vec3& b, const Vec3& c)
    {
        const double v = dot(a, cross(b, c)) / 6.0;
        const Vec3 s = a + b + c;
        volume += v;
        first += (0.25 * v) * s;
        second = second + (v / 20.0) * (Mat3::outer(a, a) + Mat3::outer(b, b) + Mat3::outer(c, c) + Mat3::outer(s, s));
    }
};

/// The polygon between two parts, with room for what a kernel may hold.
struct PlaneSection {
    static constexpr int room = 2 * max_face_vertices;
    Vec3 corners[room];  ///< counter-clockwise about the plane's normal [m]
    int count = 0;
    PlaneMoments moments;
};

/// A grain cut by a plane.
struct PlaneCut {
    CutStatus status = CutStatus::degenerate;
    Plane plane;
    double tolerance = 0.0;        ///< corners nearer to the plane than this are on it [m]
    double point_tolerance = 0.0;  ///< point loads nearer than this belong to part 1 [m]
    Vec3 origin;                   ///< o, on the plane [m]
    PartMoments part[2];           ///< of part 1 (beyond the plane) and part 2, about the origin
    PlaneSection section;
};

/// Point loads nearer to the plane than this share of the grain's size go to part 1, whatever round-off says of them: a
/// split must hand them to the same side as the tractions did.
inline constexpr double point_on_plane_tolerance = 1e-9;

/// Cut by `plane` without building the parts. `size`: of the grain, what tolerances refer to [m]. Vertices on the plane
/// to within on_plane_tolerance x size count as on it, as in cut(), so that planes through edges need no special case.
/// `ok`, `all_inside` or `all_outside` (no part 1, no part 2), or `degenerate`: the plane lies in a face but for
/// round-off, or the polygon has more corners than there is room for.
GF_FN PlaneCut cut_by_plane(const FacesView& grain, const Plane& plane, double size)
{
    PlaneCut cut;
    cut.plane = plane;
    cut.tolerance = on_plane_tolerance * size;
    cut.point_tolerance = point_on_plane_tolerance * size;
    // The origin is a corner of the section: every tetrahedron then counts with the same sign, and a small part has
    // small arms.
    bool beyond = false, before = false, found = false;
    for (int f = 0; f < grain.faces; ++f) {
        const int first = grain.loop_begin[f], count = grain.loop_begin[f + 1] - first;
        for (int i = 0; i < count; ++i) {
            const Vec3 &a = grain.vertices[grain.loops[first + i]],
                       &b = grain.vertices[grain.loops[first + (i + 1 < count ? i + 1 : 0)]];
            const double height_a = dot(plane.normal, a) - plane.offset, height_b = dot(plane.normal, b) - plane.offset;
            const int side_a = side_of(height_a, cut.tolerance), side_b = side_of(height_b, cut.tolerance);
            beyond = beyond || side_a > 0;
            before = before || side_a < 0;
            if (!found && side_a == 0) cut.origin = a;
            if (!found && side_a * side_b < 0) cut.origin = crossing_point(a, height_a, b, height_b);
            found = found || side_a * side_b < 0 || side_a == 0;
        }
    }
    if (!beyond || !before) {
        cut.status = beyond ? CutStatus::all_outside : CutStatus::all_inside;
        return cut;
    }

    // Ends of the section's edges: a vertex on the plane, or where an edge of the grain meets it, known by its
    // vertices.
    struct End {
        std::int32_t low = -1, high = -1;
        GF_FN bool operator==(const End& b) const { return low == b.low && high == b.high; }
    };
    const auto end = [](std::int32_t u, std::int32_t v) { return u < v ? End{u, v} : End{v, u}; };
    End from[PlaneSection::room], to[PlaneSection::room];
    Vec3 start[PlaneSection::room];
    int edges = 0;
    bool simple = true;
    for (int f = 0; f < grain.faces; ++f) {
        const std::int32_t* loop = grain.loops + grain.loop_begin[f];
        const int count = grain.loop_begin[f + 1] - grain.loop_begin[f];
        Fan fan1, fan2;
        const auto add1 = [&](const Vec3& x) {
            fan1.add(x - cut.origin, [&](const Vec3& a, const Vec3& b, const Vec3& c) { cut.part[0].add(a, b, c); });
        };
        const auto add2 = [&](const Vec3& x) {
            fan2.add(x - cut.origin, [&](const Vec3& a, const Vec3& b, const Vec3& c) { cut.part[1].add(a, b, c); });
        };
        End leaves, enters;  // where the loop leaves the side beyond the plane, and comes back
        Vec3 leaves_at;
        int times = 0;
        for (int i = 0; i < count; ++i) {
            const std::int32_t u = loop[i], v = loop[i + 1 < count ? i + 1 : 0];
            const Vec3 &a = grain.vertices[u], &b = grain.vertices[v];
            const double height_a = dot(plane.normal, a) - plane.offset, height_b = dot(plane.normal, b) - plane.offset;
            const int side_a = side_of(height_a, cut.tolerance), side_b = side_of(height_b, cut.tolerance);
            if (side_a >= 0) add1(a);
            if (side_a <= 0) add2(a);
            Vec3 crossing;
            if (side_a * side_b < 0) {
                crossing = crossing_point(a, height_a, b, height_b);
                add1(crossing);
                add2(crossing);
            }
            if (side_a > 0 && side_b <= 0) {
                leaves = side_b == 0 ? end(v, v) : end(u, v);
                leaves_at = side_b == 0 ? b : crossing;
                ++times;
            }
            if (side_a <= 0 && side_b > 0) enters = side_a == 0 ? end(u, u) : end(u, v);
        }
        simple = simple && times <= 1;
        if (times == 0 || leaves == enters) continue;  // all on one side, or a single corner on the plane
        if (edges == PlaneSection::room) {
            simple = false;
            break;
        }
        from[edges] = leaves;
        to[edges] = enters;
        start[edges] = leaves_at;
        ++edges;
    }
    // Part 1 sees the polygon from its outside, clockwise about n, and each edge of its faces the other way round: in
    // the order in which faces leave, the polygon is counter-clockwise.
    int at = 0;
    PlaneSection& s = cut.section;
    while (simple && at >= 0 && s.count < edges) {
        s.corners[s.count++] = start[at];
        int next = -1;
        for (int k = 0; k < edges; ++k)
            if (from[k] == to[at]) next = k;
        at = next;
    }
    if (!simple || edges < 3 || at != 0) return cut;
    s.moments = plane_moments(s.corners, s.count, plane.normal);
    if (s.moments.area > 0.0 && cut.part[0].volume > 0.0 && cut.part[1].volume > 0.0) cut.status = CutStatus::ok;
    return cut;
}

/// A force on a grain at a point, and a couple where the load carries one (parallel bonds, rolling resistance).
struct PointLoad {
    Vec3 point;   ///< [m]
    Vec3 force;   ///< on the grain [N]
    Vec3 couple;  ///< on the grain, besides the force's moment [N m]
};
/// Tractions on a face of a grain, on the side that the field's normal points out of. A plane that cuts the face cuts
/// the load too, so that nothing jumps as the plane sweeps over it.
struct FaceLoad {
    const Vec3* corners = nullptr;  ///< convex polygon [m]
    int count = 0;
    TractionField traction;
};
struct GrainLoads {
    View<const PointLoad> points;
    View<const FaceLoad> faces;
};

/// How a grain moves now.
struct GrainMotion {
    double density = 0.0;       ///< rho [kg/m^3]
    Vec3 center;                ///< c, centre of mass [m]
    Vec3 acceleration;          ///< a_c of the centre of mass [m/s^2]
    Vec3 angular_velocity;      ///< w [rad/s]
    Vec3 angular_acceleration;  ///< dw/dt [rad/s^2]
    Vec3 body_force;            ///< g: gravity, and damping in proportion to the mass if there is any [m/s^2]
};

enum class GrainPart { one, two };

/// Sum of what acts on one part besides the other part, and of its inertia, about the origin of the cut: what the other
/// part must exert on it.
GF_FN Wrench needed_by(GrainPart part, const PlaneCut& cut, const GrainMotion& motion, const GrainLoads& loads)
{
    const PartMoments& m = cut.part[part == GrainPart::one ? 0 : 1];
    const Vec3 &w = motion.angular_velocity, &rate = motion.angular_acceleration;
    const auto turning = [&](const Vec3& y) { return cross(rate, y) + cross(w, cross(w, y)); };
    const auto inertia = [&](const Vec3& y) { return trace(m.second) * y - m.second * y; };
    const Vec3 b = motion.acceleration - motion.body_force + turning(cut.origin - motion.center);
    Wrench needed;
    needed.force = motion.density * (m.volume * b + turning(m.first));
    needed.moment = motion.density * (cross(m.first, b) + inertia(rate) + cross(w, inertia(w)));

    for (int k = 0; k < loads.points.size; ++k) {
        const PointLoad& load = loads.points[k];
        const bool one = dot(cut.plane.normal, load.point) - cut.plane.offset >= -cut.point_tolerance;
        if (one != (part == GrainPart::one)) continue;
        needed.add(-load.force, load.point - cut.origin);
        needed.moment -= load.couple;
    }
    const Plane beyond = part == GrainPart::one ? cut.plane : Plane{-cut.plane.normal, -cut.plane.offset};
    for (int k = 0; k < loads.faces.size; ++k) {
        const FaceLoad& load = loads.faces[k];
        needed.add(resultant_beyond(load.traction, load.corners, load.count, beyond, cut.tolerance, cut.origin), -1.0);
    }
    return needed;
}

/// (F*, M*): what part 2 exerts on part 1, about the centroid of the section [N, N m], from the balance of `part`.
GF_FN Wrench resultant_on_part1(GrainPart part, const PlaneCut& cut, const GrainMotion& motion, const GrainLoads& loads)
{
    Wrench w;
    w.add(needed_by(part, cut, motion, loads), part == GrainPart::one ? 1.0 : -1.0);
    w.moment += cross(cut.origin - cut.section.moments.centroid, w.force);
    return w;
}
/// The part with less volume: fewer loads enter its balance, so less of them cancels.
GF_FN GrainPart smaller_part(const PlaneCut& cut)
{
    return cut.part[1].volume < cut.part[0].volume ? GrainPart::two : GrainPart::one;
}

/// What acts across a plane.
struct PlaneTractions {
    Wrench on_part1;      ///< (F*, M*) about the centroid of the section [N, N m]
    TractionField field;  ///< stress vector on the plane, acts on part 2; the mean normal stress is -F*.n/A
};
GF_FN PlaneTractions plane_tractions(GrainPart part, const PlaneCut& cut, const GrainMotion& motion,
                                     const GrainLoads& loads)
{
    PlaneTractions t;
    t.on_part1 = resultant_on_part1(part, cut, motion, loads);
    t.field = fit_tractions(cut.section.moments, {-t.on_part1.force, -t.on_part1.moment});
    return t;
}
/// The same from the smaller part.
GF_FN PlaneTractions plane_tractions(const PlaneCut& cut, const GrainMotion& motion, const GrainLoads& loads)
{
    return plane_tractions(smaller_part(cut), cut, motion, loads);
}

}  // namespace grainfrac
