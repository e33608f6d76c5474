// SPDX-License-Identifier: GPL-3.0-or-later
// Pull-outs in which the fibre snaps or the matrix tears: where, at what load, and what becomes of the energy. Before
// the interface yields all is linear, so that the load at which a bond breaks is strength over stress at any lower
// load.
#include "support/pull_out.h"
#include "support/spheres.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <optional>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

constexpr double section = std::numbers::pi;  // of the fibre [m^2]

/// A thin matrix, a fibre that stands out of it by `out`, bonds of the fibre of this strength; 0: unbreakable.
Case breaking_case(double length, double out, double strength)
{
    Case c = pull_out_case(length);
    c.parts[0].region.diameter = 6.0;
    c.parts[1].fibre.to.z = 0.5 * length + out;
    if (strength > 0.0) {
        c.bonds[1].failure = "point";
        c.bonds[1].tensile_strength = strength;
        c.bonds[1].cohesion = 100.0 * strength;
    }
    c.test.control = "displacement";
    return c;
}

std::vector<int> broken_bonds(const State& s)
{
    std::vector<int> broken;
    for (int i = 0; i < s.sphere_bonds.size(); ++i) {
        if (s.sphere_bonds.cause[i] != static_cast<int>(BondCause::whole)) broken.push_back(i);
    }
    return broken;
}

double pull_in(const State& s, int bond)
{
    return norm(s.slots.force[s.first_sphere_slot() + bond]);
}

/// Middle of a bond at the start.
double height_of(const State& s, int bond)
{
    const Bodies& b = s.bodies;
    return 0.5 * (b.start_position[s.sphere_bonds.a[bond]].z + b.start_position[s.sphere_bonds.b[bond]].z);
}

Ledger account(const PulledOut& run)
{
    return energy_ledger(run.built.model, run.built.state);
}

}  // namespace

TEST_CASE("a fibre that is too weak snaps outside its matrix at its strength", "[pull_out]")
{
    PulledOut run(breaking_case(8.0, 2.5, 8e6));
    run.follow(by_displacement(2e-4), [](const PullOutState& now) { return now.end_stress < 1e5; });
    const State& s = run.built.state;
    const PullOutState& before = run.path[run.path.size() - 2];
    CHECK(run.largest(&PullOutState::end_stress) == before.end_stress);
    CHECK(before.end_stress == Approx(8e6).epsilon(1e-5));
    // the grip stays where the fibre snaps; what is beyond it was stretched
    CHECK(run.path.back().end_displacement ==
          Approx(before.end_displacement - run.pull_out().beyond_grip * before.end_stress / 50e9).epsilon(1e-9));
    CHECK(std::fabs(run.path.back().end_stress) < 1.0);
    CHECK(run.path.back().mean_damage == 0.0);
    const std::vector<int> broken = broken_bonds(s);
    REQUIRE(broken.size() == 1);
    CHECK(height_of(s, broken[0]) > 4.0 - 0.41);  // the last node is half a layer below the face
    // what was stored is lost: in the bond, and in what swings
    const Ledger e = account(run);
    CHECK(e.relative_error() < 1e-6);
    CHECK(e.fracture + e.damping == Approx(e.external).epsilon(1e-6));
    CHECK(e.fracture == Approx(0.5 * 8e6 * 8e6 / 50e9 * section * run.pull_out().piece).epsilon(1e-4));
}

