// SPDX-License-Identifier: GPL-3.0-or-later
// Fibre pull-out against axisymmetric elasticity and the closed forms of the shear-lag path
// (docs/theory/pull_out.md, section 5): the case of Dressler 2020, table 4-3, nothing tuned.
#include "support/pull_out.h"

#include "support/known_curve.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

/// Columns of a file of numbers with one line of names.
std::vector<std::vector<double>> columns_of(const std::string& file)
{
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    std::vector<std::vector<double>> columns;
    while (std::getline(in, line)) {
        std::stringstream cells(line);
        std::size_t k = 0;
        for (std::string cell; std::getline(cells, cell, ','); ++k) {
            if (columns.size() <= k) columns.emplace_back();
            columns[k].push_back(std::stod(cell));
        }
    }
    return columns;
}

/// Root mean squares over the levels: of the shear's error and of its spread within a level over the range of the
/// reference, of the fibre stress' error over the largest one. Linear: at equal load.
struct Misfit {
    double shear = 0.0, spread = 0.0, stress = 0.0;
};

Misfit misfit(const PulledOut& run, const std::string& file)
{
    const auto exact = columns_of(std::string(GF_SOURCE_DIR) + "/tests/data/fibre/" + file);
    REQUIRE(exact.size() == 3);
    const std::vector<double>&z = exact[0], &tau = exact[1], &sigma = exact[2];
    const double length = run.pull_out().length;
    REQUIRE(length == Approx(z.back()).epsilon(0.01));
    const double scale = run.path.back().end_stress / sigma.back();
    const FibreProfile p = fibre_profile(run.pull_out(), run.built.state);
    const auto [low, high] = std::minmax_element(tau.begin(), tau.end());
    const double range = scale * (*high - *low);
    Misfit m;
    for (std::size_t k = 0; k < p.position.size(); ++k) {
        const double at = p.position[k] * z.back() / length;
        m.shear += std::pow((p.shear[k] - scale * interpolated(z, tau, at)) / range, 2);
        m.spread += std::pow(p.spread[k] / range, 2);
        m.stress += std::pow(p.stress[k] / (scale * sigma.back()) - interpolated(z, sigma, at) / sigma.back(), 2);
    }
    const auto n = static_cast<double>(p.position.size());
    return {std::sqrt(m.shear / n), std::sqrt(m.spread / n), std::sqrt(m.stress / n)};
}

/// What is left at last fails as one: slip over stress is a straight line to (failure slip, 0), its slope that of the
/// free fibre, (L - l*)/E_f. By shear-lag l* = 9.706 m; by elasticity 8.914 m, at 29.80 as at 30.21 m (the paths of
/// tests/data/fibre, least squares as here).
constexpr double last_zone = 8.914;  // [m]
struct LastStage {
    double free_length = 0.0;  ///< [m]
    double slip = 0.0;         ///< where the line meets no stress [m]
};
LastStage last_stage(const PulledOut& run)
{
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (const PullOutState& s : run.path) {
        if (s.mean_damage < 0.8 || s.end_stress > 10e6 || s.end_stress < 1e6) continue;
        const double strain = s.end_stress / 50e9;
        n += 1.0;
        x += strain;
        y += s.exit_slip;
        xx += strain * strain;
        xy += strain * s.exit_slip;
    }
    REQUIRE(n > 3.0);
    const double slope = (n * xy - x * y) / (n * xx - x * x);
    return {slope, (y - slope * x) / n};
}

}  // namespace

