// SPDX-License-Identifier: GPL-3.0-or-later
// Several bonds or contacts at once give the bits of one after the other, whatever the width of the processor's
// vectors.
#include "model/lanes.h"

#include "contact/contact_forces.h"
#include "contact/find_contacts.h"
#include "contact/find_pairs.h"
#include "support/spheres.h"

#include <cstring>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

/// A crooked chain that moves: bonds of both forms, damped or not, in runs of 1 to 40; weak ones among them, some
/// broken.
Assembly mixed_chain()
{
    int draw = 0;
    Assembly a = sphere_assembly(unbreakable_bond(false));
    a.model.sphere_bond_laws.host() = {unbreakable_bond(false),
                                       unbreakable_bond(false, 0.1),
                                       unbreakable_bond(true),
                                       unbreakable_bond(true, 0.2),
                                       {{1e-3, 1e-3, 0.3, 1.0, false, true}, 0.1, false}};
    const int runs[] = {1, 40, 16, 17, 3, 33, 15, 2, 31, 5};
    int n = 0, law = 0;
    sphere(a, {}, 0.5);
    for (const int run : runs) {
        for (int k = 0; k < run; ++k, ++n) {
            sphere(a, {static_cast<double>(n + 1), 0, 0}, 0.4 + 0.1 * (n % 3));
            join(a, n, n + 1, {3.0 + n % 7, 1.7, law < 2 ? 0.9 : 0.0, 0.6}, law);
        }
        law = (law + 1) % 5;
    }
    build_incidence(a.state);
    start_bonds(a.model, a.state);
    State& s = a.state;
    for (int i = 0; i < s.bodies.size(); ++i) {
        shift(s, i, 1e-2 * random_vector(draw));
        turn(s, i, random_turn(draw, 1e-2));
        s.bodies.velocity.at(i) = random_vector(draw);
        s.bodies.angular_velocity.at(i) = random_vector(draw);
    }
    for (const int i : {0, 20, 21, 60, 100}) s.sphere_bonds.cause.at(i) = 1;
    return a;
}

template <class T>
bool same_bits(const Buffer<T>& a, const Buffer<T>& b)
{
    if (a.empty() || a.size() != b.size()) return a.size() == b.size();
    return std::memcmp(a.host().data(), b.host().data(), static_cast<std::size_t>(a.size()) * sizeof(T)) == 0;
}

template <class Arrays>
void check_same_arrays(Arrays& a, Arrays& b)
{
    std::vector<const void*> others;
    b.for_each_array([&](const char*, auto& array) { others.push_back(&array); });
    std::size_t k = 0;
    a.for_each_array([&](const char* name, auto& array) {
        INFO(name);
        CHECK(same_bits(array, *static_cast<const std::remove_reference_t<decltype(array)>*>(others[k++])));
    });
}

void check_same(State& a, State& b)
{
    check_same_arrays(a.sphere_bonds, b.sphere_bonds);
    check_same_arrays(a.contacts, b.contacts);
    CHECK(same_bits(a.slots.force, b.slots.force));
    CHECK(same_bits(a.slots.torque_a, b.slots.torque_a));
    CHECK(same_bits(a.slots.torque_b, b.slots.torque_b));
    CHECK(same_bits(a.slots.bond_acts, b.slots.bond_acts));
}

/// Spheres pressed into each other and moving, by laws that dissipate in all ways; some touch no longer.
Assembly pressed_spheres()
{
    int draw = 0;
    Assembly a = sphere_assembly(unbreakable_bond(false));
    a.model.skin = 0.5;
    a.model.contact_laws.host() = {LinearContact{1e3, 0.7, 0.3, 1.0, 0.0}, LinearContact{2e3, 0.5, 0.1, 4.0, 0.0},
                                   LinearContact{3e3, 0.9, 1e3, 1.0, 0.2}};
    for (int i = 0; i < 120; ++i) {
        sphere(a, {0.9 * i, 0.1 * (i % 3), 0}, 0.5);
        a.state.bodies.velocity.at(i) = random_vector(draw);
        a.state.bodies.angular_velocity.at(i) = random_vector(draw);
    }
    find_pairs(a.model, a.state);
    for (int k = 0; k < a.state.pairs.size(); ++k) a.state.pairs.law.at(k) = k / 23 % 3;
    find_contacts(a.model, a.state);
    return a;
}

/// Go on a little, so that contacts slide, roll, open and come.
void go_on(Assembly& a, double dt)
{
    for (int i = 0; i < a.state.bodies.size(); ++i) shift(a.state, i, dt * a.state.bodies.velocity[i]);
    find_contacts(a.model, a.state);
}

/// Each vector unit of this processor, and what it is compared with: one interaction after the other.
template <class Make, class Step>
void compare(Make&& make, Step&& step)
{
    const VectorUnit widest = widest_vector_unit();
    for (const VectorUnit unit : {VectorUnit::base, VectorUnit::avx2, VectorUnit::avx512}) {
        if (unit > widest) continue;
        use_vector_unit(unit);
        Assembly one = make(), together = make();
        one.model.device = together.model.device = Device::cpu;
        for (int round = 0; round < 20; ++round) {
            step(one, round < 2 ? 0.0 : 1e-2, true);
            step(together, round < 2 ? 0.0 : 1e-2, false);
            check_same(one.state, together.state);
        }
    }
    use_vector_unit(widest);
}

std::vector<int> all(int n)
{
    std::vector<int> indices;
    for (int i = 0; i < n; ++i) indices.push_back(i);
    return indices;
}

}  // namespace

TEST_CASE("lanes: several contacts at once give the bits of one after the other")
{
    int touched = 0, opened = 0;
    double slid = 0.0, damped = 0.0;
    compare(pressed_spheres, [&](Assembly& a, double dt, bool one_by_one) {
        Contacts& c = a.state.contacts;
        for (int k = 0; k < c.size(); ++k) {
            touched += c.found[k] == 1 ? 1 : 0;
            opened += c.active[k] == 1 && c.found[k] != 1 ? 1 : 0;
        }
        if (one_by_one)
            contact_forces(a.model, a.state, all(c.size()), dt);
        else
            contact_forces(a.model, a.state, dt);
        for (int k = 0; k < c.size(); ++k) {
            slid += c.friction_work[k];
            damped += std::fabs(c.viscous_work[k]);
        }
        go_on(a, 1e-2);
    });
    CHECK(touched > 100);
    CHECK(opened > 5);
    CHECK(slid > 0.0);
    CHECK(damped > 0.0);
}

TEST_CASE("lanes: several bonds at once give the bits of one after the other")
{
    int broken = 0;
    compare(mixed_chain, [&](Assembly& a, double dt, bool one_by_one) {
        const int n = a.state.sphere_bonds.size();
        if (one_by_one)
            sphere_bond_forces(a.model, a.state, all(n), dt);
        else
            sphere_bond_forces(a.model, a.state, dt);
        for (int i = 0; i < n; ++i) broken += is_gone(a.state.sphere_bonds, i) ? 1 : 0;
        for (int i = 0; i < a.state.bodies.size(); ++i) shift(a.state, i, dt * a.state.bodies.velocity[i]);
    });
    CHECK(broken > 10);
}
