// SPDX-License-Identifier: GPL-3.0-or-later
// How two bodies overlap at the faces that look at each other: moments of the penetration, and what a motion does to
// them.
//
// Over a face of one body the penetration g(x) by a face of the other, the moving one, is linear. With P the part of
// the shared polygon where g > 0,
//   V = int_P g dA,   S = int_P g^2/2 dA,   Q = int_P g |x - x_c|^2 dA,   x_c the centroid of g.
// A rigid motion delta(y) of the moving body changes g by -beta.delta(y)/(beta.N), at the point y of its face above x
// (N the normal of the plane, beta the inward one of the moving face), and moves those edges of P that are its own;
// where g = 0 ends P, nothing is lost. So for any potential U(V, S, Q)
//   dU = int_P D dg dA + int_(its edges) D_1 m.delta(y) ds
//   D  = U_V + U_S g + U_Q |x - x_c|^2,   D_1 = U_V g + U_S g^2/2 + U_Q g |x - x_c|^2,
// m the outward normal of the edge: exact, and free of the positions of the polygon's vertices.
//
// A line in contact counts as a face as wide as g/2 is: V = int g^2/2 ds, S = int g^3/4 ds, Q = int g^2/2 |x - x_c|^2
// ds. (A width that did not vanish with g would make the force jump where a line comes into contact.)
#pragma once

#include "contact/flat_polygon.h"
#include "geometry/vec3.h"

namespace grainfrac {

/// A force and its moment about a point.
struct Wrench {
    Vec3 force, moment;

    GF_FN void add(const Vec3& f, const Vec3& arm)
    {
        force += f;
        moment += cross(arm, f);
    }
    GF_FN void add(const Wrench& w, double factor)
    {
        force += factor * w.force;
        moment += factor * w.moment;
    }
};

/// Moments of the penetration.
struct OverlapMoments {
    double V = 0.0, S = 0.0, Q = 0.0;  ///< [m^3], [m^4], [m^5]

    GF_FN void add(const OverlapMoments& m, double weight)
    {
        V += weight * m.V;
        S += weight * m.S;
        Q += weight * m.Q;
    }
};

/// The integrals that they are made of. Points from one origin near the contact.
struct RawMoments {
    double V = 0.0, S = 0.0, I = 0.0;  // I = int g |x|^2
    Vec3 X;                            // int g x

    GF_FN void add(double g, const Vec3& x, double weight)
    {
        const double gw = g * weight;
        V += gw;
        S += 0.5 * g * gw;
        X += gw * x;
        I += gw * norm2(x);
    }
    GF_FN OverlapMoments about_centroid(Vec3& centroid) const
    {
        OverlapMoments m;
        if (V <= 0.0 || S <= 0.0) return m;
        centroid = X * (1.0 / V);
        m.V = V;
        m.S = S;
        m.Q = larger(0.0, I - norm2(X) / V);
        return m;
    }
};

/// Derivatives of a potential by the moments.
struct OverlapSlopes {
    double V = 0.0, S = 0.0, Q = 0.0;

    /// By g, where the square of the distance from the centroid is `spread`.
    GF_FN double by_gap(double g, double spread) const { return V + S * g + Q * spread; }
    GF_FN double by_area(double g, double spread) const { return g * (V + 0.5 * S * g + Q * spread); }
    /// The same along a line.
    GF_FN double by_line_gap(double g, double spread) const { return g * (V + 0.75 * S * g + Q * spread); }
    GF_FN double by_length(double g, double spread) const { return 0.5 * g * g * (V + 0.5 * S * g + Q * spread); }
};

/// A face of each body, over the plane of one of them.
struct FaceOverlap {
    Vec3 origin, e1, e2, N;               // of the plane
    Vec3 beta;                            // inward normal of the moving face
    double cosine = 0.0;                  // beta . N
    double z0 = 0.0, zx = 0.0, zy = 0.0;  // height of the moving face over the plane
    double g0 = 0.0, gx = 0.0, gy = 0.0;  // penetration
    FlatPolygon p;
    double cx = 0.0, cy = 0.0;  // centroid of g, once the moments are taken

