// SPDX-License-Identifier: GPL-3.0-or-later
// Overlap of two bodies along lines: the one edge of a rod on a face, and edges side by side (overlap.h).
#pragma once

#include "contact/contact_body.h"
#include "contact/overlap.h"

namespace grainfrac {

namespace line_detail {

/// Squared sine of the angle from which edges count less as lying side by side (2 degrees).
constexpr double parallel_sine2 = 1.2e-3;

/// visit(wrench, D) for each moment: D its integrand where g changes, at a point with gap g and squared distance
/// `spread` from the centroid.
template <class Visit>
GF_FN void by_gap(Overlap& o, double g, double spread, Visit&& visit)
{
    visit(o.by_V, g);
    visit(o.by_S, 0.75 * g * g);
    visit(o.by_Q, g * spread);
}
/// The same where the length changes.
template <class Visit>
GF_FN void by_length(Overlap& o, double g, double spread, Visit&& visit)
{
    const double half = 0.5 * g * g;
    visit(o.by_V, half);
    visit(o.by_S, 0.5 * half * g);
    visit(o.by_Q, half * spread);
}

/// A straight edge over a face.
struct RodOnFace {
    Vec3 origin, d, N;          // edge's point s = 0, its direction, normal of the face
    double g0 = 0.0, gs = 0.0;  // penetration along the edge
    double s0 = 0.0, s1 = 0.0;  // part with g > 0 over the face
    Vec3 m0, m1;                // outward normals of the face's edges that end it; zero where something else does

    GF_FN double g(double s) const { return g0 + gs * s; }

    template <class Visit>
    GF_FN void integrate(Visit&& visit) const
    {
        constexpr double t = 0.112701665379258311;  // Gauss, exact for quintics
        visit(s0 + t * (s1 - s0), 5.0 / 18.0 * (s1 - s0));
        visit(0.5 * (s0 + s1), 8.0 / 18.0 * (s1 - s0));
        visit(s1 - t * (s1 - s0), 5.0 / 18.0 * (s1 - s0));
    }

    /// On the body of the edge.
    GF_FN Overlap overlap() const
    {
        Overlap o;
        RawMoments raw;
        integrate([&](double s, double w) { raw.add(g(s), origin + s * d, 0.5 * g(s) * w); });
        Vec3 centroid;
        o.m = raw.about_centroid(centroid);
        if (o.m.V <= 0.0) return o;
        integrate([&](double s, double part) {
            const Vec3 x = origin + s * d;
            by_gap(o, g(s), norm2(x - centroid), [&](Wrench& w, double D) { w.add(part * D * N, x); });
        });
        const auto end = [&](double s, const Vec3& m) {
            const double slant = dot(m, d);
            if (slant == 0.0) return;
            const Vec3 x = origin + s * d;
            by_length(o, larger(0.0, g(s)), norm2(x - centroid),
                      [&](Wrench& w, double D) { w.add(D / std::fabs(slant) * m, x); });
        };
        end(s0, m0);
        end(s1, m1);
        return o;
    }
};

/// Two edges side by side: along the first, the distance to the line of the second.
struct EdgesSideBySide {
    PlacedEdge first, second;
    double radii = 0.0;
    double s0 = 0.0, s1 = 0.0;            // part of the first beside the second and in contact
    Vec3 end0, end1;                      // ends of the second that limit it
    bool other_ends[2] = {false, false};  // whether they do

    GF_FN Vec3 at(double s) const { return first.from + s * first.d; }
    GF_FN double g(double s, Vec3& away, Vec3& foot) const
    {
        const Vec3 w = at(s) - second.from, along = dot(w, second.d) * second.d;
        const double distance = norm(w - along);
        away = (w - along) * (1.0 / distance);
        foot = second.from + along;
        return larger(0.0, radii - distance);
    }

    template <class Visit>
    GF_FN void integrate(Visit&& visit) const
    {
        const auto point = [&](double t, double weight) {
            const double s = s0 + t * (s1 - s0);
            Vec3 away, foot;
            const double gap = g(s, away, foot);
            visit(at(s), gap, away, foot, weight * (s1 - s0));
        };
        constexpr double t1 = 0.0694318442029737124, t2 = 0.330009478207571868;  // Gauss, exact to degree 7
        constexpr double w1 = 0.173927422568726929, w2 = 0.326072577431273071;
        point(t1, w1);
        point(t2, w2);
        point(1.0 - t2, w2);
        point(1.0 - t1, w1);
    }

