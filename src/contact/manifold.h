// SPDX-License-Identifier: GPL-3.0-or-later
// One manifold per pair of dilated convex bodies, as a potential: U(relative position) with its exact gradient.
//
// The elastic energy of a contact is k_c U. Every force is a derivative of U, so that no motion, be it tilting, rolling
// off an edge or sliding off a face, makes or loses energy. With g_p the penetration of the cores' closest points and
// V, S, Q the moments of the penetration (overlap.h), summed over all faces that look at each other there:
//
//   U   = S_faces + fade(A/A_0) A_ref/2 [(1 - chi) g_p^2 + chi G^2]
//   A   = V^2/(2 S) of the faces: the area of a uniform pressure
//   G   = 2 S/V, the mean of g weighted with g;  r^2 = 12 Q/V, the length of a line pressed uniformly: both of the
//   faces
//         and of edges side by side
//   fade(x) = (1 - x)^2 for x < 1;  chi = 1 - fade(r^2/l_0^2)
//
// Faces pressed over more than A_0 have nothing but U = S: the force is k_c times the overlap volume. As they tilt or
// slide off, A goes to zero and the reference stiffness takes over: spread along the line while the contact is long
// (chi = 1, so that an edge that lies on a face or along another does not tip from end to end), at the closest points
// once it is short. Where no faces look at each other and no edges lie side by side, U = A_ref g_p^2/2.
#pragma once

#include "contact/overlap.h"
#include "geometry/gjk.h"
#include "model/contacts.h"
#include "model/shapes.h"

namespace grainfrac {

/// Cores nearer than this share of the summed dilation radii are penetrating: an error state, never extrapolated.
inline constexpr double core_contact_share = 1e-6;
/// A penetration below this share of the summed radii is round-off of the distance, no contact yet: volume and area of
/// such a sliver do not belong together, and force, stiffness and dashpot of grains that merely touch would be
/// anything.
inline constexpr double least_penetration = 1e-10;

/// One body of a pair.
struct ContactBody {
    ShapesView shapes;
    int shape = 0;
    Vec3 position;
    Quat orientation;

