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

#include "contact/face_overlap.h"
#include "contact/line_overlap.h"
#include "model/contacts.h"

namespace grainfrac {

/// Cores nearer than this share of the summed dilation radii are penetrating: an error state, never extrapolated.
inline constexpr double core_contact_share = 1e-6;
/// A penetration below this share of the summed radii is round-off of the distance, no contact yet: volume and area of
/// such a sliver do not belong together, and force, stiffness and dashpot of grains that merely touch would be
/// anything.
inline constexpr double least_penetration = 1e-10;

namespace manifold_detail {

/// A_0 over A_ref: the sum of the two stiffnesses then never falls by more than 6 % while an area grows from nothing.
constexpr double full_face = 1.5;
/// l_0 over sqrt(A_ref): half an edge of the face that A_ref is a quarter of.
constexpr double full_line = 1.0;

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
    const PlacedCore core_a = a.core(), core_b = b.core();
    const ClosestPoints near = closest_points(core_a, core_b, b.position - a.position, corners);
    if (!they_press(near, radii, clearance, c)) return c;
    if (a.is_ball() || b.is_ball()) return ball_contact(a, b, near);
    const Vec3 n = (near.b - near.a) * (1.0 / near.distance);
    const double A_ref = reference_area(a, b);
    const double g_p = radii - near.distance;
    const Vec3 middle = near.a + (0.5 * (near.distance + a.radius() - b.radius())) * n;
    const PlacedBody body_a(a, core_a, middle), body_b(b, core_b, middle);  // all points from there
    const Vec3 at_a = near.a - middle, at_b = near.b - middle;
    const Slab slab{n, near.distance, radii}, other_side = slab.seen_from_b();
    const FacingFaces faces_a(body_a, slab, at_a), faces_b(body_b, other_side, at_b);

    Overlap faces, lines;
    for (int i = 0; i < faces_a.count; ++i) {
        for (int j = 0; j < faces_b.count; ++j) add_face_pair(body_a, faces_a[i], body_b, faces_b[j], radii, faces);
    }
    const PressedArea pressed(faces.m, A_ref);
    if (pressed.rest > 0.0) {  // else faces carry alone
        if (a.has_one_edge()) {
            for (int j = 0; j < faces_b.count; ++j)
                lines.add_other_side(rod_overlap(body_b, faces_b[j], body_a, radii));
        } else if (b.has_one_edge()) {
            for (int i = 0; i < faces_a.count; ++i) {
                if (faces_a[i].bears) lines.add(rod_overlap(body_a, faces_a[i], body_b, radii), 1.0);
            }
        }
        const double depth = 1.01 * g_p;
        const FacingEdges edges_b(body_b, other_side, at_b, depth, slab.steepest2_of_b());
        if (edges_b.count > 0) {
            const FacingEdges edges_a(body_a, slab, at_a, depth, slab.steepest2_of_a());
            for (int i = 0; i < edges_a.count; ++i) {
                for (int j = 0; j < edges_b.count; ++j) add_edge_pair(edges_a[i], edges_b[j], radii, lines);
            }
        }
    }

    const Potential p(faces.m, pressed, lines.m, A_ref, g_p);
    Wrench w = faces.wrench(p.by_faces);  // on b, about `middle`
    w.add(lines.wrench(p.by_lines), 1.0);
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
