// SPDX-License-Identifier: GPL-3.0-or-later
// Grains that fall: momentum and the floor's impulse, restitution, rest, splits on the way.
#include "experiment/cleavage_rules.h"
#include "fracture/grain_stress.h"
#include "support/disc.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

constexpr double g = 9.81, r = 0.6e-3, t = 1.3e-3;

/// Loose whole hexagons over a floor: columns along x, rows along y, layers along z.
Case loose(int columns, int rows, int layers)
{
    Case c;
    c.simulation.seed = 1;
    c.materials = {{"sic", 3100, 410e9, 0.17, {}}};
    PartSpec p;
    p.name = "grains";
    p.material = "sic";
    p.side = r;
    p.thickness = t;
    p.dilation_radius = 0.1e-3;
    p.region.size = {std::sqrt(3.0) * r * columns * 1.0001, 1.5 * r * rows + 0.4 * r, layers * t};
    p.orientation.choices = {0.0};
    c.parts = {p};
    ContactSpec contact;
    contact.normal_stiffness = 2e9;
    contact.dissipation = "hysteretic";
    contact.restitution = 0.5;
    c.contacts = {contact};
    c.test.kind = "drop";
    c.test.drop_height = 1e-3;
    c.test.stop.time = 1.0;
    return c;
}

/// Steps, and what the floor gave meanwhile: trapezoids of the force of before and after each step, as the scheme takes
/// it.
struct Fall {
    Built& b;
    double dt, load = 0.0, impulse = 0.0, largest = 0.0;

    explicit Fall(Built& built, double safety) : b(built)
    {
        begin(b);
        dt = stable_step(b, safety);
        load = measure(b.experiment, b.model, b.state).load;
    }
    void one(bool dyads = false)
    {
        step(b.model, b.state, dt, dyads);
        const double now = measure(b.experiment, b.model, b.state).load;
        impulse += 0.5 * dt * (load + now);
        load = now;
        largest = std::max(largest, now);
    }
    double up(int axis = 2) const { return total_momentum(b.model, b.state).linear[axis]; }
};

double deepest_overlap(const State& s)
{
    double deepest = 0.0;
    for (int k = 0; k < s.contacts.size(); ++k) deepest = std::max(deepest, s.contacts.point[k].depth);
    return deepest;
}

}  // namespace

TEST_CASE("drop: the floor's impulse is the change of momentum plus weight times time, impact by impact")
{
    Built b = build(loose(2, 2, 2), default_device());
    Fall f(b, 0.4);
    const double h = 1e-3, fall = std::sqrt(2 * h / g), mass = total_momentum(b.model, b.state).mass;
    while (f.load == 0.0) f.one();
    CHECK(b.state.time >= fall * (1 - 1e-12));  // faces lie flat: no gap beyond drop_height
    CHECK(b.state.time <= fall + f.dt * (1 + 1e-9));
    CHECK(f.up() == Approx(-mass * g * b.state.time).epsilon(1e-4));
    for (int impact = 0; impact < 3; ++impact) {
        const double before = f.up(), start = b.state.time, given = f.impulse;
        while (f.load > 0.0) f.one();
        const double flown = b.state.time - start;
        CHECK(std::fabs((f.impulse - given) - (f.up() - before) - mass * g * flown) < 1e-12 * mass * g * fall);
        while (f.load == 0.0) f.one();
    }
    CHECK(energy_ledger(b.model, b.state).relative_error() < 1e-3);
}

// 13 grains in two layers, faces in touch to the last bit.
TEST_CASE("drop: grains that touch by round-off do not push each other while they fall")
{
    Case c = loose(2, 2, 2);
    c.parts[0].region.size = {2.2e-3, 2.2e-3, 2.6e-3};
    c.contacts[0].friction = 0.3;
    c.test.drop_height = 0.2e-3;
    c.test.side_gap = 1e-3;
    Built b = build(c, default_device());
    begin(b);
    const double dt = stable_step(b), fall = std::sqrt(2 * c.test.drop_height / g);
    while (b.state.time < fall - 2 * dt) step(b.model, b.state, dt);
    const Ledger e = energy_ledger(b.model, b.state);
    CHECK(e.kinetic == Approx(e.gravity).epsilon(1e-9));
    CHECK(e.kinetic ==
          Approx(0.5 * total_momentum(b.model, b.state).mass * g * g * b.state.time * b.state.time).epsilon(1e-9));
}

TEST_CASE("drop: a layer that falls flat rebounds with e, and its impulse is m v (1 + e)")
{
    Case c = loose(2, 2, 1);
    c.contacts[0].normal_stiffness = 2e11;  // weight over impact force: 1e-4
    Built b = build(c, default_device());
    Fall f(b, 0.5);
    const double mass = total_momentum(b.model, b.state).mass;
    while (f.load == 0.0) f.one();
    const double v = -f.up() / mass;
    CHECK(v == Approx(std::sqrt(2 * g * 1e-3)).epsilon(1e-3));
    f.dt = stable_step(b, 0.02);
    while (f.load > 0.0) f.one();
    CHECK(f.up() / mass == Approx(0.5 * v).epsilon(1e-3));
    CHECK(f.impulse == Approx(1.5 * mass * v).epsilon(2e-3));
}

