// SPDX-License-Identifier: GPL-3.0-or-later
// One manifold per pair of dilated convex bodies.
//
// Two faces against each other touch over the polygon they share: the penetration is a linear field over it, and the
// part with g > 0 is integrated exactly, so that a tilted pair transmits a moment and sliding changes the force
// continuously. A face and an edge, or two parallel edges, touch along a segment; all else at one point. Segments and
// points carry the stiffness of a reference area. Between the regimes the resultants are blended over the angles
// psi .. 2 psi: switching at one angle would make the force jump.
#pragma once

#include "geometry/gjk.h"
#include "model/contacts.h"
#include "model/shapes.h"

#include <numbers>

namespace grainfrac {

/// A face counts as lying against a direction within this angle [rad]; the blend ends at twice this. Larger smears
/// corners into faces, smaller makes the change of regime stiff.
inline constexpr double face_angle = std::numbers::pi / 180.0;

/// Cores nearer than this share of the summed dilation radii are penetrating: an error state, never extrapolated.
inline constexpr double core_contact_share = 1e-6;

/// One body of a pair.
struct ContactBody {
    ShapesView shapes;
    int shape = 0;
    Vec3 position;
    Quat orientation;

    GF_FN double radius() const { return shapes.radius[shape]; }
    GF_FN PlacedCore core() const
    {
        const int first = shapes.vertex_begin[shape];
        return {shapes.vertices.data + first, shapes.vertex_begin[shape + 1] - first, position, orientation};
    }
};

namespace manifold_detail {

/// 1 within `face_angle`, 0 beyond twice that, for the squared angle.
GF_FN double alignment(double angle2)
{
    const double inner = face_angle * face_angle, outer = 4.0 * inner;
    return std::fmin(1.0, std::fmax(0.0, (outer - angle2) / (outer - inner)));
}

struct Resultant {
    Vec3 normal, position;
    double volume = 0.0, square = 0.0, area = 0.0, twist_radius = 0.0, footprint = 0.0, depth = 0.0;
};

/// The face of the body that looks most along `direction`.
struct Facing {
    int face = -1;        // into the shape table
    Vec3 normal;          // world
    double offset = 0.0;  // normal . x on the core's face, world [m]
    double weight = 0.0;  // alignment with the direction
};

GF_FN Facing facing(const ContactBody& body, const Vec3& direction)
{
    const Vec3 d = rotate_back(body.orientation, direction);
    Facing best;
    double most = -2.0;
    for (int f = body.shapes.face_begin[body.shape]; f < body.shapes.face_begin[body.shape + 1]; ++f) {
        const double c = dot(body.shapes.face_normals[f], d);
        if (c > most) {
            most = c;
            best.face = f;
        }
    }
    if (best.face < 0) return best;
    best.normal = rotate(body.orientation, body.shapes.face_normals[best.face]);
    best.offset = body.shapes.face_offsets[best.face] + dot(best.normal, body.position);
    const Vec3 miss = cross(best.normal, direction);  // its length is the sine of the angle: accurate near zero
    best.weight = most > 0.0 ? alignment(norm2(miss)) : 0.0;
    return best;
}

/// The supporting edge of the body most square to `direction`, and where it is.
struct Rim {
    Vec3 from, to;
    double weight = 0.0;
};

GF_FN Rim rim(const ContactBody& body, const Vec3& direction)
{
    const ShapesView& s = body.shapes;
    const PlacedCore core = body.core();
    const Vec3 d = rotate_back(body.orientation, direction);
    const double top = dot(core.vertices[core.support(direction)], d);
    const double tolerance = 1e-9 * s.bounding_radius[body.shape];
    Rim best;
    double least = 2.0;
    for (int e = s.edge_begin[body.shape]; e < s.edge_begin[body.shape + 1]; ++e) {
        const Vec3 p = core.vertices[s.edges[e].from], q = core.vertices[s.edges[e].to];
        const double hp = dot(p, d), hq = dot(q, d);
        if (std::fmax(hp, hq) < top - tolerance) continue;
        const double tilt2 = (hp - hq) * (hp - hq) / norm2(q - p);
        if (tilt2 < least - 1e-12) {
            least = tilt2;
            best.from = body.position + rotate(body.orientation, p);
            best.to = body.position + rotate(body.orientation, q);
        }
    }
    if (least < 2.0) best.weight = alignment(least);
    return best;
}

/// Polygon in the contact plane with room for two clipped faces.
struct FlatPolygon {
    static constexpr int room = 2 * max_face_vertices + 2;
    double x[room], y[room];
    int count = 0;

