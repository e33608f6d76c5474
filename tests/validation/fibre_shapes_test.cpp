// SPDX-License-Identifier: GPL-3.0-or-later
// Pull-outs of hooked and wavy fibres and of several at once: whole paths against what holds whatever the shape.
#include "model/point_history.h"
#include "support/pull_out.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

constexpr double toughness = 1500.0;  // K_0 delta_0 delta_1/2 [J/m^2]

/// Bears on what lies beside it.
Case bent_case(const char* shape)
{
    Case c = pull_out_case(6.0);
    c.parts[0].region.diameter = 8.0;
    FibreSpec& f = c.parts[1].fibre;
    f.shape = shape;
    f.hook_length = 1.5;
    f.amplitude = 0.3;
    f.wavelength = 6.0;
    if (f.shape == "hooked") f.from.z = -0.5;
    c.bonds[2].normal_stiffness = 1e9;
    return c;
}

/// What the damage of the patches took by the bilinear law, G_c (lambda - lambda_0)/(lambda_f - lambda_0) of each; with
/// opening, which alone breaks nothing, lambda_0 is above that of shear [J].
double taken_by_damage(const PulledOut& run)
{
    const InterfaceBonds& f = run.built.state.interfaces;
    double taken = 0.0;
    for (const int i : fibre_interfaces(run.pull_out(), run.built.state)) {
        const InterfacePointState p = point_state(run.built.state, i, f.point_begin[i]);
        if (p.onset == 0.0) continue;
        CHECK(0.5 * p.onset * p.failure == Approx(toughness).epsilon(1e-12));
        const double lambda = p.failure * p.onset / (p.failure - f.damage[i] * (p.failure - p.onset));
        taken += f.area[i] * toughness * (lambda - p.onset) / (p.failure - p.onset);
    }
    return taken;
}

/// Goes on to a mean damage of 0.5 under damage control and checks what holds for each state of such a path.
template <class Look>
void follow_and_check(PulledOut& run, const Look& look)
{
    double slip = 0.0;  // mean along the fibre: grows, also where the grip goes back
    run.follow(by_damage(0.2), [&](const PullOutState& now) {
        const std::vector<double> along = fibre_profile(run.pull_out(), run.built.state).slip;
        const double mean = std::accumulate(along.begin(), along.end(), 0.0) / static_cast<double>(along.size());
        CHECK(mean > 1.05 * slip);
        slip = mean;
        look(now);
        return now.mean_damage > 0.5;
    });
    const double peak = run.largest(&PullOutState::end_stress);
    for (const PullOutState& s : run.path)
        CHECK(std::fabs(s.support_stress - s.end_stress) < 1e-5 * peak);  // the support bears the pull
}

}  // namespace

TEST_CASE("hooked and wavy fibres on their way out: equilibrium, and the energy that the damage takes", "[pull_out]")
{
    for (const char* shape : {"hooked", "wavy"}) {
        CAPTURE(shape);
        PulledOut run(bent_case(shape));
        CHECK(run.built.experiment.warnings.empty());
        follow_and_check(run, [](const PullOutState&) {});
        CHECK(run.found == PullOutPath::Found::equilibrium);
        const Ledger e = energy_ledger(run.built.model, run.built.state);
        CHECK(e.fracture == Approx(taken_by_damage(run)).epsilon(1e-9));
        CHECK(e.relative_error() < 5e-3);
        CHECK(phases_in_file(run) == std::vector<int>{0, 1});
    }
}

TEST_CASE("two fibres that mirror each other share the pull", "[pull_out]")
{
    Case c = pull_out_case(5.0);
    c.parts[0].region.diameter = 10.0;
    for (Vec3* end : {&c.parts[1].fibre.from, &c.parts[1].fibre.to}) end->x = -2.0;  // a channel of the lattice
    c.parts[1].copies = {{4.0, 0.0, 0.0}};
    PulledOut two(c);
    const PullOut& p = two.pull_out();
    REQUIRE(p.fibres == 2);
    const State& s = two.built.state;
    follow_and_check(two, [&](const PullOutState& now) {
        std::vector<double> pulls;
        for (int i = 0; i < s.bodies.size(); ++i) {
            if (s.bodies.wall[i] == p.grip_wall) pulls.push_back(-dot(s.bodies.force[i], p.direction));
        }
        REQUIRE(pulls.size() == 2);
        CHECK(pulls[0] == Approx(pulls[1]).epsilon(1e-5));
        CHECK((pulls[0] + pulls[1]) / p.section == Approx(now.support_stress).epsilon(1e-5));
    });
    CHECK(p.section == Approx(2.0 * std::numbers::pi));
    CHECK(energy_ledger(two.built.model, s).fracture == Approx(taken_by_damage(two)).epsilon(1e-9));
}

TEST_CASE("an interface that is soft against the solids bears 2 tau_0 L/a in each of several fibres", "[pull_out]")
{
    // K_0 = 1e7 Pa/m: the mean of the slip over the largest is 1 - (alpha L/a)^2/3 (1 - gamma + ...), 0.996 by
    // shear-lag
    double alone = 0.0;
    for (const bool several : {false, true}) {
        Case c = pull_out_case(5.0);
        c.parts[0].region.diameter = 10.0;
        c.bonds[2].shear_stiffness = 1e7;
        if (several) {
            for (Vec3* end : {&c.parts[1].fibre.from, &c.parts[1].fibre.to}) end->x = -2.0;
            c.parts[1].copies = {{4.0, 0.0, 0.0}, {2.0, std::sqrt(12.0), 0.0}};
        }
        PulledOut run(c);
        run.follow(by_damage(0.25), [](const PullOutState&) { return true; });
        const PullOut& p = run.pull_out();
        CHECK(p.fibres == (several ? 3 : 1));
        const double stress = run.path.back().end_stress;
        CHECK(stress == Approx(2.0 * 1e7 * 1e-3 * p.length).epsilon(5e-3));
        if (several) CHECK(stress == Approx(alone).epsilon(5e-3));  // the matrix is strained by three
        alone = stress;
    }
}
