// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/gather.h"

#include "gpu/parallel.h"
#include "model/views.h"

#include <vector>

namespace grainfrac {

namespace {

struct GatherForces {
    static constexpr const char* name = "gather forces";
    View<const std::int32_t> begin, entry;
    SlotOf slot_of;
    View<const Vec3> slot_force, slot_torque_a, slot_torque_b;
    View<const double> mass, inverse_mass;
    Vec3 gravity;
    View<Vec3> force, torque;

    GF_FN void operator()(int body) const
    {
        Vec3 f, t;
        for (int k = begin[body]; k < begin[body + 1]; ++k) {
            const auto e = static_cast<unsigned>(entry[k]);  // halving it is one shift
            const int slot = slot_of(static_cast<int>(e / 2));
            if (slot < 0) continue;  // most pairs
            if (e % 2 == 0) {
                f -= slot_force[slot];
                t += slot_torque_a[slot];
            } else {
                f += slot_force[slot];
                t += slot_torque_b[slot];
            }
        }
        if (inverse_mass[body] > 0.0) f += mass[body] * gravity;
        force[body] = f;
        torque[body] = t;
    }
};

GatherForces kernel(const Model& model, State& state, Device d)
{
    Bodies& b = state.bodies;
    const Slots& s = state.slots;
    return {state.incidence.begin.read(d),
            state.incidence.entry.read(d),
            slot_of(state, d),
            s.force.read(d),
            s.torque_a.read(d),
            s.torque_b.read(d),
            b.mass.read(d),
            b.inverse_mass.read(d),
            model.gravity,
            b.force.write(d),
            b.torque.write(d)};
}

}  // namespace

void gather_forces(const Model& model, State& state)
{
    parallel_for(model.device, state.bodies.size(), kernel(model, state, model.device));
}

void gather_forces(const Model& model, State& state, const std::vector<int>& bodies)
{
    serial_for(bodies, kernel(model, state, Device::cpu));
}

void build_incidence(State& state)
{
    const int bodies = state.bodies.size();
    std::vector<std::int32_t> begin(static_cast<std::size_t>(bodies) + 1, 0);
    const auto for_each_interaction = [&](auto&& visit) {
        std::int32_t next = 0;
        state.for_each_bond_kind([&](const auto& bonds, int) {
            for (int i = 0; i < bonds.size(); ++i) visit(next++, bonds.a[i], bonds.b[i]);
        });
        for (int i = 0; i < state.pairs.size(); ++i) visit(next++, state.pairs.a[i], state.pairs.b[i]);
    };
    for_each_interaction([&](std::int32_t, std::int32_t a, std::int32_t b) {
        ++begin[static_cast<std::size_t>(a) + 1];
        ++begin[static_cast<std::size_t>(b) + 1];
    });
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    std::vector<std::int32_t> entry(static_cast<std::size_t>(begin.back()));
    std::vector<std::int32_t> at(begin.begin(), begin.end() - 1);
    for_each_interaction([&](std::int32_t interaction, std::int32_t a, std::int32_t b) {
        entry[static_cast<std::size_t>(at[static_cast<std::size_t>(a)]++)] = 2 * interaction;
        entry[static_cast<std::size_t>(at[static_cast<std::size_t>(b)]++)] = 2 * interaction + 1;
    });
    state.incidence.begin.host() = std::move(begin);
    state.incidence.entry.host() = std::move(entry);
    state.slots.resize(state.bond_slots() + state.contacts.size());
    state.slots.bond_acts.resize(state.bond_slots());
    state.for_each_bond_kind([&](const auto& bonds, int first) {
        for (int i = 0; i < bonds.size(); ++i) state.slots.bond_acts.at(first + i) = is_gone(bonds, i) ? 0 : 1;
    });
}

}  // namespace grainfrac
