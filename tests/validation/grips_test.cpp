// SPDX-License-Identifier: GPL-3.0-or-later
// Grips: what they hold, what they leave free, and the account when they let go.
#include "experiment/grips.h"

#include "experiment/experiment.h"
#include "support/spheres.h"

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

/// Six bonded spheres along x in part "part".
Assembly chain()
{
    Assembly a = sphere_assembly(unbreakable_bond(false), 2.0);
    add_row(a, 6, 1.0, 0.5, {2.0, 0.8, 0.1, 0.1}, [](int) { return 0; });
    a.model.contact_law_of.assign(16, 0);
    return a;
}

GripSpec grip(const std::string& at, std::vector<std::string> hold)
{
    GripSpec g;
    g.name = "grip_" + at;
    g.part = "part";
    g.at = at;
    g.hold = std::move(hold);
    return g;
}

}  // namespace

TEST_CASE("a grip holds the axes that it names and leaves the others to the forces")
{
    Assembly a = chain();
    add_grip(a.model, a.state, grip("first", {"x", "y", "z"}), "grips[0]");
    add_grip(a.model, a.state, grip("last", {"z", "rotation"}), "grips[1]");
    Bodies& b = a.state.bodies;
    CHECK(b.wall[0] == 0);
    CHECK(b.wall[5] == 1);
    CHECK(a.model.walls == std::vector<std::string>{"grip_first", "grip_last"});
    a.model.wall_motion.host()[1] = {{}, {0.0, 0.0, 0.1}, 0.0, 0.0, {}, 0.0, 0.0, 0.0};
    a.model.gravity = {0.1, -0.2, 0.05};
    start(a.model, a.state);
    for (int i = 0; i < 400; ++i) step(a.model, a.state, 0.02);
    CHECK(norm(b.position[0]) == 0.0);          // a pin stays
    CHECK(norm(b.angular_velocity[0]) > 1e-3);  // and turns
    CHECK(b.position[5].z == Approx(0.1 * a.state.time).epsilon(1e-12));
    CHECK(std::fabs(b.position[5].y) > 1e-2);  // free across
    CHECK(norm(b.angular_velocity[5]) == 0.0);
    const Ledger e = energy_ledger(a.model, a.state);
    CHECK(e.relative_error() < 1e-3);
    CHECK(std::fabs(e.external) > 0.01 * e.kinetic);
}

TEST_CASE("a grip that lets go hands its motion over, and the account closes")
{
    for (const auto& hold : {std::vector<std::string>{"x", "y", "z", "rotation"}, std::vector<std::string>{"x", "y"}}) {
        Assembly a = chain();
        GripSpec g = grip("first", hold);
        g.velocity = {-0.1, 0.05, 0.0};
        add_grip(a.model, a.state, g, "grips[0]");
        a.model.wall_motion.host()[0] = {{}, g.velocity, 0.0, 0.0, {}, 0.0, 0.0, 0.0};
        start(a.model, a.state);
        for (int i = 0; i < 100; ++i) step(a.model, a.state, 0.02);
        Stage free;
        free.released = {0};
        const Vec3 v = a.state.bodies.velocity[0];
        begin_stage(free, a.model, a.state);
        CHECK(v == a.state.bodies.velocity[0]);
        const Momentum before = total_momentum(a.model, a.state);
        for (int i = 0; i < 500; ++i) step(a.model, a.state, 0.02);
        const Momentum after = total_momentum(a.model, a.state);
        CHECK(norm(after.linear - before.linear) < 1e-13 * norm(before.linear));
        CHECK(norm(after.angular - before.angular) < 1e-12 * norm(before.angular));
        CHECK(energy_ledger(a.model, a.state).relative_error() < 1e-3);
    }
}

TEST_CASE("a grip takes the bodies whose centre is in its region, once")
{
    Assembly a = chain();
    GripSpec g = grip("", {"x", "y", "z", "rotation"});
    g.region.shape = "box";
    g.region.center = {4.5, 0, 0};
    g.region.size = {1.0, 0.1, 0.1};
    add_grip(a.model, a.state, g, "grips[0]");
    for (int i = 0; i < 6; ++i) CHECK(a.state.bodies.wall[i] == (i >= 4 ? 0 : -1));
    CHECK_THROWS_WITH(add_grip(a.model, a.state, grip("last", {"x"}), "grips[1]"),
                      "body 5 of \"part\" is held by grip \"grip_\" already");
    g.region.center = {9, 0, 0};
    CHECK_THROWS_WITH(add_grip(a.model, a.state, g, "grips[1]"), "no body of part \"part\" has its centre inside");
}
