// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/find_pairs.h"

#include "contact/gather.h"
#include "geometry/near_boxes.h"
#include "gpu/parallel.h"
#include "model/rearrange.h"

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

/// The neighbour list of now, without contacts.
CandidatePairs candidates(const Model& model, const State& state)
{
    CandidatePairs fresh;
    const Bodies& bodies = state.bodies;
    const std::vector<BondedPair> bonded = bonded_pairs(state);
    const auto near = overlapping_boxes(body_boxes(model, state));
    for (Buffer<std::int32_t>* array : {&fresh.a, &fresh.b, &fresh.law, &fresh.bond_slot, &fresh.bond_count})
        array->host().reserve(near.size());
    std::size_t at_bond = 0;
    for (const auto& [a, b] : near) {
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
    fresh.apart_until.resize(n);
    fresh.corners.resize(n);
    fresh.contact.resize(n, no_contact::apart);
    return fresh;
}

void book(const Contacts& c, int i, PastContacts& past)
{
    past.friction_work += c.friction_work[i];
    past.viscous_work += c.viscous_work[i];
    past.inserted_work += c.inserted_work[i];
    past.hysteresis_work += c.hysteresis_work[i] + c.stored_energy[i];
}

/// What the pairs that stay keep; the energies of contacts that go are booked. Returns the contacts that stay, in the
/// order of their pairs, which is that of their new indices.
std::vector<int> take_over_pairs(State& state, CandidatePairs& fresh)
{
    const CandidatePairs& old = state.pairs;
    std::vector<int> source;
    int k = 0;
    for (int o = 0; o < old.size(); ++o) {  // both lists are sorted: walk them together
        const std::pair<int, int> pair{old.a[o], old.b[o]};
        while (k < fresh.size() && std::pair<int, int>{fresh.a[k], fresh.b[k]} < pair) ++k;
        const int contact = old.contact[o];
        if (k == fresh.size() || std::pair<int, int>{fresh.a[k], fresh.b[k]} != pair) {
            if (contact >= 0) book(state.contacts, contact, state.past_contacts);
            continue;
        }
        fresh.corners.at(k) = old.corners[o];
        fresh.contact.at(k) = contact >= 0 ? static_cast<int>(source.size()) : contact;
        if (contact >= 0) source.push_back(contact);
    }
    return source;
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
    CandidatePairs fresh = candidates(model, state);
    const std::vector<int> source = take_over_pairs(state, fresh);
    Contacts& c = state.contacts;
    const int old_slots = std::max(0, state.slots.size() - c.size()), slots = state.bond_slots();
    for (Buffer<Vec3>* slot : {&state.slots.force, &state.slots.torque_a, &state.slots.torque_b}) {
        const std::vector<Vec3> before(slot->host().begin() + old_slots, slot->host().end());
        slot->host().resize(static_cast<std::size_t>(slots));
        slot->resize(slots + static_cast<int>(source.size()));
        for (std::size_t k = 0; k < source.size(); ++k) {  // what is not in contact has nothing in its slot
            if (c.active[source[k]] == 1)
                slot->at(slots + static_cast<int>(k)) = before[static_cast<std::size_t>(source[k])];
        }
    }
    c = gathered(c, source);
    for (int i = 0; i < fresh.size(); ++i) {
        if (fresh.contact[i] >= 0) c.pair.at(fresh.contact[i]) = i;
    }
    state.pairs = std::move(fresh);
    state.travel = 0.0;
    state.slots.dyad_a.resize(0);  // of the interactions that were
    state.slots.dyad_b.resize(0);
    build_incidence(state);
}

}  // namespace grainfrac