    GF_FN double radius() const { return shapes.radius[shape]; }
    GF_FN bool is_ball() const { return shapes.is_ball(shape); }
    GF_FN PlacedCore core() const
    {
        const int first = shapes.vertex_begin[shape];
        return {shapes.vertices.data + first, shapes.vertex_begin[shape + 1] - first, position, orientation};
    }
};

namespace manifold_detail {

/// A_0 over A_ref: the sum of the two stiffnesses then never falls by more than 6 % while an area grows from nothing.
constexpr double full_face = 1.5;
/// l_0 over sqrt(A_ref): half an edge of the face that A_ref is a quarter of.
constexpr double full_line = 1.0;
/// Cosines of the tilt between which faces stop to count as facing each other (37 and 60 degrees).
constexpr double facing_cosine = 0.8, turned_cosine = 0.5;
/// Squared sine of a tilt below which it is round-off.
constexpr double same_plane = 1e-20;
/// Faces that look along the contact's normal less than this cannot face one of the other body across the contact.
constexpr double least_facing = 0.3;
/// Squared sines of the angle between which edges stop to count as lying side by side (2 and 8 degrees).
constexpr double parallel_sine2 = 1.2e-3, crossing_sine2 = 1.9e-2;
/// Edges nearer to a window's edge than this, over the squared length of that edge, are the window's.
constexpr double same_edge = 1e-9;

/// The faces of a body that may be in contact: those that look along `direction` and are at its closest point.
struct FacingFaces {
    static constexpr int room = 32;  // a rounded rim of many facets has a dozen or two within the reach of one point
    int face[room];                  // into the shape table
    int count = 0;
};

GF_FN FacingFaces facing(const ContactBody& body, const Vec3& direction, const Vec3& closest, double reach)
{
    const Vec3 d = rotate_back(body.orientation, direction), x = rotate_back(body.orientation, closest - body.position);
    FacingFaces found;
    for (int f = body.shapes.face_begin[body.shape]; f < body.shapes.face_begin[body.shape + 1]; ++f) {
        const Vec3 n = body.shapes.face_normals[f];
        if (dot(n, d) > least_facing && body.shapes.face_offsets[f] - dot(n, x) < reach && found.count < found.room)
            found.face[found.count++] = f;
    }
    return found;
}

struct Plane {
    Vec3 normal;
    double offset = 0.0;  // normal . x, world [m]
};

GF_FN Plane plane_of(const ContactBody& body, int face)
{
    Plane p;
    p.normal = rotate(body.orientation, body.shapes.face_normals[face]);
    p.offset = body.shapes.face_offsets[face] + dot(p.normal, body.position);
    return p;
}

GF_FN bool has_one_edge(const ContactBody& body)
{
    return body.shapes.edge_begin[body.shape + 1] - body.shapes.edge_begin[body.shape] == 1;
}

/// Projection of a face's outline along the plane's normal; `backwards` for the face that looks at the plane, so that
/// both run counter-clockwise.
GF_FN FlatPolygon outline(const ContactBody& body, int face, const Vec3& origin, const Vec3& e1, const Vec3& e2,
                          bool backwards)
{
    const ShapesView& s = body.shapes;
    FlatPolygon p;
    const int begin = s.loop_begin[face], end = s.loop_begin[face + 1], first = s.vertex_begin[body.shape];
    const Vec3 centre = body.position - origin;
    const Vec3 d1 = rotate_back(body.orientation, e1), d2 = rotate_back(body.orientation, e2);
    const double x = dot(centre, e1), y = dot(centre, e2);
    for (int k = begin; k < end; ++k) {
        const Vec3& v = s.vertices[first + s.loops[backwards ? end - 1 - (k - begin) : k]];
        p.add(x + dot(v, d1), y + dot(v, d2), backwards);
    }
    return p;
}

/// Two faces over the plane of a's; points from `about`.
GF_FN FaceOverlap face_overlap(const ContactBody& a, int face_a, const Plane& pa, const ContactBody& b, int face_b,
                               const Plane& pb, const Vec3& about)
{
    FaceOverlap o;
    o.N = pa.normal;
    o.beta = -pb.normal;
    o.cosine = dot(o.beta, o.N);
    o.origin = (pa.offset - dot(o.N, about)) * o.N;  // foot of `about`
    o.e1 = any_perpendicular(o.N);
    o.e2 = cross(o.N, o.e1);
    o.z0 = (-pb.offset - dot(o.beta, about + o.origin)) / o.cosine;
    o.zx = -dot(o.beta, o.e1) / o.cosine;
    o.zy = -dot(o.beta, o.e2) / o.cosine;
    o.g0 = a.radius() + b.radius() - o.z0;
    o.gx = -o.zx;
    o.gy = -o.zy;
    o.p = outline(b, face_b, about, o.e1, o.e2, true);
    clip(o.p, o.g0, o.gx, o.gy);  // first: mostly little or nothing is left
    if (o.p.count == 0) return o;
    const FlatPolygon window = outline(a, face_a, about, o.e1, o.e2, false);
    for (int i = 0; i < window.count && o.p.count > 0; ++i) {
        const int j = i + 1 < window.count ? i + 1 : 0;
        const double dx = window.x[j] - window.x[i], dy = window.y[j] - window.y[i];
        clip(o.p, dy * window.x[i] - dx * window.y[i], -dy, dx, same_edge * (dx * dx + dy * dy));
    }
    return o;
}

/// Two faces, over the plane of either. g is the true distance if the edge in contact is the other body's, else too
/// small, so each plane counts by what it finds:
///   V = (V_1^2 + V_2^2)/(V_1 + V_2),   S = (S_1 V_1 + S_2 V_2)/(V_1 + V_2),   Q alike
/// and both the same where the faces are parallel.
struct FacePair {
    FaceOverlap over[2];
    OverlapMoments part[2], m;
    double total = 0.0;                       // V_1 + V_2; 0: nothing in contact
    double weight = 0.0, weight_slope = 0.0;  // by the cosine of the tilt

    /// Face of a on face of b; points from `about`.
    GF_FN void find(const ContactBody& a, int face_a, const ContactBody& b, int face_b, const Vec3& about)
    {
        total = 0.0;
        const Plane pa = plane_of(a, face_a), pb = plane_of(b, face_b);
        const double cosine = -dot(pa.normal, pb.normal);
        if (cosine <= turned_cosine) return;
        const double t = smaller(1.0, (cosine - turned_cosine) / (facing_cosine - turned_cosine));
        weight = t * t * (3.0 - 2.0 * t);
        weight_slope = 6.0 * t * (1.0 - t) / (facing_cosine - turned_cosine);
        over[0] = face_overlap(a, face_a, pa, b, face_b, pb, about);
        part[0] = over[0].moments();
        part[1] = OverlapMoments{};
        if (norm2(cross(pa.normal, pb.normal)) > same_plane) {
            over[1] = face_overlap(b, face_b, pb, a, face_a, pa, about);
            part[1] = over[1].moments();
        }
        total = part[0].V + part[1].V;
        m = OverlapMoments{};
        for (int k = 0; k < 2 && total > 0.0; ++k) m.add(part[k], part[k].V / total);
    }

