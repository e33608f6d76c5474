// SPDX-License-Identifier: GPL-3.0-or-later
// Overlap of two bodies at faces that look at each other (overlap.h).
#pragma once

#include "contact/contact_body.h"
#include "contact/flat_polygon.h"
#include "contact/overlap.h"

namespace grainfrac {

namespace face_detail {

/// Cosines of the tilt between which faces stop to count as facing each other (37 and 60 degrees).
constexpr double facing_cosine = 0.8, turned_cosine = 0.5;
/// Squared sine of a tilt below which it is round-off.
constexpr double same_plane = 1e-20;
/// Edges nearer to a window's edge than this, over the squared length of that edge, are the window's.
constexpr double same_edge = 1e-9;

/// Moments of a polygon about its first corner, from the closed forms of its triangles there: of the area, and of the
/// penetration from what it is at the corners, never negative: where it is round-off its moments still belong together.
struct PolygonMoments {
    double one = 0.0, u = 0.0, v = 0.0;            // int dA, u dA, v dA
    double uu = 0.0, uv = 0.0, vv = 0.0;           // ...
    double u_rr = 0.0, v_rr = 0.0;                 // int u (u^2 + v^2) dA
    double g = 0.0, gg = 0.0, gu = 0.0, gv = 0.0;  // int g dA, g^2 dA, g u dA
    double g_rr = 0.0;                             // int g (u^2 + v^2) dA

    GF_FN PolygonMoments(const FlatPolygon& p, const double* gap)
    {
        for (int i = 1; i + 1 < p.count; ++i) {
            // corners 0, a, b: with f, g, h linear and F the sum of f at the corners,
            // int f g = A/12 (F G + sum f g) and
            // int f g h = A/60 (F G H + F sum g h + G sum f h + H sum f g + 2 sum f g h)
            const double au = p.x[i] - p.x[0], av = p.y[i] - p.y[0], bu = p.x[i + 1] - p.x[0], bv = p.y[i + 1] - p.y[0];
            const double ga = gap[i], gb = gap[i + 1], G = gap[0] + ga + gb;
            const double area2 = au * bv - bu * av, U = au + bu, V = av + bv;
            const double suu = au * au + bu * bu, suv = au * av + bu * bv, svv = av * av + bv * bv;
            const double sgu = ga * au + gb * bu, sgv = ga * av + gb * bv;
            const double a2 = au * au + av * av, b2 = bu * bu + bv * bv, most = U * U + V * V + a2 + b2;
            one += area2;
            u += area2 * U;
            v += area2 * V;
            uu += area2 * (suu + U * U);
            uv += area2 * (suv + U * V);
            vv += area2 * (svv + V * V);
            u_rr += area2 * (U * most + 2.0 * (U * suu + V * suv + au * a2 + bu * b2));
            v_rr += area2 * (V * most + 2.0 * (U * suv + V * svv + av * a2 + bv * b2));
            g += area2 * G;
            gg += area2 * (gap[0] * gap[0] + ga * ga + gb * gb + G * G);
            gu += area2 * (sgu + G * U);
            gv += area2 * (sgv + G * V);
            g_rr += area2 * (G * most + 2.0 * (U * sgu + V * sgv + ga * a2 + gb * b2));
        }
        one *= 1.0 / 2.0;
        u *= 1.0 / 6.0;
        v *= 1.0 / 6.0;
        uu *= 1.0 / 24.0;
        uv *= 1.0 / 24.0;
        vv *= 1.0 / 24.0;
        u_rr *= 1.0 / 120.0;
        v_rr *= 1.0 / 120.0;
        g *= 1.0 / 6.0;
        gg *= 1.0 / 24.0;
        gu *= 1.0 / 24.0;
        gv *= 1.0 / 24.0;
        g_rr *= 1.0 / 120.0;
    }
};

/// What acts along an edge, and that times the place along it, 0 to 1; per length.
struct EdgeSum {
    double all, along;
};

/// In the frame of the fixed face: the moving one over it, and what it presses. All points from one origin.
struct FacePlane {
    Vec3 e1, e2, N;     // the frame; the plane at z = offset
    double z0, zx, zy;  // height of the moving face
    double clear;       // penetration = clear - height

    GF_FN FacePlane(const PlacedFace& fixed, const PlacedFace& moving, double cosine, double radii)
        : N(fixed.normal), clear(radii + fixed.offset)
    {
        frame_of(N, e1, e2);
        const double per_cosine = 1.0 / cosine;
        z0 = -moving.offset * per_cosine;
        zx = dot(moving.normal, e1) * per_cosine;
        zy = dot(moving.normal, e2) * per_cosine;
    }