    /// On the body of the second edge.
    GF_FN Overlap overlap() const
    {
        Overlap o;
        RawMoments raw;
        integrate(
            [&](const Vec3& x, double gap, const Vec3&, const Vec3&, double w) { raw.add(gap, x, 0.5 * gap * w); });
        Vec3 centroid;
        o.m = raw.about_centroid(centroid);
        if (o.m.V <= 0.0) return o;
        integrate([&](const Vec3& x, double gap, const Vec3& away, const Vec3& foot, double part) {
            by_gap(o, gap, norm2(x - centroid), [&](Wrench& w, double D) { w.add(-part * D * away, foot); });
        });
        const auto end = [&](double s, const Vec3& point, double side) {
            Vec3 away, foot;
            by_length(o, g(s, away, foot), norm2(at(s) - centroid),
                      [&](Wrench& w, double D) { w.add(-side * D * first.d, point); });
        };
        if (other_ends[0]) end(s0, end0, -1.0);
        if (other_ends[1]) end(s1, end1, 1.0);
        return o;
    }
};

/// Where two edges are in contact along each other; false if nowhere.
GF_FN bool find_part(double sine2, EdgesSideBySide& o)
{
    // squared distance to the other line: A s^2 + 2 B s + C, below radii^2 between the roots
    const Vec3 w = o.first.from - o.second.from;
    const double c = dot(o.first.d, o.second.d), h = dot(w, o.second.d);
    const double A = larger(sine2, 1e-28), B = dot(w, o.first.d) - c * h, C = norm2(w) - h * h - o.radii * o.radii;
    const double inside = B * B - A * C;
    if (inside <= 0.0) return false;
    const double q = -(B + (B >= 0.0 ? 1.0 : -1.0) * std::sqrt(inside));
    double low = q / A, high = q != 0.0 ? C / q : 0.0;
    if (low > high) {
        const double t = low;
        low = high;
        high = t;
    }
    o.s0 = larger(0.0, low);
    o.s1 = smaller(o.first.length, high);
    for (int k = 0; k < 2; ++k) {
        const Vec3 end = o.second.from + (k == 0 ? 0.0 : o.second.length) * o.second.d;
        const double s = dot(end - o.first.from, o.first.d);
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
    return o.s1 > o.s0;
}

}  // namespace line_detail

/// The only edge of `rod`, which moves, over a face of `flat`.
GF_FN Overlap rod_overlap(const PlacedBody& flat, const PlacedFace& face, const PlacedBody& rod, double radii)
{
    const Edge e = rod.shapes.edges[rod.shapes.edge_begin[rod.shape]];
    const Vec3 from = rod.at(e.from), to = rod.at(e.to);
    line_detail::RodOnFace o;
    const double length = norm(to - from);
    o.origin = from;
    o.d = (to - from) * (1.0 / length);
    o.N = face.normal;
    o.g0 = radii - (dot(o.N, from) - face.offset);
    o.gs = -dot(o.N, o.d);
    o.s1 = length;
    const std::int32_t* loop = flat.shapes.loops.data + face.begin;
    for (int k = 0; k < face.count; ++k) {
        const Vec3 v = flat.at(loop[k]);
        const Vec3 m = normalized(cross(flat.at(loop[k + 1 < face.count ? k + 1 : 0]) - v, o.N));
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
        return {};
    }
    return o.s1 > o.s0 ? o.overlap() : Overlap{};
}

/// Adds edge i of a beside edge j of b, which moves.
GF_FN void add_edge_pair(const PlacedEdge& i, const PlacedEdge& j, double radii, Overlap& sum)
{
    using namespace line_detail;
    const double sine2 = norm2(cross(i.d, j.d));
    if (sine2 >= crossing_sine2) return;
    EdgesSideBySide edges;
    edges.first = i;
    edges.second = j;
    edges.radii = radii;
    if (!find_part(sine2, edges)) return;
    const double x = larger(0.0, (sine2 - parallel_sine2) / (crossing_sine2 - parallel_sine2));
    const double weight = 1.0 - x * x * (3.0 - 2.0 * x),
                 slope = -6.0 * x * (1.0 - x) / (crossing_sine2 - parallel_sine2);
    const Overlap o = edges.overlap();
    sum.add(o, weight);
    if (slope != 0.0) {
        const Vec3 turn = (-2.0 * slope) * cross(j.d, cross(cross(i.d, j.d), i.d));
        sum.by_V.moment += o.m.V * turn;
        sum.by_S.moment += o.m.S * turn;
        sum.by_Q.moment += o.m.Q * turn;
    }
}

}  // namespace grainfrac
