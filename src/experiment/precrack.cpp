// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/precrack.h"

#include "experiment/specimen.h"

#include <algorithm>

namespace grainfrac {

namespace {

/// Of the specimen's size: far above round-off, far below a grain.
constexpr double site_tolerance = 1e-9;

Extent extent_of(const std::vector<GrainSpec>& grains)
{
    Extent e;
    for (const GrainSpec& g : grains) {
        for (const Vec3& x : g.shape.vertices) {
            for (int k = 0; k < 3; ++k) {
                e.low[k] = std::min(e.low[k], x[k]);
                e.high[k] = std::max(e.high[k], x[k]);
            }
        }
    }
    return e;
}

}  // namespace

bool Precrack::cuts(const Vec3& site_a, const Vec3& site_b) const
{
    const bool a_above = site_a[normal] > place + tolerance, b_above = site_b[normal] > place + tolerance;
    return a_above != b_above && 0.5 * (site_a[along] + site_b[along]) < limit;
}

std::vector<Precrack> precracks(const Case& c, const std::vector<GrainSpec>& grains)
{
    const TestSpec& test = c.test;
    if (test.kind != "notched_beam" && test.kind != "dcb") return {};
    const Extent x = extent_of(grains);
    const int up = axis_of(test.direction), length = up == 0 ? 1 : 0;
    Precrack p;
    if (test.kind == "notched_beam") {  // at mid span, from the side of the supports
        p.normal = length;
        p.along = up;
        p.limit = x.low[up] + test.notch_depth;
    } else {  // along the mid plane, from the end that is pulled open
        p.normal = up;
        p.along = length;
        p.limit = x.low[length] + test.crack_length;
    }
    p.place = x.center()[p.normal];
    p.tolerance = site_tolerance * x.size()[p.normal];
    return {p};
}

}  // namespace grainfrac