    GF_FN double g(double x, double y) const { return g0 + gx * x + gy * y; }
    GF_FN Vec3 on_plane(double x, double y) const { return origin + x * e1 + y * e2; }

    GF_FN double spread(double x, double y) const { return (x - cx) * (x - cx) + (y - cy) * (y - cy); }

    /// visit(g, x, y, weight) on points that integrate cubics over the polygon exactly.
    template <class Visit>
    GF_FN void integrate(Visit&& visit) const
    {
        for (int i = 1; i + 1 < p.count; ++i) {
            const double x1 = p.x[i] - p.x[0], y1 = p.y[i] - p.y[0], x2 = p.x[i + 1] - p.x[0], y2 = p.y[i + 1] - p.y[0];
            const double area = 0.5 * (x1 * y2 - x2 * y1);
            // Strang & Fix 1973: centroid -27/48, and 25/48 at (0.6, 0.2, 0.2)
            const auto at = [&](double s, double t, double w) {
                const double x = p.x[0] + s * x1 + t * x2, y = p.y[0] + s * y1 + t * y2;
                visit(g(x, y), x, y, w * area);
            };
            at(1.0 / 3.0, 1.0 / 3.0, -27.0 / 48.0);
            at(0.2, 0.2, 25.0 / 48.0);
            at(0.6, 0.2, 25.0 / 48.0);
            at(0.2, 0.6, 25.0 / 48.0);
        }
    }

    GF_FN OverlapMoments moments()
    {
        RawMoments m;
        integrate([&](double gap, double x, double y, double w) { m.add(gap, {x, y, 0.0}, w); });
        Vec3 c;
        const OverlapMoments result = m.about_centroid(c);
        cx = c.x;
        cy = c.y;
        return result;
    }

    /// -dU on the moving body, about the origin of the points.
    GF_FN Wrench wrench(const OverlapSlopes& U) const
    {
        Wrench w;
        double D0 = 0.0, Dx = 0.0, Dy = 0.0;
        integrate([&](double gap, double x, double y, double area) {
            const double D = area * U.by_gap(gap, spread(x, y));
            D0 += D;
            Dx += x * D;
            Dy += y * D;
        });
        const Vec3 push = beta * (1.0 / cosine);
        w.add(D0 * push, origin + z0 * N);
        w.moment += cross(Dx * (e1 + zx * N) + Dy * (e2 + zy * N), push);

        for (int i = 0; i < p.count; ++i) {
            if (!p.moving[i]) continue;
            const int j = i + 1 < p.count ? i + 1 : 0;
            const double dx = p.x[j] - p.x[i], dy = p.y[j] - p.y[i];
            const Vec3 m_ds = dy * e1 - dx * e2;          // outward normal times the length
            const auto at = [&](double t, double part) {  // Gauss, exact for quintics
                const double x = p.x[i] + t * dx, y = p.y[i] + t * dy;
                const double D1 = U.by_area(larger(0.0, g(x, y)), spread(x, y));
                w.add(-part * D1 * m_ds, on_plane(x, y) + (z0 + zx * x + zy * y) * N);
            };
            constexpr double t = 0.112701665379258311;
            at(t, 5.0 / 18.0);
            at(0.5, 8.0 / 18.0);
            at(1.0 - t, 5.0 / 18.0);
        }
        return w;
    }
};

/// A straight edge over a face: the same along a line.
struct LineOverlap {
    Vec3 origin, d, N;          // edge's point s = 0, its direction, normal of the face
    double g0 = 0.0, gs = 0.0;  // penetration along the edge
    double s0 = 0.0, s1 = 0.0;  // part with g > 0 over the face
    Vec3 m0, m1;                // outward normals of the face's edges that end it; zero where something else does
    Vec3 centroid;              // of g, once the moments are taken

    GF_FN double g(double s) const { return g0 + gs * s; }