    /// -dU on b.
    GF_FN Wrench wrench(const OverlapSlopes& U) const
    {
        Wrench w;
        for (int k = 0; k < 2; ++k) {
            if (part[k].V <= 0.0) continue;
            const double share = weight * part[k].V / total;
            OverlapSlopes slope;
            slope.S = U.S * share;
            slope.Q = U.Q * share;
            slope.V = U.V * share +
                      weight / total * (U.V * (part[k].V - m.V) + U.S * (part[k].S - m.S) + U.Q * (part[k].Q - m.Q));
            w.add(over[k].wrench(slope), k == 0 ? 1.0 : -1.0);
        }
        if (weight_slope > 0.0) {  // d cos = theta . (beta x N)
            w.moment += -weight_slope * (U.V * m.V + U.S * m.S + U.Q * m.Q) * cross(over[0].beta, over[0].N);
        }
        return w;
    }
};

/// The only edge of `rod` over a face of `flat`. Points from `about`.
GF_FN LineOverlap line_overlap(const ContactBody& flat, int face, const ContactBody& rod, const Vec3& about)
{
    const Plane plane = plane_of(flat, face);
    const Edge e = rod.shapes.edges[rod.shapes.edge_begin[rod.shape]];
    const PlacedCore core = rod.core();
    const Vec3 from = rod.position + rotate(rod.orientation, core.vertices[e.from]);
    const Vec3 to = rod.position + rotate(rod.orientation, core.vertices[e.to]);
    LineOverlap o;
    const double length = norm(to - from);
    o.origin = from - about;
    o.d = (to - from) * (1.0 / length);
    o.N = plane.normal;
    o.g0 = flat.radius() + rod.radius() - (dot(o.N, from) - plane.offset);
    o.gs = -dot(o.N, o.d);
    o.s1 = length;
    const ShapesView& s = flat.shapes;
    const int begin = s.loop_begin[face], end = s.loop_begin[face + 1], first = s.vertex_begin[flat.shape];
    const auto corner = [&](int k) { return flat.position + rotate(flat.orientation, s.vertices[first + s.loops[k]]); };
    for (int k = begin; k < end; ++k) {
        const Vec3 v = corner(k), m = normalized(cross(corner(k + 1 < end ? k + 1 : begin) - v, o.N));
        const double outside = dot(m, from - v), slope = dot(m, o.d);
        if (slope == 0.0) {
            if (outside > 0.0) o.s1 = o.s0;
            continue;
        }
        const double at = -outside / slope;
        if (slope > 0.0 && at < o.s1) {
            o.s1 = at;
            o.m1 = m;
        } else if (slope < 0.0 && at > o.s0) {
            o.s0 = at;
            o.m0 = m;
        }
    }
    if (o.gs != 0.0) {
        const double zero = -o.g0 / o.gs;
        if (o.gs < 0.0 && zero < o.s1) {
            o.s1 = zero;
            o.m1 = Vec3{};
        } else if (o.gs > 0.0 && zero > o.s0) {
            o.s0 = zero;
            o.m0 = Vec3{};
        }
    } else if (o.g0 <= 0.0) {
        o.s1 = o.s0;
    }
    if (o.s1 <= o.s0) {
        o.s1 = o.s0;
        o.m0 = o.m1 = Vec3{};
    }
    return o;
}

/// An edge in space. Points from one origin near the contact.
struct PlacedEdge {
    Vec3 from, d;
    double length;
};

/// Edge i of a beside edge j of b; weight 0 if they are not in contact.
GF_FN EdgeOverlap edge_overlap(const PlacedEdge& i, const PlacedEdge& j, double radii)
{
    EdgeOverlap o;
    o.from = i.from;
    o.d = i.d;
    o.other_from = j.from;
    o.other_d = j.d;
    const double length = i.length, other_length = j.length;
    const double sine2 = norm2(cross(o.d, o.other_d));
    if (sine2 >= crossing_sine2) return o;
    const double x = larger(0.0, (sine2 - parallel_sine2) / (crossing_sine2 - parallel_sine2));
    o.weight = 1.0 - x * x * (3.0 - 2.0 * x);
    o.weight_slope = -6.0 * x * (1.0 - x) / (crossing_sine2 - parallel_sine2);
    o.radii = radii;

    // squared distance to the other line: A s^2 + 2 B s + C, below radii^2 between the roots
    const Vec3 w = o.from - o.other_from;
    const double c = dot(o.d, o.other_d), h = dot(w, o.other_d);
    const double A = larger(sine2, 1e-28), B = dot(w, o.d) - c * h, C = norm2(w) - h * h - o.radii * o.radii;
    const double inside = B * B - A * C;
    if (inside <= 0.0) {
        o.weight = 0.0;
        return o;
    }
    const double q = -(B + (B >= 0.0 ? 1.0 : -1.0) * std::sqrt(inside));
    double low = q / A, high = q != 0.0 ? C / q : 0.0;
    if (low > high) {
        const double t = low;
        low = high;
        high = t;
    }
    o.s0 = larger(0.0, low);
    o.s1 = smaller(length, high);
    for (int k = 0; k < 2; ++k) {
        const Vec3 end = o.other_from + (k == 0 ? 0.0 : other_length) * o.other_d;
        const double s = dot(end - o.from, o.d);
        const bool is_upper = (k == 1) == (c > 0.0);
        if (is_upper && s < o.s1) {
            o.s1 = s;
            o.end1 = end;
            o.other_ends[1] = true;
        } else if (!is_upper && s > o.s0) {
            o.s0 = s;
            o.end0 = end;
            o.other_ends[0] = true;
        }
    }
    if (o.s1 <= o.s0) o.weight = 0.0;
    return o;
}

/// Edges of a body that reach to within `depth` of its farthest point in `direction`: the other body is beyond, so no
/// other edge can be in contact.
class FarthestEdges {
public:
    int count = 0;