    GF_FN Wrench to_world(const Wrench& w) const
    {
        const auto turn = [this](const Vec3& a) { return a.x * e1 + a.y * e2 + a.z * N; };
        return {turn(w.force), turn(w.moment)};
    }

    /// Over the part `p` of the plane.
    GF_FN Overlap overlap(const FlatPolygon& p) const
    {
        Overlap o;
        const double x0 = p.x[0], y0 = p.y[0], zc = z0 + zx * x0 + zy * y0;
        double gap[FlatPolygon::room];
        for (int i = 0; i < p.count; ++i) gap[i] = larger(0.0, clear - z0 - zx * p.x[i] - zy * p.y[i]);
        const PolygonMoments m(p, gap);
        if (m.g <= 0.0 || m.gg <= 0.0) return o;
        const double m_rr = m.uu + m.vv, cu = m.gu / m.g, cv = m.gv / m.g, c2 = cu * cu + cv * cv;
        o.m.V = m.g;
        o.m.S = 0.5 * m.gg;
        o.m.Q = larger(0.0, m.g_rr - m.g * c2);

        // int D dA, u D dA and v D dA; the push is beta/(beta . N)
        const auto act = [&](double D, double Du, double Dv) {
            const Vec3 push{-zx, -zy, 1.0};
            return Wrench{D * push, cross({D * x0 + Du, D * y0 + Dv, D * zc + zx * Du + zy * Dv}, push)};
        };
        Wrench by_V = act(m.one, m.u, m.v), by_S = act(m.g, m.gu, m.gv);
        Wrench by_Q =
            act(m_rr - 2.0 * (cu * m.u + cv * m.v) + c2 * m.one, m.u_rr - 2.0 * (cu * m.uu + cv * m.uv) + c2 * m.u,
                m.v_rr - 2.0 * (cu * m.uv + cv * m.vv) + c2 * m.v);

        for (int i = 0; i < p.count; ++i) {
            if (!p.moving[i]) continue;
            const int j = i + 1 < p.count ? i + 1 : 0;
            const double ui = p.x[i] - x0, vi = p.y[i] - y0, uj = p.x[j] - x0, vj = p.y[j] - y0;
            const double gi = gap[i], gj = gap[j];
            const double du = uj - ui, dv = vj - vi, length2 = du * du + dv * dv;
            const double ri = (ui - cu) * (ui - cu) + (vi - cv) * (vi - cv);
            const double rj = (uj - cu) * (uj - cu) + (vj - cv) * (vj - cv);
            const double mixed = gi * rj + gj * ri;
            const auto add = [&](Wrench& w, const EdgeSum& D1) {  // along the inward normal times the length
                const double x = D1.all * p.x[i] + D1.along * du, y = D1.all * p.y[i] + D1.along * dv;
                const double z = D1.all * (zc + zx * ui + zy * vi) + D1.along * (zx * du + zy * dv);
                w.force.x -= D1.all * dv;
                w.force.y += D1.all * du;
                w.moment += Vec3{-z * du, -z * dv, x * du + y * dv};
            };
            // g is linear along the edge, the squared distance r from the centroid r_i, r_j and less length2 t (1 - t)
            add(by_V, {(gi + gj) / 2.0, (gi + 2.0 * gj) / 6.0});
            add(by_S, {(gi * (gi + gj) + gj * gj) / 6.0, (gi * (gi + 2.0 * gj) + 3.0 * gj * gj) / 24.0});
            add(by_Q, {(gi * ri + gj * rj) / 3.0 + mixed / 6.0 - length2 * (gi + gj) / 12.0,
                       (gi * ri + mixed + 3.0 * gj * rj) / 12.0 - length2 * (2.0 * gi + 3.0 * gj) / 60.0});
        }
        o.by_V = to_world(by_V);
        o.by_S = to_world(by_S);
        o.by_Q = to_world(by_Q);
        return o;
    }
};

/// Outline of a face along the plane's normal; `backwards` for the face that looks at the plane, so that both run
/// counter-clockwise.
GF_FN void outline(const PlacedBody& body, const PlacedFace& face, const FacePlane& plane, bool backwards,
                   FlatPolygon& p)
{
    const std::int32_t* loop = body.shapes.loops.data + face.begin;
    const Vec3 d1 = transpose_times(body.rotation, plane.e1), d2 = transpose_times(body.rotation, plane.e2);
    const double x = dot(body.centre, plane.e1), y = dot(body.centre, plane.e2);
    for (int k = 0; k < face.count; ++k) {
        const Vec3& v = body.vertices[loop[backwards ? face.count - 1 - k : k]];
        p.add(x + dot(v, d1), y + dot(v, d2), backwards);
    }
}

}  // namespace face_detail

/// What the moving face presses into the fixed one, over the plane of the latter. Nothing if V = 0.
GF_FN Overlap face_overlap(const PlacedBody& fixed, const PlacedFace& fixed_face, const PlacedBody& moving,
                           const PlacedFace& moving_face, double cosine, double radii)
{
    using namespace face_detail;
    // penetration at the corners first: mostly there is none
    const Vec3 d = transpose_times(moving.rotation, fixed_face.normal);
    const double clear = radii + fixed_face.offset - dot(fixed_face.normal, moving.centre);
    const std::int32_t* loop = moving.shapes.loops.data + moving_face.begin;
    double g[max_face_vertices];
    bool touches = false, cut = false;
    for (int k = 0; k < moving_face.count; ++k) {
        g[k] = clear - dot(d, moving.vertices[loop[moving_face.count - 1 - k]]);
        touches = touches || g[k] > 0.0;
        cut = cut || !(g[k] > 0.0);
    }
    if (!touches) return {};

    const FacePlane plane(fixed_face, moving_face, cosine, radii);
    ClippedPolygon shared;
    outline(moving, moving_face, plane, true, shared.polygon());
    if (cut) shared.keep_positive(g, 0.0);
    FlatPolygon window;
    outline(fixed, fixed_face, plane, false, window);
    for (int i = 0; i < window.count && shared.polygon().count > 0; ++i) {
        const int j = i + 1 < window.count ? i + 1 : 0;
        const double dx = window.x[j] - window.x[i], dy = window.y[j] - window.y[i];
        shared.keep_positive(dy * window.x[i] - dx * window.y[i], -dy, dx, same_edge * (dx * dx + dy * dy));
    }
    if (shared.polygon().count < 3) return {};
    return plane.overlap(shared.polygon());
}

/// Adds two faces, over the plane of either; b moves. g is the true distance if the edge in contact is the other
/// body's, else too small, so each plane counts by what it finds:
///   V = (V_1^2 + V_2^2)/(V_1 + V_2),   S = (S_1 V_1 + S_2 V_2)/(V_1 + V_2),   Q alike
/// and both the same where the faces are parallel.
GF_FN void add_face_pair(const PlacedBody& a, const PlacedFace& face_a, const PlacedBody& b, const PlacedFace& face_b,
                         double radii, Overlap& sum)
{
    using namespace face_detail;
    if (!(face_a.bears || face_b.bears)) return;
    const double cosine = -dot(face_a.normal, face_b.normal);
    if (cosine <= turned_cosine) return;
    const Vec3 tilt = cross(face_a.normal, face_b.normal);
    const bool one_plane = norm2(tilt) <= same_plane;
    Overlap over[2];
    if (face_a.bears || one_plane) over[0] = face_overlap(a, face_a, b, face_b, cosine, radii);
    if (face_b.bears && !one_plane) over[1] = face_overlap(b, face_b, a, face_a, cosine, radii);
    const double total = over[0].m.V + over[1].m.V;
    if (total <= 0.0) return;

    const double t = smaller(1.0, (cosine - turned_cosine) / (facing_cosine - turned_cosine));
    const double weight = t * t * (3.0 - 2.0 * t), slope = 6.0 * t * (1.0 - t) / (facing_cosine - turned_cosine);
    OverlapMoments m;
    for (const Overlap& o : over) m.add(o.m, o.m.V / total);
    sum.m.add(m, weight);
    for (int k = 0; k < 2; ++k) {
        const Overlap& o = over[k];
        if (o.m.V <= 0.0) continue;
        const double side = k == 0 ? weight : -weight, share = side * o.m.V / total, more = side / total;
        sum.by_V.add(o.by_V, share + more * (o.m.V - m.V));
        sum.by_S.add(o.by_S, share);
        sum.by_S.add(o.by_V, more * (o.m.S - m.S));
        sum.by_Q.add(o.by_Q, share);
        sum.by_Q.add(o.by_V, more * (o.m.Q - m.Q));
    }
    if (slope > 0.0) {  // d cos = theta . (beta x N) = theta . (N_a x N_b)
        sum.by_V.moment -= slope * m.V * tilt;
        sum.by_S.moment -= slope * m.S * tilt;
        sum.by_Q.moment -= slope * m.Q * tilt;
    }
}

}  // namespace grainfrac