TEST_CASE("pull-out: shear and fibre stress before yield are those of axisymmetric elasticity", "[pull_out][slow]")
{
    PulledOut run(pull_out_case(30.0));
    run.follow(by_damage(0.01), [](const PullOutState&) { return true; });
    const FibreProfile p = fibre_profile(run.pull_out(), run.built.state);
    const Misfit m = misfit(run, "elastic_30.21m.csv");
    CHECK(m.shear < 0.015);
    CHECK(m.stress < 0.01);
    CHECK(m.spread < 1e-4);  // all spheres of a ring are alike
    // the pull is what the support bears, and what the shear adds up to
    CHECK(p.stress.back() + 0.5 * p.shear.back() * 2.0 * run.pull_out().piece ==
          Approx(run.path.back().end_stress).epsilon(1e-4));
}

TEST_CASE("pull-out: with each body of the far face held the embedded end bears more", "[pull_out][slow]")
{
    Case c = pull_out_case(30.0);
    c.test.support = "held";
    PulledOut run(c);
    run.follow(by_damage(0.01), [](const PullOutState&) { return true; });
    const Misfit m = misfit(run, "elastic_held.csv");
    CHECK(m.shear < 0.02);
    CHECK(m.stress < 0.01);
}

TEST_CASE("pull-out: a fibre of spheres of the lattice bears the same shear", "[pull_out][slow]")
{
    Case c = pull_out_case(30.0);
    c.parts[1].generator = "taken";
    c.parts[1].region.shape = "cylinder";
    c.parts[1].region.diameter = 2.0;
    c.parts[1].region.height = 40.0;
    PulledOut run(c);
    run.follow(by_damage(0.01), [](const PullOutState&) { return true; });
    const Misfit m = misfit(run, "elastic_30.21m.csv");  // tolerances: those of spheres of half the size
    CHECK(std::hypot(m.shear, m.spread) < 0.085);
    CHECK(m.shear < 0.04);
    CHECK(m.stress < 0.03);
}

TEST_CASE("pull-out: the path turns back and ends at the failure slip without stress", "[pull_out][slow]")
{
    PulledOut run(pull_out_case(15.0));
    run.follow(by_damage(0.02), [](const PullOutState&) { return false; });
    // axisymmetric elasticity at the same length (tests/data/fibre/elastic_lengths.csv)
    const double length = run.pull_out().length;
    REQUIRE(length == Approx(14.6969).epsilon(1e-5));
    CHECK(1e-6 * run.largest(&PullOutState::end_stress) == Approx(18.7927).epsilon(0.01));
    CHECK(1e3 * run.largest(&PullOutState::exit_slip) == Approx(4.33237).epsilon(0.015));
    CHECK(1e3 * run.largest(&PullOutState::end_displacement) == Approx(4.61249).epsilon(0.015));
    // whatever the elasticity the closed path takes what breaks the interface, 2 G_c L/a: of second order in
    // damage_step
    double work = 0.0;
    for (std::size_t k = 1; k < run.path.size(); ++k) {
        work += 0.5 * (run.path[k].end_stress + run.path[k - 1].end_stress) *
                (run.path[k].end_displacement - run.path[k - 1].end_displacement);
    }
    CHECK(work == Approx(2.0 * 1500.0 * length).epsilon(2e-3));
    const PullOutState& last = run.path.back();
    CHECK(last.end_stress < 0.02 * run.largest(&PullOutState::end_stress));
    CHECK(last.exit_slip == Approx(3e-3).epsilon(0.05));
    const LastStage tail = last_stage(run);
    // the zone, not the free length, which is a small difference here: spheres of 1 m make the zone 0.25 m longer, and
    // that is 4.3 % of 5.78 m
    CHECK(length - tail.free_length == Approx(last_zone).epsilon(0.03));
    CHECK(tail.slip == Approx(3e-3).epsilon(0.01));
    // all that was to break did
    const Ledger e = energy_ledger(run.built.model, run.built.state);
    double area = 0.0;
    for (const int i : fibre_interfaces(run.pull_out(), run.built.state)) area += run.built.state.interfaces.area[i];
    CHECK(area == Approx(2.0 * std::numbers::pi * run.pull_out().length).epsilon(1e-9));
    CHECK(e.fracture == Approx(1500.0 * area).epsilon(5e-3));
    CHECK(e.relative_error() < 1e-3);
}

