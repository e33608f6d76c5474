// SPDX-License-Identifier: GPL-3.0-or-later
// Whether grains reach into a fibre.
#include "generate/fibre_in_grains.h"

#include "support/spheres.h"
#include "unit/geometry/shapes.h"

using namespace grainfrac;
using namespace grainfrac::test;

TEST_CASE("a grain that pokes in between two nodes of a fibre reaches into it", "[fibre]")
{
    // the nodes' balls are five times smaller than their distance and see nothing of a cube of 0.5 half-way
    const auto reaches = [](const Vec3& centre, const Quat& turn) {
        const Polyhedron cube = translated(rotated(make_box({0.5, 0.5, 0.5}), turn), centre);
        Assembly a = assemble({grain(cube, centre)});
        FibreChain chain;
        for (const double x : {-1.0, 1.0, 3.0}) {
            chain.nodes.push_back(sphere(a, {x, 0, 0}, 0.2));
            chain.way.push_back(x + 2.0);
        }
        chain.whole = 6.0;
        chain.radius = 0.2;
        return grains_reach_in(a.model, a.state, chain, {0});
    };
    const Quat straight, on_edge = from_axis_angle({0, 0, 1}, 0.25 * std::numbers::pi);
    const double half = 0.25, diagonal = 0.25 * std::numbers::sqrt2;
    for (const double x : {-1.0, -0.3, 0.0, 2.0, 3.0}) {
        CHECK(reaches({x, 0.2 + half - 0.01, 0}, straight));
        CHECK_FALSE(reaches({x, 0.2 + half, 0}, straight));  // touches
        CHECK_FALSE(reaches({x, 0.2 + half + 0.01, 0}, straight));
    }
    CHECK(reaches({0, 0.2 + half - 0.01, 0.1}, straight));
    CHECK(reaches({0, 0.2 + diagonal - 0.03, 0}, on_edge));  // the edge is rounded
    CHECK_FALSE(reaches({0, 0.2 + diagonal + 0.01, 0}, on_edge));
    CHECK_FALSE(reaches({3.5, 0, 0}, straight));  // beyond the last node
}