    GF_FN void add(double px, double py)
    {
        if (count < room) {
            x[count] = px;
            y[count] = py;
            ++count;
        }
    }
};

/// Part of p where c0 + cx x + cy y >= 0.
GF_FN void clip(FlatPolygon& p, double c0, double cx, double cy)
{
    FlatPolygon kept;
    for (int i = 0; i < p.count; ++i) {
        const int j = i + 1 < p.count ? i + 1 : 0;
        const double hi = c0 + cx * p.x[i] + cy * p.y[i], hj = c0 + cx * p.x[j] + cy * p.y[j];
        if (hi >= 0.0) kept.add(p.x[i], p.y[i]);
        if ((hi > 0.0 && hj < 0.0) || (hi < 0.0 && hj > 0.0)) {
            const double t = hi / (hi - hj);
            kept.add(p.x[i] + t * (p.x[j] - p.x[i]), p.y[i] + t * (p.y[j] - p.y[i]));
        }
    }
    p = kept;
}

/// Plane of the contact: origin and two directions, right-handed with the normal.
struct ContactPlane {
    Vec3 origin, e1, e2, normal;

    GF_FN ContactPlane(const Vec3& o, const Vec3& n) : origin(o), e1(any_perpendicular(n)), e2(cross(n, e1)), normal(n)
    {
    }
    /// Height field of a plane nf . x = offset over this plane: height = c0 + cx x + cy y.
    GF_FN void height(const Vec3& nf, double offset, double& c0, double& cx, double& cy) const
    {
        const double s = 1.0 / dot(nf, normal);
        c0 = (offset - dot(nf, origin)) * s;
        cx = -dot(nf, e1) * s;
        cy = -dot(nf, e2) * s;
    }
};

/// Face outline in the contact plane; `mirrored` faces are added backwards so that all run counter-clockwise.
GF_FN FlatPolygon outline(const ContactBody& body, int face, const ContactPlane& plane, bool mirrored)
{
    const ShapesView& s = body.shapes;
    FlatPolygon p;
    const int begin = s.loop_begin[face], end = s.loop_begin[face + 1], first = s.vertex_begin[body.shape];
    for (int k = begin; k < end; ++k) {
        const int at = mirrored ? end - 1 - (k - begin) : k;
        const Vec3 v = body.position + rotate(body.orientation, s.vertices[first + s.loops[at]]) - plane.origin;
        p.add(dot(v, plane.e1), dot(v, plane.e2));
    }
    return p;
}

GF_FN void clip(FlatPolygon& p, const FlatPolygon& window)
{
    for (int i = 0; i < window.count && p.count > 0; ++i) {
        const int j = i + 1 < window.count ? i + 1 : 0;
        const double dx = window.x[j] - window.x[i], dy = window.y[j] - window.y[i];
        clip(p, dy * window.x[i] - dx * window.y[i], -dy, dx);
    }
}

GF_FN double area_of(const FlatPolygon& p)
{
    double twice = 0.0;
    for (int i = 1; i + 1 < p.count; ++i) {
        twice += (p.x[i] - p.x[0]) * (p.y[i + 1] - p.y[0]) - (p.x[i + 1] - p.x[0]) * (p.y[i] - p.y[0]);
    }
    return 0.5 * twice;
}

/// Area integrals of a linear field over the part of the polygon where it is positive.
GF_FN Resultant face_on_face(const ContactBody& a, const Facing& fa, const ContactBody& b, const Facing& fb,
                             const Vec3& near)
{
    Resultant r;
    r.normal = normalized(fa.normal - fb.normal);
    const ContactPlane plane(near, r.normal);
    FlatPolygon p = outline(a, fa.face, plane, false);
    clip(p, outline(b, fb.face, plane, true));
    r.footprint = area_of(p);
    double a0, ax, ay, b0, bx, by;
    plane.height(fa.normal, fa.offset, a0, ax, ay);
    plane.height(fb.normal, fb.offset, b0, bx, by);
    const double g0 = a.radius() + b.radius() + a0 - b0, gx = ax - bx, gy = ay - by;
    clip(p, g0, gx, gy);
    double mx = 0.0, my = 0.0;
    for (int i = 1; i + 1 < p.count; ++i) {
        const double x[3] = {p.x[0], p.x[i], p.x[i + 1]}, y[3] = {p.y[0], p.y[i], p.y[i + 1]};
        const double area = 0.5 * ((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]));
        double g[3];
        for (int k = 0; k < 3; ++k) {
            g[k] = std::fmax(0.0, g0 + gx * x[k] + gy * y[k]);
            r.depth = std::fmax(r.depth, g[k]);
        }
        const double sum = g[0] + g[1] + g[2];
        r.area += area;
        r.volume += area / 3.0 * sum;
        r.square += area / 12.0 * (g[0] * g[0] + g[1] * g[1] + g[2] * g[2] + g[0] * g[1] + g[1] * g[2] + g[2] * g[0]);
        for (int k = 0; k < 3; ++k) {
            mx += area / 12.0 * x[k] * (g[k] + sum);
            my += area / 12.0 * y[k] * (g[k] + sum);
        }
    }
    if (r.volume <= 0.0 || r.area <= 0.0) return {};
    const double cx = mx / r.volume, cy = my / r.volume;
    const double middle = 0.5 * (a0 + ax * cx + ay * cy + a.radius() + b0 + bx * cx + by * cy - b.radius());
    r.position = plane.origin + cx * plane.e1 + cy * plane.e2 + middle * r.normal;
    r.twist_radius = std::sqrt(r.area / std::numbers::pi);
    return r;
}

/// Line contact with penetrations g0, g1 at its ends p0, p1 (points half way between the two surfaces).
GF_FN Resultant on_line(const Vec3& n, Vec3 p0, double g0, Vec3 p1, double g1, double reference_area)
{
    Resultant r;
    if (g0 <= 0.0 && g1 <= 0.0) return r;
    double share = 1.0;  // part of the line in contact
    if (g0 < 0.0) {
        share = g1 / (g1 - g0);
        p0 = p1 + share * (p0 - p1);
        g0 = 0.0;
    } else if (g1 < 0.0) {
        share = g0 / (g0 - g1);
        p1 = p0 + share * (p1 - p0);
        g1 = 0.0;
    }
    r.normal = n;
    r.area = reference_area * share;
    r.volume = r.area * 0.5 * (g0 + g1);
    r.square = r.area * (g0 * g0 + g0 * g1 + g1 * g1) / 6.0;
    r.depth = std::fmax(g0, g1);
    const double sum = g0 + g1;
    const double t = sum > 0.0 ? (g0 + 2.0 * g1) / (3.0 * sum) : 0.5;
    r.position = p0 + t * (p1 - p0);
    return r;
}

/// Edge of one body over a face of the other; n points from the face's body to the edge's.
GF_FN Resultant edge_on_face(const ContactBody& flat, const Facing& face, const Rim& edge, double edge_radius,
                             double reference_area)
{
    const ContactPlane plane(face.normal * face.offset, face.normal);
    const FlatPolygon window = outline(flat, face.face, plane, false);
    const Vec3 d = edge.to - edge.from, p = edge.from - plane.origin;
    const double px = dot(p, plane.e1), py = dot(p, plane.e2), dx = dot(d, plane.e1), dy = dot(d, plane.e2);
    double t0 = 0.0, t1 = 1.0;
    for (int i = 0; i < window.count; ++i) {
        const int j = i + 1 < window.count ? i + 1 : 0;
        const double wx = window.x[j] - window.x[i], wy = window.y[j] - window.y[i];
        const double h = wx * (py - window.y[i]) - wy * (px - window.x[i]), slope = wx * dy - wy * dx;
        if (slope == 0.0) {
            if (h < 0.0) return {};
            continue;
        }
        const double t = -h / slope;
        if (slope > 0.0)
            t0 = std::fmax(t0, t);
        else
            t1 = std::fmin(t1, t);
    }
    if (t0 >= t1) return {};
    const double radii = flat.radius() + edge_radius;
    const Vec3 q0 = edge.from + t0 * d, q1 = edge.from + t1 * d;
    const double h0 = dot(q0, face.normal) - face.offset, h1 = dot(q1, face.normal) - face.offset;
    const auto middle = [&](const Vec3& q, double h) {
        return q - (0.5 * (h - flat.radius() + edge_radius)) * face.normal;
    };
    return on_line(face.normal, middle(q0, h0), radii - h0, middle(q1, h1), radii - h1, reference_area);
}

/// Two parallel edges side by side.
GF_FN Resultant edge_on_edge(const Rim& ea, double ra, const Rim& eb, double rb, const Vec3& n, double reference_area)
{
    const Vec3 d = normalized(ea.to - ea.from);
    const double a0 = 0.0, a1 = norm(ea.to - ea.from);
    double b0 = dot(eb.from - ea.from, d), b1 = dot(eb.to - ea.from, d);
    Vec3 pb0 = eb.from, pb1 = eb.to;
    if (b0 > b1) {
        const double s = b0;
        b0 = b1;
        b1 = s;
        pb0 = eb.to;
        pb1 = eb.from;
    }
    const double s0 = std::fmax(a0, b0), s1 = std::fmin(a1, b1);
    if (s0 >= s1) return {};
    const auto gap_point = [&](double s, double& g) {
        const Vec3 qa = ea.from + s * d, qb = pb0 + ((s - b0) / (b1 - b0)) * (pb1 - pb0);
        const Vec3 between = tangential(qb - qa, d);
        const double distance = norm(between);
        g = ra + rb - distance;
        return qa + (0.5 * (distance + ra - rb)) * normalized(between);
    };
    double g0 = 0.0, g1 = 0.0;
    const Vec3 p0 = gap_point(s0, g0), p1 = gap_point(s1, g1);
    return on_line(tangential(n, d) * (1.0 / norm(tangential(n, d))), p0, g0, p1, g1, reference_area);
}

GF_FN void blend(Resultant& sum, double weight, const Resultant& r)
{
    if (weight <= 0.0 || r.volume <= 0.0) return;
    sum.normal += weight * r.volume * r.normal;
    sum.position += weight * r.volume * r.position;
    sum.volume += weight * r.volume;
    sum.square += weight * r.square;
    sum.area += weight * r.area;
    sum.twist_radius += weight * r.twist_radius;
    sum.footprint += weight * r.footprint;
    sum.depth = std::fmax(sum.depth, r.depth);
}

}  // namespace manifold_detail