TEST_CASE("a fibre snaps in its matrix where stress over strength is largest", "[pull_out]")
{
    Case c = breaking_case(8.0, 0.0, 8e6);
    SECTION("of one strength: next to the grip")
    {
        PulledOut run(c);
        const State& s = run.built.state;
        int last_link = -1;
        for (int i = 0; i < s.sphere_bonds.size(); ++i) {
            if (s.bodies.group[s.sphere_bonds.a[i]] != run.pull_out().fibre_group) continue;
            if (last_link < 0 || height_of(s, i) > height_of(s, last_link)) last_link = i;
        }
        double pull_at_break = 0.0;
        run.follow(by_displacement(2e-4), [&](const PullOutState&) {
            pull_at_break = std::max(pull_at_break, pull_in(s, last_link));
            return !broken_bonds(s).empty();
        });
        REQUIRE(broken_bonds(s) == std::vector<int>{last_link});
        // the grip bears what the last patches do besides
        const PullOutState& last = run.path[run.path.size() - 2];
        CHECK(last.end_stress > 8e6);
        CHECK(last.mean_damage == 0.0);
        CHECK(pull_at_break / section == Approx(8e6).epsilon(1e-5));
        CHECK(run.path.back().mean_damage > 0.0);  // what still bears is the grip's own node
        CHECK(account(run).relative_error() < 2e-4);
    }
    SECTION("a weak place in the middle")
    {
        PulledOut run(c);
        State& s = run.built.state;
        int weak = -1, link = 0;
        for (int i = 0; i < s.sphere_bonds.size(); ++i) {
            if (s.bodies.group[s.sphere_bonds.a[i]] != run.pull_out().fibre_group) continue;
            if (++link == 5) weak = i;
        }
        s.sphere_bonds.strength_factor.at(weak) = 0.3;
        double share = 0.0;  // of the end stress
        run.follow(by_displacement(2e-4), [&](const PullOutState& now) {
            if (share == 0.0) share = pull_in(s, weak) / section / now.end_stress;
            return !broken_bonds(s).empty();
        });
        REQUIRE(broken_bonds(s) == std::vector<int>{weak});
        const PullOutState &before = run.path[run.path.size() - 2], &after = run.path.back();
        CHECK(share < 0.9);
        CHECK(before.end_stress == Approx(0.3 * 8e6 / share).epsilon(1e-4));
        // what is left of the fibre bears less; the part behind the break bears nothing at its end
        CHECK(after.end_stress < before.end_stress);
        CHECK(after.end_stress > 0.0);
        CHECK(pull_in(s, weak) == 0.0);
        CHECK(after.support_stress == Approx(after.end_stress).epsilon(1e-5));
        CHECK(account(run).relative_error() < 1e-6);
    }
}

TEST_CASE("a fibre snaps if it is weaker than the peak of its pull-out and comes out if it is not", "[pull_out][slow]")
{
    const double shift = 2e-4;
    PulledOut whole(breaking_case(8.0, 1.0, 0.0));
    const auto enough = [](const PullOutState& now) { return now.end_displacement > 5e-3; };
    whole.follow(by_displacement(shift), enough);
    const double peak = whole.largest(&PullOutState::end_stress);
    for (const double over : {0.995, 1.005}) {
        PulledOut run(breaking_case(8.0, 1.0, over * peak));
        run.follow(by_displacement(shift), enough);
        CAPTURE(over);
        CHECK(broken_bonds(run.built.state).size() == (over < 1.0 ? 1 : 0));
        CHECK(run.largest(&PullOutState::end_stress) == Approx(std::min(over, 1.0) * peak).epsilon(1e-3));
        CHECK((run.path.back().mean_damage > 0.999) == (over > 1.0));
    }
}

TEST_CASE("a matrix tears at the load that equilibrium foretells", "[pull_out]")
{
    for (const char* support : {"uniform", "held"}) {
        Case c = breaking_case(4.0, 0.0, 0.0);
        c.parts[0].region.diameter = 5.0;
        c.bonds[0].failure = "point";
        c.bonds[0].tensile_strength = 0.5e6;
        c.bonds[0].cohesion = 5e6;
        c.test.support = support;
        CAPTURE(support);
        PulledOut run(c);
        const State& s = run.built.state;
        double first = 0.0;  // end stress at which the first bond will break, told by the first state
        run.follow(by_displacement(1e-4), [&](const PullOutState& now) {
            if (first == 0.0) first = now.end_stress / most_used_bond(run.built.model, s).share;
            return now.end_stress < 0.5 * run.largest(&PullOutState::end_stress);
        });
        std::size_t k = 1;
        while (run.path[k + 1].end_stress > run.path[k].end_stress) ++k;
        CHECK(run.path[k].end_stress == Approx(first).epsilon(2e-4));
        // the far face bears all of the load
        CHECK(run.path[k].mean_damage == 0.0);
        for (const int i : broken_bonds(s))
            CHECK(height_of(s, i) < -0.5 * run.pull_out().length + 2.5 * run.pull_out().piece);
        CHECK(broken_bonds(s).size() > 6);
        const Ledger e = energy_ledger(run.built.model, s);
        // what comes off the face that is held in the mean knocks against what does not
        CHECK(e.relative_error() < (c.test.support == "held" ? 1e-6 : 2e-3));
        for (const PullOutState& now : run.path) CHECK(std::fabs(now.support_stress - now.end_stress) < 1e-4 * first);
    }
}

