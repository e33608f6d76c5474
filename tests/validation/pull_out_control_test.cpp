// SPDX-License-Identifier: GPL-3.0-or-later
// The three controls of a pull-out against each other, and bonds along the lines of centres against those in the frame
// of the fibre's surface.
#include "motion/time_step.h"
#include "support/pull_out.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

Case short_case()
{
    Case c = pull_out_case(5.0);
    c.parts[0].region.diameter = 6.0;
    return c;
}

/// End stress of a path at a displacement, on its way there.
double stress_at(const std::vector<PullOutState>& path, double displacement)
{
    for (std::size_t k = 1; k < path.size(); ++k) {
        const PullOutState &a = path[k - 1], &b = path[k];
        if (b.end_displacement < displacement) continue;
        return a.end_stress + (displacement - a.end_displacement) / (b.end_displacement - a.end_displacement) *
                                  (b.end_stress - a.end_stress);
    }
    return 0.0;
}

}  // namespace

TEST_CASE("displacement control tends to the path of damage control where that does not turn back", "[pull_out]")
{
    // of first order in the step: a patch softens by what it would slip if all grew in proportion
    const auto grown = [](const PullOutState& now) { return now.end_displacement > 2.3e-3; };
    PulledOut damage(short_case());
    damage.follow(by_damage(0.02), grown);
    double peak[2], late[2];
    for (const int fine : {0, 1}) {
        Case c = short_case();
        c.test.control = "displacement";
        PulledOut displaced(c);
        displaced.follow(by_displacement(fine == 1 ? 5e-5 : 1e-4), grown);
        peak[fine] = displaced.largest(&PullOutState::end_stress);
        late[fine] = stress_at(displaced.path, 2.2e-3);
        CHECK(energy_ledger(displaced.built.model, displaced.built.state).relative_error() < 1e-3);
    }
    const double exact_peak = damage.largest(&PullOutState::end_stress), exact = stress_at(damage.path, 2.2e-3);
    CHECK((late[0] - exact) / (late[1] - exact) == Approx(2.0).margin(0.3));
    CHECK(2.0 * late[1] - late[0] == Approx(exact).epsilon(5e-3));
    CHECK(2.0 * peak[1] - peak[0] == Approx(exact_peak).epsilon(5e-3));
}

TEST_CASE("a slow grip gives the equilibria", "[pull_out][slow]")
{
    // the whole stays at rest but for the grip's wave: inertia stress E_f v/c
    Case c = short_case();
    PulledOut rest(c);
    rest.follow(by_damage(0.02), [](const PullOutState& now) { return now.end_displacement > 2.3e-3; });
    double off[2];
    for (const int slow : {0, 1}) {
        c.test.control = "speed";
        c.test.platen_speed = slow == 1 ? 0.02 : 0.2;
        PulledOut run(c);
        begin_stage(run.built.experiment.stages.front(), run.built.model, run.built.state);
        const double dt = 0.8 * time_step_bound(run.built.model, run.built.state).with_damping;
        double most = 0.0, imbalance = 0.0;
        const double peak = rest.largest(&PullOutState::end_stress);
        for (int k = 1; run.now().end_displacement < 2.2e-3; ++k) {
            step(run.built.model, run.built.state, dt);
            if (k % 20 != 0) continue;
            const PullOutState now = run.now();
            most = std::max(most, std::fabs(now.end_stress - stress_at(rest.path, now.end_displacement)) / peak);
            imbalance = std::max(imbalance, std::fabs(now.end_stress - now.support_stress) / peak);
        }
        INFO("speed " << c.test.platen_speed << ": off by " << most << ", imbalance " << imbalance);
        CHECK(energy_ledger(run.built.model, run.built.state).relative_error() < 1e-3);
        off[slow] = most;
        if (slow == 1) CHECK(most < 0.02);
    }
    CHECK(off[1] < 0.3 * off[0]);
}

TEST_CASE("patches along the lines of centres resist the slip by 1 - n_z^2 of their area", "[pull_out]")
{
    // docs/theory/pull_out.md 1: what is along the line of two centres bears no shear; 1 - n_z^2 = 1/3 of rising bonds
    double stiffness[2];
    double level = 0.0, expected = 0.0;
    for (const int branch : {0, 1}) {
        Case c = short_case();
        PartSpec& fibre = c.parts[1];
        fibre.generator = "taken";
        fibre.region.shape = "cylinder";
        fibre.region.diameter = 2.0;
        fibre.region.height = 40.0;
        c.bonds[2].reach = "all";
        c.bonds[2].frame = branch == 1 ? "branch" : "surface";
        c.bonds[2].shear_stiffness = 1e6;  // soft: fibre and matrix move as two pieces but for (alpha L/a)^2/3 = 5e-4
        PulledOut run(c);
        const State& s = run.built.state;
        double area = 0.0, resisting = 0.0;
        for (const int i : fibre_interfaces(run.pull_out(), s)) {
            const Vec3 d =
                normalized(s.bodies.start_position[s.interfaces.b[i]] - s.bodies.start_position[s.interfaces.a[i]]);
            area += s.interfaces.area[i];
            resisting += s.interfaces.area[i] * (1.0 - d.z * d.z);
        }
        expected = resisting / area;
        PathSettings settings = by_displacement(1e-4);
        run.follow(settings, [](const PullOutState&) { return true; });
        stiffness[branch] = run.path.back().end_stress / run.path.back().exit_slip;
        level = 2.0 * 1e6 * run.pull_out().length;
        if (branch == 0) CHECK(stiffness[0] == Approx(level).epsilon(2e-3));
    }
    CHECK(expected < 0.9);
    CHECK(stiffness[1] / stiffness[0] == Approx(expected).epsilon(2e-3));
}