    GF_FN FarthestEdges(const ContactBody& body, const Vec3& direction, const Vec3& farthest, double depth,
                        const Vec3& about)
    {
        const Vec3 d = rotate_back(body.orientation, direction);
        const double least = dot(farthest - body.position, direction) - depth;
        const Vec3* v = body.shapes.vertices.data + body.shapes.vertex_begin[body.shape];
        for (int e = body.shapes.edge_begin[body.shape]; e < body.shapes.edge_begin[body.shape + 1]; ++e) {
            const Edge ends = body.shapes.edges[e];
            const double h = dot(v[ends.from], d), k = dot(v[ends.to], d);
            if ((h > k ? h : k) <= least || count == room) continue;
            const Vec3 from = body.position + rotate(body.orientation, v[ends.from]) - about;
            const Vec3 along = rotate(body.orientation, v[ends.to] - v[ends.from]);
            const double length = norm(along), per_length = 1.0 / length;
            double* to = numbers_[count++];
            to[0] = from.x, to[1] = from.y, to[2] = from.z;
            to[3] = along.x * per_length, to[4] = along.y * per_length, to[5] = along.z * per_length;
            to[6] = length;
        }
    }
    GF_FN PlacedEdge operator[](int i) const
    {
        const double* e = numbers_[i];
        return {{e[0], e[1], e[2]}, {e[3], e[4], e[5]}, e[6]};
    }

private:
    static constexpr int room = max_face_vertices;
    double numbers_[room][7];  // not Vec3, which would be set to zero, though few are used
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

/// Of two balls: a ball's only corner is its centre of mass.
GF_FN ClosestPoints ball_points(const ContactBody& a, const ContactBody& b)
{
    ClosestPoints r;
    r.a = a.position;
    r.b = b.position;
    r.distance = norm(r.b - r.a);
    return r;
}

/// A ball has neither faces nor edges: U = A_ref g_p^2/2, whatever the other body is.
GF_FN ContactPoint ball_contact(const ContactBody& a, const ContactBody& b, const ClosestPoints& near)
{
    ContactPoint c;
    c.depth = a.radius() + b.radius() - near.distance;
    c.area = reference_area(a, b);
    c.normal = (near.b - near.a) * (1.0 / near.distance);
    c.position = near.a + (0.5 * (near.distance + a.radius() - b.radius())) * c.normal;
    c.overlap_force = c.area * c.depth;
    c.overlap_energy = 0.5 * c.overlap_force * c.depth;
    return c;
}

/// Numbers of the pairs of features that count, for the second pass over them; if there were more than it holds, that
/// one goes over all pairs again.
template <int room>
struct KeptPairs {
    std::int16_t kept[room];
    int count = 0, at_first = -1;