TEST_CASE("a path that is interrupted while the matrix tears is where it was, and goes on to the same bits",
          "[pull_out]")
{
    Case c = breaking_case(4.0, 0.0, 0.0);
    c.parts[0].region.diameter = 5.0;
    c.parts[1].fibre.from.z = -1.2;
    c.bonds[0].failure = "point";
    c.bonds[0].tensile_strength = 0.5e6;
    c.bonds[0].cohesion = 5e6;
    c.test.support = "uniform";
    PulledOut run(c);
    Model& model = run.built.model;
    State& state = run.built.state;
    std::optional<PullOutPath> path(std::in_place, run.pull_out(), by_displacement(1e-4), model, state);
    const auto never = [] { return false; };
    while (most_used_bond(model, state).share < 0.999)
        REQUIRE(*next_or_none(path, model, state, never) == PullOutPath::Found::equilibrium);
    const State before = state;
    const PullOutPath path_before = *path;
    const std::vector<std::int32_t> face = model.spread_bodies.host();
    const std::vector<double> area = model.spread_area.host();
    // the whole tear, and where it has taken bodies off the face
    int looks = 0, looks_before_loss = 0;
    const auto look = [&] {
        ++looks;
        if (model.spread_bodies.size() == static_cast<int>(face.size())) looks_before_loss = looks;
        return false;
    };
    REQUIRE(next_or_none(path, model, state, look));
    const State torn = state;
    const std::vector<std::int32_t> face_torn = model.spread_bodies.host();
    REQUIRE(face_torn.size() < face.size());
    REQUIRE(looks > looks_before_loss + 2);
    for (const int at : {1, looks_before_loss / 2, looks_before_loss + 1, (looks_before_loss + looks) / 2, looks}) {
        CAPTURE(at, looks_before_loss, looks);
        state = before;
        path.emplace(path_before);
        model.spread_bodies.host() = face;
        model.spread_area.host() = area;
        int seen = 0;
        CHECK_FALSE(next_or_none(path, model, state, [&] { return ++seen >= at; }));
        CHECK(model.spread_bodies.host() == face);
        CHECK(model.spread_area.host() == area);
        CHECK(broken_bonds(state) == broken_bonds(before));
        REQUIRE(next_or_none(path, model, state, never));
        CHECK(model.spread_bodies.host() == face_torn);
        CHECK(state.step == torn.step);
        CHECK(broken_bonds(state) == broken_bonds(torn));
        for (int i = 0; i < state.bodies.size(); ++i) {
            REQUIRE(norm2(state.bodies.position[i] - torn.bodies.position[i]) == 0.0);
            REQUIRE(norm2(state.bodies.force[i] - torn.bodies.force[i]) == 0.0);
        }
    }
}

TEST_CASE("the most used bond breaks, however it lies and is bent", "[pull_out]")
{
    int draw = 0;
    for (int k = 0; k < 500; ++k) {
        SphereBondLaw law = unbreakable_bond(false);
        law.strength = {1e6, k % 2 == 0 ? 1e8 : 1e6, 0.3, 1.0, k % 3 == 0, true};
        Assembly a = sphere_assembly(law);
        const double small = 0.3 + 0.2 * std::fabs(random_vector(draw).x);
        const Vec3 direction = normalized(random_vector(draw));
        sphere(a, random_vector(draw), 0.5);
        sphere(a, a.state.bodies.position[0] + (0.5 + small) * direction, small);
        join(a, 0, 1, {1e9, 4e8, 1e8, 5e7});
        shift(a.state, 1, 1e-4 * (random_vector(draw) + direction));
        turn(a.state, 0, random_turn(draw, 1e-3));
        turn(a.state, 1, random_turn(draw, 1e-3));
        evaluate_bonds(a);
        const MostUsedBond most = most_used_bond(a.model, a.state);
        REQUIRE(most.bond == 0);
        const double stored = a.state.sphere_bonds.stored_energy[0];
        break_bond(a.model, a.state, most);
        REQUIRE(a.state.sphere_bonds.cause[0] != static_cast<int>(BondCause::whole));
        CHECK(a.state.sphere_bonds.strength_factor[0] == 1.0);
        CHECK(a.state.sphere_bonds.fracture_work[0] == Approx(stored).epsilon(1e-12));
        CHECK(a.state.sphere_bonds.stored_energy[0] == 0.0);
        CHECK(most_used_bond(a.model, a.state).bond == -1);
    }
}
