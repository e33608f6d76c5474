// SPDX-License-Identifier: GPL-3.0-or-later
// Ways to ruin a run, each found within a bounded number of steps and named; and runs that are none.
#include "experiment/stability.h"

#include "support/disc.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

constexpr int between_looks = 200;

/// Steps of dt until a look finds something, at most `steps`.
Instability look_while_running(Built& b, double dt, int steps, bool fixed_step = false)
{
    StabilityLimits limits;
    limits.time_step = dt;
    limits.fixed_step = fixed_step;
    limits.speed = 10.0 * b.experiment.wave_speed;
    for (int k = 0; k < steps; k += between_looks) {
        run_steps(b, dt, between_looks);
        const Ledger energy = energy_ledger(b.model, b.state);
        const TimeStepBound bound = time_step_bound(b.model, b.state);
        limits.bound = &bound;
        const Instability found = find_instability(b.model, b.state, energy, limits);
        if (found) return found;
        limits.error_before = account_is_off(energy) ? std::fabs(energy.residual()) : 0.0;
    }
    return {};
}

Case small_disc()
{
    Case c = disc_case(1.1e-3, true);
    c.bonds[0].fracture_energy_II = 300.0;
    return c;
}

/// Loaded a little, stable so far.
Built loaded_disc()
{
    Built b = build(small_disc(), default_device());
    begin(b);
    run_steps(b, stable_step(b), 400);
    return b;
}

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != text.npos;
}

}  // namespace

TEST_CASE("a run that goes wrong is found out and told why", "[stability]")
{
    Built b = loaded_disc();
    const double dt = stable_step(b);
    SECTION("a time step of the user's above the limit")
    {
        for (const double factor : {1.3, 3.0}) {  // of 0.8 of the limit
            const Instability found = look_while_running(b, factor * dt, between_looks, true);
            INFO(found.reason);
            CHECK(has(found.reason, "leave it out or shorten it"));
            CHECK(found.bodies.size() == 1);
        }
    }
    SECTION("stiffness of the bonds x 1000 without a new step")
    {
        for (Buffer<double>* k : {&b.state.interfaces.normal_stiffness, &b.state.interfaces.shear_stiffness})
            for (double& x : k->host()) x *= 1e3;
        const Instability found = look_while_running(b, dt, 2000);
        INFO(found.reason);
        CHECK(found);
        CHECK((has(found.reason, "stability limit") || has(found.reason, "penetrate") ||
               has(found.reason, "time_step_safety")));
    }
    SECTION("stiffness of contacts x 1000 without a new step")
    {
        for (LinearContact& law : b.model.contact_laws.host()) law.area_stiffness *= 1e3;
        CHECK(look_while_running(b, dt, 4000));
    }
    SECTION("masses / 1000 without a new step")
    {
        for (double& m : b.state.bodies.mass.host()) m *= 1e-3;
        for (double& m : b.state.bodies.inverse_mass.host()) m *= 1e3;
        CHECK(look_while_running(b, dt, 2000));
    }
    SECTION("dashpots beyond the step")
    {
        for (Buffer<double>* c : {&b.state.interfaces.normal_damping, &b.state.interfaces.shear_damping})
            for (double& x : c->host()) x *= 100.0;
        const Instability found = look_while_running(b, dt, 2000);
        INFO(found.reason);
        CHECK(found);
    }
    SECTION("a grain that was shot")
    {
        const int grain = b.state.bodies.size() / 2;
        b.state.bodies.velocity.at(grain) = {0.0, 0.0, 20.0 * b.experiment.wave_speed};
        const Instability found = look_while_running(b, dt, 400);
        INFO(found.reason);
        CHECK(found);
        CHECK(std::find(found.bodies.begin(), found.bodies.end(), grain) != found.bodies.end());
    }
    SECTION("a grain in another")
    {
        b.state.bodies.position.at(1) = b.state.bodies.position[0];
        const Instability found = look_while_running(b, dt, 400);
        INFO(found.reason);
        CHECK(found);
    }
    SECTION("a place that is no number")
    {
        const int grain = b.state.bodies.size() / 2;
        b.state.bodies.position.at(grain).x = std::numeric_limits<double>::quiet_NaN();
        const Instability found = look_while_running(b, dt, 400);
        INFO(found.reason);
        REQUIRE(found);
        CHECK(has(found.reason, "finite"));
    }
    SECTION("energy from nowhere")
    {
        for (Vec3& v : b.state.bodies.velocity.host()) v *= 1e4;
        CHECK(look_while_running(b, dt, 1000));
    }
}

TEST_CASE("a run that only breaks is none of these", "[stability]")
{
    Case c = small_disc();
    c.test.platen_speed = 2.0;  // violent
    Built b = build(c, default_device());
    begin(b);
    const Instability found = look_while_running(b, stable_step(b), 12000);
    INFO(found.reason);
    CHECK_FALSE(found);
    CHECK(energy_ledger(b.model, b.state).fracture > 0.0);
}
