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
    GF_FN FlatPolygon(const FlatPolygon& p) { *this = p; }
    /// What is in use only: the room is for the worst case.
    GF_FN FlatPolygon& operator=(const FlatPolygon& p)
    {
        if (this == &p) return *this;
        for (int i = 0; i < p.count; ++i) {
            x[i] = p.x[i];
            y[i] = p.y[i];
            moving[i] = p.moving[i];
        }
        count = p.count;
        return *this;
    }

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

/// Part of p where c0 + cx x + cy y >= 0. An edge that lies on the line to within `tolerance` [unit of c0] becomes part
/// of the clip.
GF_FN void clip(FlatPolygon& p, double c0, double cx, double cy, double tolerance = 0.0)
{
    double h[FlatPolygon::room];
    bool cut = false;
    for (int i = 0; i < p.count; ++i) {
        h[i] = c0 + cx * p.x[i] + cy * p.y[i];
        cut = cut || !(h[i] > tolerance);
    }
    if (!cut) return;
    FlatPolygon kept;
    for (int i = 0; i < p.count; ++i) {
        const int j = i + 1 < p.count ? i + 1 : 0;
        const double hi = h[i], hj = h[j];
        const bool on_line = std::fabs(hi) <= tolerance && std::fabs(hj) <= tolerance;
        if (hi >= 0.0) kept.add(p.x[i], p.y[i], p.moving[i] && !on_line && !(hi == 0.0 && hj < 0.0));
        if ((hi > 0.0 && hj < 0.0) || (hi < 0.0 && hj > 0.0)) {
            const double t = hi / (hi - hj);
            kept.add(p.x[i] + t * (p.x[j] - p.x[i]), p.y[i] + t * (p.y[j] - p.y[i]), hi < 0.0 && p.moving[i]);
        }
    }
    p = kept;
}

}  // namespace grainfrac