TEST_CASE("drop: a column comes to rest, the floor bears its weight, nothing stays in another")
{
    Case c = loose(1, 1, 3);
    c.contacts[0].dissipation = "viscous";  // hysteresis leaves the smallest vibrations alone
    c.contacts[0].restitution = 0.2;
    Built b = build(c, default_device());
    Fall f(b, 0.5);
    const double weight = total_momentum(b.model, b.state).mass * g, fallen = weight * 1e-3;
    while (b.state.time < 0.06) f.one();
    const double start = b.state.time, given = f.impulse;
    while (b.state.time < 0.08) f.one();
    const Ledger e = energy_ledger(b.model, b.state);
    WARN("at rest: kinetic energy " << e.kinetic / fallen << " of m g h, mean load "
                                    << (f.impulse - given) / (b.state.time - start) / weight << " of the weight");
    // what is left rocks on a face: the dashpot acts at the centre of pressure, which does not move then
    CHECK(e.kinetic < 1e-4 * fallen);
    CHECK((f.impulse - given) / (b.state.time - start) == Approx(weight).epsilon(1e-3));
    CHECK(deepest_overlap(b.state) > 0.0);
    CHECK(deepest_overlap(b.state) < 0.5 * 0.1e-3);
    CHECK(e.relative_error() < 1e-3);
}

// Soft and brittle, so that a fall of a few millimetres breaks grains at steps that a test can afford.
TEST_CASE("drop: grains that break keep mass and momentum at every split, and come to rest")
{
    Case c = loose(2, 4, 1);
    c.materials[0].young_modulus = 8e6;
    c.materials[0].cleavage.planes = {"{10-10}", "{11-20}"};
    c.materials[0].cleavage.toughness = {100.0};
    c.materials[0].cleavage.flaw_size = 0.1e-3;
    c.parts[0].dilation_radius = 0.05e-3;
    c.parts[0].orientation.choices = {0.1, 0.3, 0.5};
    ContactSpec sides = c.contacts[0];
    sides.between = {"sides", "grains"};
    sides.friction = 0.0;  // else they bear a part of the weight
    c.contacts.push_back(sides);
    c.control.gravity = {0, -g, 0};
    c.test.drop_height = 2e-3;
    c.test.side_gap = 0.1e-3;
    Built b = build(c, default_device());
    Fall f(b, 0.8);
    const Momentum start = total_momentum(b.model, b.state);
    const double weight = start.mass * g, speed = std::sqrt(2 * g * c.test.drop_height), size = 1e-3;
    int splits = 0;
    const auto rests = [&] {
        return splits > 0 && energy_ledger(b.model, b.state).kinetic < 1e-3 * weight * c.test.drop_height &&
               std::fabs(f.load - weight) < 0.05 * weight;
    };
    for (int i = 1; b.state.time < 0.06; ++i) {
        const bool look = i % 20 == 0;
        f.one(look);
        if (!look) continue;
        if (rests()) break;
        const auto due = splits_due(
            b.state, find_cleavage(b.model, b.state, grain_stress(b.model, b.state), b.cleavage), b.cleavage);
        if (due.empty()) continue;
        const Momentum before = total_momentum(b.model, b.state);
        const double kinetic = energy_ledger(b.model, b.state).kinetic;
        for (const SplitReport& s : split_grains(b.model, b.state, due))
            splits += s.status == SplitStatus::done ? 1 : 0;
        const Momentum after = total_momentum(b.model, b.state);
        CHECK(std::fabs(after.mass - before.mass) <= 1e-13 * before.mass);
        CHECK(norm(after.linear - before.linear) <= 1e-12 * before.mass * speed);
        CHECK(norm(after.angular - before.angular) <= 1e-12 * before.mass * speed * size);
        CHECK(energy_ledger(b.model, b.state).kinetic == Approx(kinetic).epsilon(1e-12));
        REQUIRE(why_not_valid(b.model, b.state).empty());
        f.load = measure(b.experiment, b.model, b.state).load;
        f.dt = std::min(f.dt, stable_step(b, 0.8));
    }
    const Ledger e = energy_ledger(b.model, b.state);
    CAPTURE(e.relative_error(), e.inserted / e.gravity, b.state.bodies.size(), b.state.step);
    CHECK(splits >= 4);
    CHECK(total_momentum(b.model, b.state).mass == Approx(start.mass).epsilon(1e-13));
    CHECK(rests());
    CHECK(deepest_overlap(b.state) < 0.5 * c.parts[0].dilation_radius.value());
    CHECK(e.relative_error() < 1e-3);
    WARN(splits << " splits, " << b.state.step << " steps, kinetic energy " << e.kinetic / (weight * c.test.drop_height)
                << " of m g h, floor bears " << f.load / weight << " of the weight, inserted "
                << e.inserted / e.gravity);
}