    GF_FN void add(int k)
    {
        if (count == 0) at_first = k;
        if (count < room) kept[count] = static_cast<std::int16_t>(k);
        ++count;
    }
    GF_FN int to_visit(int all) const { return count <= room ? count : all; }
    GF_FN int at(int k) const { return count <= room ? kept[k] : k; }
};

/// (1 - x)^2 below 1, and its slope.
GF_FN double fade(double x, double& slope)
{
    const double rest = larger(0.0, 1.0 - x);
    slope = -2.0 * rest;
    return rest * rest;
}

/// Pressed area of the faces; with it what is left to the reference stiffness.
struct PressedArea {
    double A = 0.0, rest = 1.0, rest_slope = 0.0;

    GF_FN PressedArea(const OverlapMoments& faces, double A_ref)
    {
        if (faces.V <= 0.0) return;
        A = 0.5 * faces.V * faces.V / faces.S;
        rest = fade(A / (full_face * A_ref), rest_slope);
        rest_slope /= full_face * A_ref;
    }
};

/// U and its derivatives by the moments of the faces, of the lines, and by g_p.
struct Potential {
    double U = 0.0, by_point = 0.0;
    OverlapSlopes by_faces, by_lines;

    GF_FN Potential(const OverlapMoments& faces, const PressedArea& pressed, const OverlapMoments& lines, double A_ref,
                    double g_p)
    {
        const double half = 0.5 * A_ref;
        OverlapMoments m = faces;
        m.add(lines, 1.0);
        double mixed = g_p * g_p;
        by_point = pressed.rest * A_ref * g_p;
        if (m.V > 0.0) {
            const double G = 2.0 * m.S / m.V, per_length = 12.0 / (m.V * full_line * full_line * A_ref);
            double slope;
            const double chi = 1.0 - fade(m.Q * per_length, slope);
            mixed = (1.0 - chi) * g_p * g_p + chi * G * G;
            by_point *= 1.0 - chi;
            const double by_G = pressed.rest * A_ref * chi * G;
            const double by_ratio = -pressed.rest * half * slope * (G * G - g_p * g_p);
            by_faces.V = -by_G * G / m.V - by_ratio * m.Q * per_length / m.V;
            by_faces.S = by_G * 2.0 / m.V;
            by_faces.Q = by_ratio * per_length;
            by_lines = by_faces;
        }
        U = faces.S + pressed.rest * half * mixed;
        if (faces.V > 0.0) {
            const double by_A = pressed.rest_slope * half * mixed;
            by_faces.V += by_A * faces.V / faces.S;
            by_faces.S += 1.0 - by_A * pressed.A / faces.S;
        }
    }
};

}  // namespace manifold_detail

/// Whether there is a contact to be looked at; if not, what `c` is then.
GF_FN bool they_press(const ClosestPoints& near, double radii, double& clearance, ContactPoint& c)
{
    clearance = larger(0.0, near.distance - radii);
    if (near.distance <= core_contact_share * radii) c.depth = radii;
    return !(near.distance >= (1.0 - least_penetration) * radii || near.distance <= core_contact_share * radii);
}

/// Contact of two balls, however they are turned.
GF_FN ContactPoint ball_manifold(const ContactBody& a, const ContactBody& b, double& clearance)
{
    using namespace manifold_detail;
    ContactPoint c;
    const ClosestPoints near = ball_points(a, b);
    return they_press(near, a.radius() + b.radius(), clearance, c) ? ball_contact(a, b, near) : c;
}

/// Contact of two bodies; normal zero if they are apart. depth = the summed dilation radii marks penetrating cores.
/// `clearance`: distance of the surfaces, 0 if they touch [m]. `corners`: of the last search, or none.
GF_FN ContactPoint contact_manifold(const ContactBody& a, const ContactBody& b, double& clearance,
                                    ClosestCorners& corners)
{
    using namespace manifold_detail;
    if (a.is_ball() && b.is_ball()) return ball_manifold(a, b, clearance);
    ContactPoint c;
    const double radii = a.radius() + b.radius();
    const ClosestPoints near = closest_points(a.core(), b.core(), b.position - a.position, corners);
    if (!they_press(near, radii, clearance, c)) return c;
    if (a.is_ball() || b.is_ball()) return ball_contact(a, b, near);
    const Vec3 n = (near.b - near.a) * (1.0 / near.distance);
    const double A_ref = reference_area(a, b);
    const double g_p = radii - near.distance;
    const Vec3 middle = near.a + (0.5 * (near.distance + a.radius() - b.radius())) * n;
    const FacingFaces faces_a = facing(a, n, near.a, radii), faces_b = facing(b, -n, near.b, radii);
    const bool rod_a = has_one_edge(a), rod_b = has_one_edge(b);
    const auto find = [&](int k, FacePair& o) {
        o.find(a, faces_a.face[k / faces_b.count], b, faces_b.face[k % faces_b.count], middle);
    };
    const auto rod_on_face = [&](int k) {
        return rod_b ? line_overlap(a, faces_a.face[k], b, middle) : line_overlap(b, faces_b.face[k], a, middle);
    };
    const int pairs = faces_a.count * faces_b.count, rods = rod_a ? faces_b.count : rod_b ? faces_a.count : 0;
    OverlapMoments faces, lines;
    FacePair first, other;  // the first that overlap are mostly the only ones
    KeptPairs<32> overlapping;
    for (int k = 0; k < pairs; ++k) {
        FacePair& o = overlapping.count == 0 ? first : other;
        find(k, o);
        if (o.total <= 0.0) continue;
        faces.add(o.m, o.weight);
        overlapping.add(k);
    }
    const PressedArea pressed(faces, A_ref);
    if (pressed.rest > 0.0) {
        for (int k = 0; k < rods; ++k) lines.add(rod_on_face(k).moments(), 1.0);
    }
    // no depth: no edge, where faces carry alone
    const double depth = pressed.rest > 0.0 ? 1.01 * g_p : -radii;
    const FarthestEdges edges_a(a, n, near.a, depth, middle), edges_b(b, -n, near.b, depth, middle);
    const auto edge_pair = [&](int k) {
        return edge_overlap(edges_a[k / edges_b.count], edges_b[k % edges_b.count], radii);
    };
    KeptPairs<16> side_by_side;  // one or two are usual
    for (int k = 0; k < edges_a.count * edges_b.count; ++k) {
        EdgeOverlap o = edge_pair(k);
        if (o.weight <= 0.0) continue;
        lines.add(o.moments(), o.weight);
        side_by_side.add(k);
    }

    const Potential p(faces, pressed, lines, A_ref, g_p);
    Wrench w;  // on b, about `middle`
    if (overlapping.count > 0) w.add(first.wrench(p.by_faces), 1.0);
    for (int k = 0; overlapping.count > 1 && k < overlapping.to_visit(pairs); ++k) {
        if (overlapping.at(k) == overlapping.at_first) continue;
        find(overlapping.at(k), other);
        if (other.total > 0.0) w.add(other.wrench(p.by_faces), 1.0);
    }
    if (lines.V > 0.0) {
        for (int k = 0; k < rods; ++k) {
            LineOverlap o = rod_on_face(k);
            o.moments();
            w.add(o.wrench(p.by_lines), rod_b ? 1.0 : -1.0);
        }
        for (int k = 0; k < side_by_side.to_visit(edges_a.count * edges_b.count); ++k) {
            EdgeOverlap o = edge_pair(side_by_side.at(k));
            if (o.weight <= 0.0) continue;
            const OverlapMoments m = o.moments();
            w.add(o.wrench(p.by_lines, m), 1.0);
        }
    }
    w.force += p.by_point * n;  // through the middle
    const double U = p.U;

    const double force = norm(w.force);
    if (U <= 0.0 || force <= 0.0) return c;
    c.normal = w.force * (1.0 / force);
    c.position = middle + cross(w.force, w.moment) * (1.0 / (force * force));
    c.overlap_force = force;
    c.overlap_couple = dot(w.moment, c.normal);
    c.overlap_energy = U;
    c.area = 0.5 * dot(w.force, n) * dot(w.force, n) / U;
    c.twist_radius = std::sqrt((1.0 - pressed.rest) * pressed.A / std::numbers::pi);
    c.depth = g_p;
    return c;
}

GF_FN ContactPoint contact_manifold(const ContactBody& a, const ContactBody& b)
{
    double clearance;
    ClosestCorners unknown;
    return contact_manifold(a, b, clearance, unknown);
}

}  // namespace grainfrac
