// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/find_pairs.h"

#include "contact/gather.h"
#include "geometry/near_boxes.h"
#include "gpu/parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace grainfrac {

namespace {

std::vector<Box> body_boxes(const Model& model, const State& state)
{
    const Shapes& s = model.shapes;
    const Bodies& b = state.bodies;
    std::vector<Box> boxes(static_cast<std::size_t>(b.size()));
    for (int i = 0; i < b.size(); ++i) {
        const Mat3 r = to_matrix(b.orientation[i]);
        Box& box = boxes[static_cast<std::size_t>(i)];
        box = {{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}};
        for (int v = s.vertex_begin[b.shape[i]]; v < s.vertex_begin[b.shape[i] + 1]; ++v) {
            const Vec3 p = b.position[i] + r * s.vertices[v];
            for (int k = 0; k < 3; ++k) {
                box.low[k] = std::min(box.low[k], p[k]);
                box.high[k] = std::max(box.high[k], p[k]);
            }
        }
        const double grow = s.radius[b.shape[i]] + 0.5 * model.skin;
        box.low -= Vec3{grow, grow, grow};
        box.high += Vec3{grow, grow, grow};
    }
    return boxes;
}

/// First slot and number of the bonds of each bonded pair, sorted by pair.
struct BondedPair {
    std::pair<int, int> bodies;
    std::int32_t slot = 0, count = 0;
};
std::vector<BondedPair> bonded_pairs(const State& state)
{
    std::vector<BondedPair> found;
    state.for_each_bond_kind([&](const auto& bonds, std::int32_t first) {
        for (int i = 0; i < bonds.size(); ++i) {
            const std::pair<int, int> bodies{bonds.a[i], bonds.b[i]};
            if (!found.empty() && found.back().bodies == bodies)
                ++found.back().count;
            else
                found.push_back({bodies, first + i, 1});
        }
    });
    std::sort(found.begin(), found.end(), [](const BondedPair& x, const BondedPair& y) { return x.bodies < y.bodies; });
    return found;
}

struct StepTravel {
    View<const Vec3> velocity, angular_velocity;
    View<const std::int32_t> shape;
    View<const double> bounding_radius;
    GF_FN double operator()(int i) const
    {
        return norm(velocity[i]) + norm(angular_velocity[i]) * bounding_radius[shape[i]];
    }
};

}  // namespace

bool pairs_are_stale(const Model& model, State& state, double dt)
{
    const Device d = model.device;
    const Bodies& b = state.bodies;
    state.travel += dt * parallel_max(d, b.size(),
                                      StepTravel{b.velocity.read(d), b.angular_velocity.read(d), b.shape.read(d),
                                                 model.shapes.bounding_radius.read(d)});
    return state.travel > 0.5 * model.skin;
}

void find_pairs(const Model& model, State& state)
{
    Contacts old = std::move(state.contacts);
    const int old_slots = std::max(0, state.slots.size() - old.size());
    Contacts fresh;
    const Bodies& bodies = state.bodies;
    const std::vector<BondedPair> bonded = bonded_pairs(state);
    std::size_t at_bond = 0;
    for (const auto& [a, b] : overlapping_boxes(body_boxes(model, state))) {
        if (bodies.inverse_mass[a] == 0.0 && bodies.inverse_mass[b] == 0.0) continue;
        const std::pair<int, int> pair{a, b};
        while (at_bond < bonded.size() && bonded[at_bond].bodies < pair) ++at_bond;
        const bool has_bond = at_bond < bonded.size() && bonded[at_bond].bodies == pair;
        fresh.a.host().push_back(a);
        fresh.b.host().push_back(b);
        fresh.law.host().push_back(
            model.contact_law_of[entry_of_pair(bodies.group[a], bodies.group[b], model.groups.size())]);
        fresh.bond_slot.host().push_back(has_bond ? bonded[at_bond].slot : 0);
        fresh.bond_count.host().push_back(has_bond ? bonded[at_bond].count : 0);
    }
    const int n = fresh.size();
    fresh.point.resize(n);
    fresh.apart_until.resize(n);
    fresh.for_each_history([&](const char*, auto& array) { array.resize(n); });
    for (double& s : fresh.stiffness_scale.host()) s = 1.0;

    // both lists are sorted: walk them together, carry over what stays, book what goes
    std::vector<std::pair<int, int>> kept;  // new, old
    int k = 0;
    PastContacts& past = state.past_contacts;
    for (int o = 0; o < old.size(); ++o) {
        const std::pair<int, int> pair{old.a[o], old.b[o]};
        while (k < n && std::pair<int, int>{fresh.a[k], fresh.b[k]} < pair) ++k;
        if (k < n && std::pair<int, int>{fresh.a[k], fresh.b[k]} == pair) {
            kept.emplace_back(k, o);
            fresh.point.host()[static_cast<std::size_t>(k)] = old.point[o];
            continue;
        }
        past.friction_work += old.friction_work[o];
        past.viscous_work += old.viscous_work[o];
        past.inserted_work += old.inserted_work[o];
        past.hysteresis_work += old.hysteresis_work[o] + old.stored_energy[o];
    }
    std::vector<void*> targets;
    fresh.for_each_history([&](const char*, auto& array) { targets.push_back(&array); });
    std::size_t at = 0;
    old.for_each_history([&](const char*, auto& from) {
        auto& to = *static_cast<std::remove_reference_t<decltype(from)>*>(targets[at++]);
        for (const auto& [i, o] : kept) to.host()[static_cast<std::size_t>(i)] = from[o];
    });
    state.contacts = std::move(fresh);
    state.travel = 0.0;
    std::vector<std::pair<int, int>> with_force;  // what is not in contact has nothing in its slot
    for (const auto& [i, o] : kept) {
        if (state.contacts.active[i] == 1) with_force.emplace_back(i, o);
    }
    for (Buffer<Vec3>* slots : {&state.slots.force, &state.slots.torque_a, &state.slots.torque_b}) {
        const std::vector<Vec3> before(slots->host().begin() + old_slots, slots->host().end());
        slots->host().resize(static_cast<std::size_t>(state.bond_slots()));
        slots->resize(state.bond_slots() + n);
        for (const auto& [i, o] : with_force) slots->at(state.bond_slots() + i) = before[static_cast<std::size_t>(o)];
    }
    state.slots.dyad_a.resize(0);  // of the interactions that were
    state.slots.dyad_b.resize(0);
    build_incidence(state);
}

}  // namespace grainfrac
