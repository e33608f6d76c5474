// SPDX-License-Identifier: GPL-3.0-or-later
// Which pairs have a contact, and which faces a history: those that need one, and the results do not tell.
#include "contact/find_contacts.h"
#include "contact/find_pairs.h"
#include "gpu/thread_pool.h"
#include "model/point_history.h"
#include "model/validate.h"
#include "motion/energy.h"
#include "support/assembly.h"

#include <cstring>
#include <utility>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

/// 216 bricks that fly into each other and apart again, some of them bonded at the start.
Assembly collapsing_bricks()
{
    std::vector<GrainSpec> grains;
    int draw = 0;
    for (int k = 0; k < 216; ++k) {
        const double pitch = k / 36 < 2 ? 1.0 : 1.35;  // two layers in contact
        const Vec3 site{pitch * (k % 6), 1.35 * (k / 6 % 6), 1.35 * (k / 36)};
        grains.push_back(grain(translated(make_box({1, 0.9, 0.8}), site), site));
    }
    Assembly a = assemble(std::move(grains));
    InterfaceLaw law = elastic_law();
    law.tensile_strength = law.cohesion = 10.0;
    law.failure = FailureUnit::face;
    law.softening = Softening::brittle;
    bond(a, law, 0.0, 1e3, 0.5);
    a.model.contact_laws.host() = {{1e3, 0.4, 0.3, 1.0, 0.1}};
    a.model.skin = 0.2;
    for (int i = 0; i < a.state.bodies.size(); ++i) {
        a.state.bodies.velocity.at(i) = random_vector(draw) - 0.3 * a.state.bodies.position[i];
        set_spin(a.state.bodies, i, 2.0 * random_vector(draw));
    }
    start(a.model, a.state);
    return a;
}

template <class Arrays>
bool same_arrays(Arrays& a, Arrays& b)
{
    std::vector<const void*> others;
    b.for_each_array([&](const char*, auto& array) { others.push_back(&array); });
    std::size_t k = 0;
    bool same = true;
    a.for_each_array([&](const char*, auto& array) {
        using Array = std::remove_reference_t<decltype(array)>;
        const auto &x = std::as_const(array).host(), &y = static_cast<const Array*>(others[k++])->host();
        same = same && x.size() == y.size() &&
               (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof x.front()) == 0);
    });
    return same;
}

/// Three blocks in a row along x; the second face is the weaker.
Assembly three_blocks()
{
    std::vector<GrainSpec> grains;
    for (int k = 0; k < 3; ++k) grains.push_back(grain(make_box({1, 1, 0.7}, {1.0 * k, 0, 0}), {1.0 * k, 0, 0}));
    Assembly a = assemble(std::move(grains));
    InterfaceLaw law = elastic_law();
    law.tensile_strength = law.cohesion = 20;
    law.failure = FailureUnit::point;
    law.softening = Softening::bilinear;
    law.fracture_energy_I = law.fracture_energy_II = 10;
    bond(a, law, 0.0, 1e3, 0.5);
    a.state.interfaces.strength_factor.at(1) = 0.5;
    build_incidence(a.state);
    return a;
}

/// The third block is pulled and bent away by steps.
void pull(Assembly& a, int k)
{
    const double u = 2e-4 * k;
    set_position(a.state, 2, Vec3{2.0 + u, 0, 0});
    a.state.bodies.orientation.at(2) = from_axis_angle({0, 0, 1}, 0.3 * u);
    a.state.time += 1.0;
    bond_forces(a.model, a.state, 1e-3);
}

}  // namespace

