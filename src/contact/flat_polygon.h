// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons in the plane of a face, clipped against each other; each edge remembers whose it is.
#pragma once

#include "model/shapes.h"

#include <cmath>

namespace grainfrac {

/// Convex polygon, counter-clockwise, with room for two clipped faces.
struct FlatPolygon {
    static constexpr int room = 2 * max_face_vertices + 2;
    double x[room], y[room];
    bool moving[room];  ///< the edge from vertex i to the next belongs to the moving face, not to a clip
    int count = 0;

    GF_FN FlatPolygon() {}
    GF_FN FlatPolygon(const FlatPolygon&) = delete;  // the room is for the worst case: far more than is in use
    FlatPolygon& operator=(const FlatPolygon&) = delete;

    GF_FN void add(double px, double py, bool edge_moves)
    {
        if (count < room) {
            x[count] = px;
            y[count] = py;
            moving[count] = edge_moves;
            ++count;
        }
    }
};

/// Part of p where h, linear with these values at the vertices, is not negative. An edge along which it vanishes to
/// within `tolerance` [unit of h] becomes part of the clip.
GF_FN void clip(const FlatPolygon& p, const double* h, double tolerance, FlatPolygon& kept)
{
    kept.count = 0;
    for (int i = 0; i < p.count; ++i) {
        const int j = i + 1 < p.count ? i + 1 : 0;
        const double hi = h[i], hj = h[j];
        if (hi >= 0.0) {
            const bool on_line = hi <= tolerance && std::fabs(hj) <= tolerance;
            kept.add(p.x[i], p.y[i], p.moving[i] && !on_line && !(hi == 0.0 && hj < 0.0));
        }
        if ((hi > 0.0 && hj < 0.0) || (hi < 0.0 && hj > 0.0)) {
            const double t = hi / (hi - hj);
            kept.add(p.x[i] + t * (p.x[j] - p.x[i]), p.y[i] + t * (p.y[j] - p.y[i]), hi < 0.0 && p.moving[i]);
        }
    }
}

/// A polygon that is clipped again and again.
class ClippedPolygon {
public:
    GF_FN ClippedPolygon() {}
    GF_FN FlatPolygon& polygon() { return stored_[now_]; }

    GF_FN void keep_positive(const double* h, double tolerance)
    {
        clip(stored_[now_], h, tolerance, stored_[1 - now_]);
        now_ = 1 - now_;
    }
    /// Part where c0 + cx x + cy y >= 0.
    GF_FN void keep_positive(double c0, double cx, double cy, double tolerance)
    {
        const FlatPolygon& p = stored_[now_];
        double h[FlatPolygon::room];
        bool cut = false;
        for (int i = 0; i < p.count; ++i) {
            h[i] = c0 + cx * p.x[i] + cy * p.y[i];
            cut = cut || !(h[i] > tolerance);
        }
        if (cut) keep_positive(h, tolerance);
    }

private:
    FlatPolygon stored_[2];
    int now_ = 0;
};

}  // namespace grainfrac