/// Contact of two bodies; normal zero if they are apart. depth = the summed dilation radii marks penetrating cores.
GF_FN ContactPoint contact_manifold(const ContactBody& a, const ContactBody& b)
{
    using namespace manifold_detail;
    ContactPoint none;
    const double radii = a.radius() + b.radius();
    const ClosestPoints near = closest_points(a.core(), b.core(), b.position - a.position);
    if (near.distance >= radii) return none;
    if (near.distance <= core_contact_share * radii) {
        none.depth = radii;
        return none;
    }
    const Vec3 n = (near.b - near.a) * (1.0 / near.distance);
    const double area_a = a.shapes.point_area[a.shape], area_b = b.shapes.point_area[b.shape];
    double reference = area_a > 0.0 && area_b > 0.0 ? std::fmin(area_a, area_b) : std::fmax(area_a, area_b);
    if (reference == 0.0) {  // two round bodies: the circle of their harmonic mean radius
        const double r = a.radius() * b.radius() / radii;
        reference = std::numbers::pi * r * r;
    }

    Resultant sum;
    const Facing fa = facing(a, n), fb = facing(b, -n);
    const double flat = fa.weight * fb.weight;
    if (flat > 0.0) blend(sum, flat, face_on_face(a, fa, b, fb, near.a));
    if (flat < 1.0) {
        const Rim ea = rim(a, n), eb = rim(b, -n);
        const double face_a = fa.weight * eb.weight, face_b = ea.weight * fb.weight;
        double edges = 0.0;
        if (ea.weight > 0.0 && eb.weight > 0.0) {
            edges = ea.weight * eb.weight *
                    alignment(norm2(cross(normalized(ea.to - ea.from), normalized(eb.to - eb.from))));
        }
        double line = 0.0;
        Resultant on_segment;
        if (face_a > 0.0 && face_a >= face_b && face_a >= edges) {
            line = face_a;
            on_segment = edge_on_face(a, fa, eb, b.radius(), reference);
        } else if (face_b > 0.0 && face_b >= edges) {
            line = face_b;
            on_segment = edge_on_face(b, fb, ea, a.radius(), reference);
            on_segment.normal = -on_segment.normal;
        } else if (edges > 0.0) {
            line = edges;
            on_segment = edge_on_edge(ea, a.radius(), eb, b.radius(), n, reference);
        }
        if (on_segment.volume <= 0.0) line = 0.0;
        blend(sum, (1.0 - flat) * line, on_segment);
        if (line < 1.0) {
            Resultant point;
            const double g = radii - near.distance;
            point.normal = n;
            point.position = near.a + (0.5 * (near.distance + a.radius() - b.radius())) * n;
            point.volume = reference * g;
            point.square = 0.5 * reference * g * g;
            point.area = reference;
            point.depth = g;
            blend(sum, (1.0 - flat) * (1.0 - line), point);
        }
    }
    if (sum.volume <= 0.0) return none;
    ContactPoint c;
    c.normal = normalized(sum.normal);
    c.position = sum.position * (1.0 / sum.volume);
    c.overlap_volume = sum.volume;
    c.overlap_square = sum.square;
    c.area = sum.area;
    c.twist_radius = sum.twist_radius;
    c.footprint = sum.footprint;
    c.depth = sum.depth;
    return c;
}

}  // namespace grainfrac