TEST_CASE("a contact for each pair that touches, alike for any number of threads")
{
    set_threads(1);
    Assembly one = collapsing_bricks();
    set_threads(3);
    Assembly other = collapsing_bricks();
    int begun = 0, taken_over = 0, made_anew = 0;
    for (int i = 0; i < 400; ++i) {
        const double travel = one.state.travel;
        const int before = one.state.contacts.size();
        const Buffer<std::int32_t> held = one.state.pairs.contact;
        set_threads(1);
        step(one.model, one.state, 1e-3);
        set_threads(3);
        step(other.model, other.state, 1e-3);

        CandidatePairs& pairs = one.state.pairs;
        const Contacts& c = one.state.contacts;
        REQUIRE(why_not_valid(one.model, one.state).empty());  // each contact is that of its pair
        const bool listed_anew = one.state.travel < travel;
        made_anew += listed_anew ? 1 : 0;
        for (int k = listed_anew ? 0 : before; k < c.size(); ++k) {
            CHECK(c.found[k] != held_by_bonds);
            begun += listed_anew ? 0 : 1;
            if (!listed_anew && held[c.pair[k]] == no_contact::held) ++taken_over;
            if (!listed_anew && k > before) CHECK(c.pair[k] > c.pair[k - 1]);
        }
        State all = one.state;  // every pair looked at anew: none was missed but where bonds have ended in this step
        find_contacts(one.model, all);
        for (int k = c.size(); k < all.contacts.size(); ++k)
            CHECK(pairs.contact[all.contacts.pair[k]] == no_contact::held);
        CHECK(one.state.slots.size() == one.state.bond_slots() + c.size());
        REQUIRE(same_arrays(pairs, other.state.pairs));
        REQUIRE(same_arrays(one.state.contacts, other.state.contacts));
    }
    CHECK(begun > 100);
    CHECK(taken_over > 5);
    CHECK(made_anew > 3);
    CHECK(state_hash(one.state) == state_hash(other.state));
    CHECK(one.state.contacts.size() < one.state.pairs.size() / 3);
    set_threads(2);
}

TEST_CASE("energies do not go with the contacts that leave the list")
{
    Assembly a = collapsing_bricks();
    const auto lost = [&] {
        const Ledger e = energy_ledger(a.model, a.state);
        return e.friction + e.damping;
    };
    int left = 0;
    for (int i = 0; i < 400; ++i) {
        for (Vec3& v : a.state.bodies.velocity.host()) v *= i == 200 ? -4.0 : 1.0;  // and apart again
        step(a.model, a.state, 1e-3);
        const double before = lost();
        const int contacts = a.state.contacts.size();
        find_pairs(a.model, a.state);
        left += contacts - a.state.contacts.size();
        CHECK(lost() == Approx(before).epsilon(1e-13));
    }
    CHECK(left > 10);
}

TEST_CASE("points have a history where a face comes near to damage, and are the same without one till then")
{
    Assembly few = three_blocks(), all = three_blocks();
    begin_histories(all.state, std::array{0, 1});
    for (int k = 0; k <= 400; ++k) {
        pull(few, k);
        pull(all, k);
        for (int i = 0; i < 2; ++i) {
            const InterfaceBonds &f = few.state.interfaces, &g = all.state.interfaces;
            REQUIRE(f.damage[i] == g.damage[i]);
            REQUIRE(f.first_damage_time[i] == g.first_damage_time[i]);
            REQUIRE(few.state.slots.force[i] == all.state.slots.force[i]);
            REQUIRE(few.state.slots.torque_a[i] == all.state.slots.torque_a[i]);
            for (int q = f.point_begin[i]; q < f.point_begin[i + 1]; ++q) {
                const InterfacePointState x = point_state(few.state, i, q), y = point_state(all.state, i, q);
                REQUIRE(x.damage == y.damage);
                REQUIRE(x.slip1 == y.slip1);
            }
        }
        if (k == 10) CHECK(few.state.histories.size() == 0);
    }
    const InterfaceBonds& f = few.state.interfaces;
    CHECK(f.damage[1] > 0.1);
    CHECK(f.history[1] == 0);
    CHECK(f.history[0] == no_history::none);
    CHECK(few.state.histories.size() == f.point_begin[2] - f.point_begin[1]);
    CHECK(state_hash(few.state) == state_hash(all.state));
}