TEST_CASE("pull-out: the last stage of 30 m is the straight line of elasticity", "[pull_out][slow]")
{
    PulledOut run(pull_out_case(30.0));
    run.follow(by_damage(0.1), [](const PullOutState& now) { return now.mean_damage > 0.75; });
    run.follow(by_damage(0.025), [](const PullOutState& now) { return now.mean_damage > 0.95; });
    const LastStage tail = last_stage(run);
    CHECK(tail.free_length == Approx(run.pull_out().length - last_zone).epsilon(0.03));
    CHECK(tail.slip == Approx(3e-3).epsilon(0.02));
}

TEST_CASE("pull-out: a broken interface slides under its residual shear and under pressure", "[pull_out]")
{
    Case c = pull_out_case(5.0);
    c.parts[0].region.diameter = 6.0;
    c.bonds[2].residual_shear = 0.1e6;
    c.bonds[2].friction = 0.2;
    c.bonds[2].residual_friction = 0.2;
    c.bonds[2].radial_pressure = 0.5e6;  // the same once more
    c.bonds[2].contraction = 0.0;
    PulledOut run(c);
    PathSettings s = by_damage(0.2);
    s.shift = 1e-3;
    s.slides = true;
    s.slide = 0.4;
    const PullOut& p = run.pull_out();
    FibreProfile first_profile;
    run.follow(s, [&](const PullOutState& now) {
        if (first_profile.slip.empty()) first_profile = fibre_profile(p, run.built.state);
        return now.exit_slip > 2.0;
    });
    // 2 tau_r (L - s)/a, with the first patches as with the last
    for (const PullOutState& now : run.path) {
        if (now.exit_slip < 0.2) continue;
        CHECK(now.end_stress == Approx(2.0 * 0.2e6 * (p.length - now.embedded_slip)).epsilon(0.005));
    }
    CHECK(run.path.back().exit_slip > 2.0);
    CHECK(phases_in_file(run) == std::vector<int>{0, 1, 2});
    // first state: from the last level to the exit the fibre is stretched by the whole pull
    CHECK(run.path[1].exit_slip - first_profile.slip.back() ==
          Approx(0.5 * p.piece * run.path[1].end_stress / p.young_modulus).epsilon(1e-6));
}

TEST_CASE("pull-out: the pressure falls where the fibre is pulled thinner", "[pull_out][slow]")
{
    Case c = pull_out_case(30.0);
    c.materials[1].poisson_ratio = 0.3;  // the bonds of the matrix have a shear ratio of their own
    c.parts[0].region.diameter = 4.0;
    c.bonds[2].residual_friction = 0.1;
    c.bonds[2].radial_pressure = 1e6;
    double contraction = 0.0144928, tolerance = 0.001;  // k_p of the two materials, docs/theory/pull_out.md 1
    SECTION("of the two materials") {}
    SECTION("strong")
    {
        c.bonds[2].contraction = contraction = 0.2;
        tolerance = 0.005;  // pieces of 0.8 m against a length of decay of 25 m
    }
    PulledOut run(c);
    PathSettings s = by_damage(0.5);
    s.slides = true;
    s.slide = 0.1;
    run.follow(s, [](const PullOutState& now) { return now.exit_slip > 0.05; });  // all of it slides
    const PullOut& p = run.pull_out();
    CHECK(run.found == PullOutPath::Found::equilibrium);
    const double left = p.length - run.path.back().embedded_slip;
    const double expected = 1e6 / contraction * (1.0 - std::exp(-2.0 * 0.1 * contraction * left));
    CHECK(run.path.back().mean_damage == Approx(1.0));
    CHECK(run.path.back().end_stress == Approx(expected).epsilon(tolerance));
    CHECK(energy_ledger(run.built.model, run.built.state).relative_error() < 5e-3);
}
