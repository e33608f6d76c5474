// SPDX-License-Identifier: GPL-3.0-or-later
// How two bodies overlap, in moments of the penetration, and what a motion does to them.
//
// Over a face of one body the penetration g(x) by a face of the other, the moving one, is linear. With P the part of
// the shared polygon where g > 0,
//   V = int_P g dA,   S = int_P g^2/2 dA,   Q = int_P g |x - x_c|^2 dA,   x_c the centroid of g.
// A rigid motion delta(y) of the moving body changes g by -beta.delta(y)/(beta.N), at the point y of its face above x
// (N the normal of the plane, beta the inward one of the moving face), and moves those edges of P that are its own;
// where g = 0 ends P, nothing is lost. So for any potential U(V, S, Q)
//   dU = int_P D dg dA + int_(its edges) D_1 m.delta(y) ds
//   D  = U_V + U_S g + U_Q |x - x_c|^2,   D_1 = U_V g + U_S g^2/2 + U_Q g |x - x_c|^2,
// m the outward normal of the edge: exact, and free of the positions of the polygon's vertices. It is linear in U_V,
// U_S and U_Q: one wrench for each of them is all that the potential needs.
//
// A line in contact counts as a face as wide as g/2 is: V = int g^2/2 ds, S = int g^3/4 ds, Q = int g^2/2 |x - x_c|^2
// ds. (A width that did not vanish with g would make the force jump where a line comes into contact.)
#pragma once

#include "geometry/wrench.h"

namespace grainfrac {

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

/// Derivatives of a potential by the moments.
struct OverlapSlopes {
    double V = 0.0, S = 0.0, Q = 0.0;
};

/// The moments, and -dV, -dS, -dQ for a motion of the moving body, about the origin of the points.
struct Overlap {
    OverlapMoments m;
    Wrench by_V, by_S, by_Q;

    GF_FN void add(const Overlap& o, double weight)
    {
        m.add(o.m, weight);
        by_V.add(o.by_V, weight);
        by_S.add(o.by_S, weight);
        by_Q.add(o.by_Q, weight);
    }
    /// One that is known for the body that does not move.
    GF_FN void add_other_side(const Overlap& o)
    {
        m.add(o.m, 1.0);
        by_V.add(o.by_V, -1.0);
        by_S.add(o.by_S, -1.0);
        by_Q.add(o.by_Q, -1.0);
    }
    /// -dU of a potential with these derivatives.
    GF_FN Wrench wrench(const OverlapSlopes& U) const
    {
        Wrench w;
        w.add(by_V, U.V);
        w.add(by_S, U.S);
        w.add(by_Q, U.Q);
        return w;
    }
};

/// The integrals that moments are made of. Points from one origin near the contact.
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

}  // namespace grainfrac
