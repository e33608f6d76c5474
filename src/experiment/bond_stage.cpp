// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/bond_stage.h"

#include "contact/contact_forces.h"
#include "contact/find_contacts.h"
#include "contact/find_pairs.h"
#include "contact/gather.h"
#include "fracture/bond_forces.h"
#include "geometry/shared_faces.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <type_traits>
#include <utility>

namespace grainfrac {

namespace {

using Pair = std::pair<int, int>;

std::vector<Polyhedron> placed_grains(const Model& model, const Bodies& b)
{
    std::vector<Polyhedron> placed;
    for (int i = 0; i < b.size(); ++i) {
        const Polyhedron& p = model.grain_shapes[static_cast<std::size_t>(i)];
        placed.push_back(p.vertices.empty() ? p : translated(rotated(p, b.orientation[i]), b.position[i]));
    }
    return placed;
}

std::set<Pair> pairs_with_bonds(const State& state)
{
    std::set<Pair> pairs;
    state.for_each_bond_kind([&](const auto& bonds, int) {
        for (int i = 0; i < bonds.size(); ++i) {
            if (!is_gone(bonds, i)) pairs.insert({bonds.a[i], bonds.b[i]});
        }
    });
    return pairs;
}

/// Faces to be bonded, their polygons half-way between the two.
std::vector<SharedFace> facing_faces(const Model& model, const State& state, double distance, double angle)
{
    const std::vector<Polyhedron> grains = placed_grains(model, state.bodies);
    SharedFaceOptions options;
    options.plane_distance = distance;
    options.normal_tolerance = 1.0 - std::cos(angle);
    std::vector<SharedFace> faces = find_shared_faces(grains, options);
    const std::set<Pair> bonded = pairs_with_bonds(state);
    std::erase_if(faces, [&](const SharedFace& f) { return bonded.count({f.a, f.b}) > 0; });
    for (SharedFace& f : faces) {
        const Plane& other = grains[static_cast<std::size_t>(f.b)].planes[static_cast<std::size_t>(f.face_b)];
        for (Vec3& x : f.polygon)
            x += 0.5 * (other.offset - dot(other.normal, x)) / dot(other.normal, f.normal) * f.normal;
    }
    return faces;
}

/// Entries of x and y in the order of `from`: (0: x, 1: y; index). Arrays of another length, the begins of ranges, are
/// left empty.
template <class Arrays>
Arrays merged(Arrays& x, Arrays& y, const std::vector<Pair>& from)
{
    Arrays to;
    std::vector<void*> targets, others;
    to.for_each_array([&](const char*, auto& array) { targets.push_back(&array); });
    y.for_each_array([&](const char*, auto& array) { others.push_back(&array); });
    std::size_t k = 0;
    x.for_each_array([&](const char*, auto& array) {
        using Array = std::remove_reference_t<decltype(array)>;
        const Array& other = *static_cast<Array*>(others[k]);
        auto& target = *static_cast<Array*>(targets[k++]);
        if (array.size() != x.size() || other.size() != y.size()) return;
        for (const auto& [which, i] : from) target.host().push_back((which == 0 ? array : other)[i]);
    });
    return to;
}

/// The bonds of two lists, each sorted by pair, as one sorted list; those of x first.
template <class Bonds>
std::vector<Pair> order_by_pair(const Bonds& x, const Bonds& y)
{
    std::vector<Pair> order;
    for (int i = 0; i < x.size(); ++i) order.push_back({0, i});
    for (int i = 0; i < y.size(); ++i) order.push_back({1, i});
    const auto pair_of = [&](const Pair& p) {
        const Bonds& bonds = p.first == 0 ? x : y;
        return Pair{bonds.a[p.second], bonds.b[p.second]};
    };
    std::stable_sort(order.begin(), order.end(), [&](const Pair& p, const Pair& q) { return pair_of(p) < pair_of(q); });
    return order;
}

void add_bonds(State& state, State& fresh)
{
    InterfaceBonds* lists[2] = {&state.interfaces, &fresh.interfaces};
    const std::vector<Pair> order = order_by_pair(state.interfaces, fresh.interfaces);
    std::vector<Pair> points, corners;
    std::vector<std::int32_t> point_begin{0}, corner_begin{0};
    for (const auto& [which, i] : order) {
        const InterfaceBonds& f = *lists[which];
        for (int q = f.point_begin[i]; q < f.point_begin[i + 1]; ++q) points.push_back({which, q});
        for (int c = f.corner_begin[i]; c < f.corner_begin[i + 1]; ++c) corners.push_back({which, c});
        point_begin.push_back(static_cast<std::int32_t>(points.size()));
        corner_begin.push_back(static_cast<std::int32_t>(corners.size()));
    }
    state.interfaces = merged(state.interfaces, fresh.interfaces, order);
    state.interfaces.point_begin.host() = std::move(point_begin);
    state.interfaces.corner_begin.host() = std::move(corner_begin);
    state.points = merged(state.points, fresh.points, points);
    state.corners = merged(state.corners, fresh.corners, corners);
    const auto add = [](auto& old, auto& made) {
        if (made.size() > 0) old = merged(old, made, order_by_pair(old, made));
    };
    add(state.parallels, fresh.parallels);  // of spheres none are made
}

/// Everything stands still, and contacts forget; what they held is booked as taken out.
double take_motion_and_contact_forces(const Model& model, State& state)
{
    const Ledger e = energy_ledger(model, state);
    const double removed = e.kinetic + e.elastic_contacts;
    Bodies& b = state.bodies;
    for (Buffer<Vec3>* motion : {&b.velocity, &b.angular_momentum, &b.angular_velocity})
        std::fill(motion->host().begin(), motion->host().end(), Vec3{});
    Contacts& c = state.contacts;
    std::fill(c.shear_force.host().begin(), c.shear_force.host().end(), Vec3{});
    std::fill(c.active.host().begin(), c.active.host().end(), 0);
    for (Buffer<double>* history : {&c.twist_moment, &c.max_overlap, &c.offset_overlap, &c.viscous_force,
                                    &c.normal_force, &c.stored_energy, &c.shear_stiffness, &c.twist_stiffness})
        std::fill(history->host().begin(), history->host().end(), 0.0);
    std::fill(c.stiffness_scale.host().begin(), c.stiffness_scale.host().end(), 1.0);
    state.past_contacts.inserted_work -= removed;
    return removed;
}

/// Contacts that overlap begin at their overlap of now, without force.
void free_contacts_of_force(State& state)
{
    Contacts& c = state.contacts;
    for (int i = 0; i < c.size(); ++i) {
        if (c.point[i].overlap_energy <= 0.0) continue;
        const auto k = static_cast<std::size_t>(i);
        c.active.host()[k] = 1;
        c.normal.host()[k] = c.point[i].normal;
        c.offset_overlap.host()[k] = std::sqrt(2.0 * c.point[i].overlap_energy);
    }
}

}  // namespace

BondsMade make_bonds(Model& model, State& state, const BondsToMake& plan, std::int64_t seed)
{
    BondsMade made;
    made.before = total_momentum(model, state);
    const std::vector<SharedFace> faces = facing_faces(model, state, plan.distance, plan.angle);
    const auto distance = [&](const SharedFace& f) {
        return std::fabs(dot(state.bodies.position[f.b] - state.bodies.position[f.a], f.normal));
    };
    State fresh;
    fresh.bodies = state.bodies;
    made.number = bond_faces(model, fresh, faces, distance, seed, [&](int a, int b) {
        return plan.table.rule_of(state.bodies.group[a], state.bodies.group[b]);
    });
    check_snap_back(model, fresh, plan.table);
    for (int i = 0; i < fresh.interfaces.size(); ++i) made.area += fresh.interfaces.area[i];
    const ParallelBonds& p = fresh.parallels;
    for (int i = 0; i < p.size(); ++i) made.area += CircularSection(p.radius[i]).area;

    made.removed_energy = take_motion_and_contact_forces(model, state);
    if (made.number > 0) add_bonds(state, fresh);
    state.slots.dyad_a.resize(0);  // of the interactions that were
    state.slots.dyad_b.resize(0);
    start_bonds(model, state);
    find_pairs(model, state);
    find_contacts(model, state);
    free_contacts_of_force(state);
    contact_forces(model, state, 0.0);
    bond_forces(model, state, 0.0);
    gather_forces(model, state);
    return made;
}

}  // namespace grainfrac