    template <class Visit>
    GF_FN void integrate(Visit&& visit) const
    {
        constexpr double t = 0.112701665379258311;  // Gauss, exact for quintics
        visit(s0 + t * (s1 - s0), 5.0 / 18.0 * (s1 - s0));
        visit(0.5 * (s0 + s1), 8.0 / 18.0 * (s1 - s0));
        visit(s1 - t * (s1 - s0), 5.0 / 18.0 * (s1 - s0));
    }

    GF_FN OverlapMoments moments()
    {
        RawMoments m;
        integrate([&](double s, double w) { m.add(g(s), origin + s * d, 0.5 * g(s) * w); });
        return m.about_centroid(centroid);
    }

    /// -dU on the body of the edge, about the origin of the points.
    GF_FN Wrench wrench(const OverlapSlopes& U) const
    {
        Wrench w;
        integrate([&](double s, double part) {
            const Vec3 x = origin + s * d;
            w.add(part * U.by_line_gap(g(s), norm2(x - centroid)) * N, x);
        });
        const auto end = [&](double s, const Vec3& m) {
            const double slant = dot(m, d);
            if (slant == 0.0) return;
            const Vec3 x = origin + s * d;
            w.add(U.by_length(larger(0.0, g(s)), norm2(x - centroid)) / std::fabs(slant) * m, x);
        };
        end(s0, m0);
        end(s1, m1);
        return w;
    }
};

/// Two edges side by side: along the first, the distance to the line of the second. Points from one origin.
struct EdgeOverlap {
    Vec3 from, d;              // of the first edge
    Vec3 other_from, other_d;  // of the second
    double radii = 0.0;
    double s0 = 0.0, s1 = 0.0;                // part of the first beside the second and in contact
    Vec3 end0, end1;                          // ends of the second that limit it
    bool other_ends[2] = {false, false};      // whether they do
    double weight = 0.0, weight_slope = 0.0;  // by the squared sine of their angle
    Vec3 centroid;

    GF_FN double g(double s, Vec3& away, Vec3& foot) const
    {
        const Vec3 w = from + s * d - other_from, along = dot(w, other_d) * other_d;
        const double distance = norm(w - along);
        away = (w - along) * (1.0 / distance);
        foot = other_from + along;
        return radii - distance;
    }

    template <class Visit>
    GF_FN void integrate(Visit&& visit) const
    {
        const auto at = [&](double t, double weight_of) { visit(s0 + t * (s1 - s0), weight_of * (s1 - s0)); };
        constexpr double t1 = 0.0694318442029737124, t2 = 0.330009478207571868;  // Gauss, exact to degree 7
        constexpr double w1 = 0.173927422568726929, w2 = 0.326072577431273071;
        at(t1, w1);
        at(t2, w2);
        at(1.0 - t2, w2);
        at(1.0 - t1, w1);
    }

    GF_FN OverlapMoments moments()
    {
        RawMoments m;
        Vec3 away, foot;
        integrate([&](double s, double w) {
            const double gap = larger(0.0, g(s, away, foot));
            m.add(gap, from + s * d, 0.5 * gap * w);
        });
        return m.about_centroid(centroid);
    }

    /// -d(weight U) on the second body; `m` are the moments of this pair.
    GF_FN Wrench wrench(const OverlapSlopes& U, const OverlapMoments& m) const
    {
        Wrench w;
        Vec3 away, foot;
        integrate([&](double s, double part) {
            const double gap = larger(0.0, g(s, away, foot));
            const double D = U.by_line_gap(gap, norm2(from + s * d - centroid));
            w.add(-weight * part * D * away, foot);
        });
        const auto end = [&](double s, const Vec3& at, double side) {
            const double gap = larger(0.0, g(s, away, foot));
            w.add(-side * weight * U.by_length(gap, norm2(from + s * d - centroid)) * d, at);
        };
        if (other_ends[0]) end(s0, end0, -1.0);
        if (other_ends[1]) end(s1, end1, 1.0);
        if (weight_slope != 0.0) {
            const double sum = U.V * m.V + U.S * m.S + U.Q * m.Q;
            w.moment += -2.0 * weight_slope * sum * cross(other_d, cross(cross(d, other_d), d));
        }
        return w;
    }
};

}  // namespace grainfrac
