// SPDX-License-Identifier: GPL-3.0-or-later
// What moves bodies outside a step, the stretching of samples and the scaling of a pull-out's path, finds the contacts
// that a search from nothing finds.
#include "contact/find_contacts.h"
#include "contact/find_pairs.h"
#include "experiment/pulled_sample.h"
#include "support/pull_out.h"
#include "support/spheres.h"

#include <set>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

using Pairs = std::set<std::pair<int, int>>;

Pairs in_contact(const State& s)
{
    Pairs pairs;
    for (int i = 0; i < s.contacts.size(); ++i) {
        if (s.contacts.found[i] == 1) pairs.insert({s.contacts.a[i], s.contacts.b[i]});
    }
    return pairs;
}

Pairs found_anew(const Model& model, State state)
{
    find_pairs(model, state);
    find_contacts(model, state);
    return in_contact(state);
}

}  // namespace

TEST_CASE("a sample that is stretched finds the contacts of what comes together")
{
    // two bonded columns, held apart; they come together as the sample gets thinner
    constexpr int n = 8;
    constexpr double gap = 4e-3;
    Assembly a = sphere_assembly(unbreakable_bond(false));
    a.model.contact_laws.host() = {LinearContact{1.0, 0.0, 0.0, 1.0, 0.0}};
    a.model.contact_law_of = {0};
    a.model.skin = 0.02;
    for (const double side : {-1.0, 1.0}) {
        for (int i = 0; i < n; ++i) {
            const int body = sphere(a, {side * 0.5 * (1.0 + gap), 0.0, 1.0 * i}, 0.5);
            a.state.bodies.held.at(body) = 1;  // along x
            if (i > 0) join(a, body - 1, body, {1.0, 0.4, 0.2, 0.2});
        }
    }
    PulledSample sample(a.model, a.state, 2);
    std::size_t touching = 0;
    for (const double strain : {0.001, 0.004, 0.008, 0.012, 0.016, 0.002}) {
        REQUIRE(sample.stretch_to(strain, 0.5).at_rest);
        const Pairs found = in_contact(a.state);
        CAPTURE(strain);
        CHECK(found == found_anew(a.model, a.state));
        const bool closed = 0.5 * strain * (1.0 + gap) > gap;
        CHECK(found.size() == (closed ? static_cast<std::size_t>(n) : 0u));
        touching = std::max(touching, found.size());
    }
    CHECK(touching > 0);
}

TEST_CASE("a path that is scaled finds the contacts of what comes together")
{
    // a sphere that stands still a little above the grip
    for (const bool by_events : {false, true}) {
        Case c = pull_out_case(4.0);
        c.parts[0].region.diameter = 5.0;
        Built b = build(c, default_device());
        PullOut& p = *b.experiment.pull_out;
        int grip = 0;
        while (b.state.bodies.wall[grip] != p.grip_wall) ++grip;
        SphereSpec stop;
        stop.radius = 0.4;
        stop.position = b.state.bodies.position[grip] + Vec3{0.0, 0.0, 0.8 + 9e-4};
        stop.group = p.matrix_group;
        const int body = add_sphere(b.model, b.state, stop);
        drive(b.state, body);
        p.place.push_back(-1.0);
        p.along.push_back({});
        p.at_end.push_back(0);
        start(b.model, b.state);
        REQUIRE(in_contact(b.state).empty());
        PullOutPath path(p, by_events ? by_damage(0.2) : by_displacement(2e-4), b.model, b.state);
        std::size_t touching = 0;
        for (int k = 0; k < (by_events ? 2 : 6); ++k) {
            REQUIRE(path.next(b.model, b.state, {}) == PullOutPath::Found::equilibrium);
            const Pairs found = in_contact(b.state);
            CHECK(found == found_anew(b.model, b.state));
            const double risen = b.state.bodies.position[grip].z - b.state.bodies.start_position[grip].z;
            CHECK(found.count({std::min(grip, body), std::max(grip, body)}) == (risen > 9e-4 ? 1u : 0u));
            touching = std::max(touching, found.size());
        }
        CHECK(touching > 0);
    }
}
