// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/cleave.h"

#include "fracture/plane_tractions.h"
#include "gpu/thread_pool.h"
#include "model/grain_body.h"
#include "model/views.h"

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

/// Bodies per share of work that a thread takes at once is the pool's; fewer than this are done by the caller.
constexpr int least_for_threads = 64;
/// The gate is asked after this many steps, or this share of the time that a wave takes through a grain if that is
/// more. Small fragments make small steps, but stresses change no faster.
constexpr std::int64_t least_steps = 20;
constexpr double transits = 1.0;
/// A grain whose load would have to rise by 1/f waits for at most this many such intervals times 1/f - 1: stresses that
/// double within one are those of a crack's tip, where f was not small before.
constexpr double patience = 2.0;
constexpr std::int64_t most_intervals = 8;

/// A grain with all that acts on it, in its body frame: the sharp polyhedron as kernels see it, loads, motion.
struct LoadedGrain {
    std::vector<std::int32_t> loop_begin, loops;
    FacesView faces;
    std::vector<std::vector<Vec3>> corners;
    std::vector<FaceLoad> face_loads;
    std::vector<PointLoad> point_loads;
    GrainMotion motion;
    double size = 0.0;

    GrainLoads loads()
    {
        return {{point_loads.data(), static_cast<int>(point_loads.size())},
                {face_loads.data(), static_cast<int>(face_loads.size())}};
    }
};

LoadedGrain loaded_grain(const Model& model, const State& state, int body)
{
    const Bodies& b = state.bodies;
    const Polyhedron& shape = model.grain_shapes[static_cast<std::size_t>(body)];
    const Placement place = placement(b, body);
    const auto turned = [&](const Vec3& v) { return rotate_back(place.orientation, v); };
    LoadedGrain g;
    g.loop_begin.push_back(0);
    for (const auto& face : shape.faces) {
        g.loops.insert(g.loops.end(), face.begin(), face.end());
        g.loop_begin.push_back(static_cast<std::int32_t>(g.loops.size()));
    }
    g.faces = {shape.vertices.data(), g.loop_begin.data(), g.loops.data(), static_cast<int>(shape.faces.size())};
    g.size = bounding_size(shape);

    const Vec3 w = turned(b.angular_velocity[body]);
    const std::size_t material =
        static_cast<std::size_t>(model.groups[static_cast<std::size_t>(b.group[body])].material);
    g.motion.density = model.materials[material].density;
    g.motion.acceleration = turned(b.force[body]) * b.inverse_mass[body];
    g.motion.angular_velocity = w;
    g.motion.angular_acceleration = angular_acceleration(b.inertia[body], w, turned(b.torque[body]));
    g.motion.body_force = turned(model.gravity);

    const SlotOf slots = slot_of(state, Device::cpu);
    const int begin = state.incidence.begin[body], end = state.incidence.begin[body + 1];
    g.corners.reserve(static_cast<std::size_t>(end - begin));
    for (int k = begin; k < end; ++k) {
        const int entry = state.incidence.entry[k], slot = slots(entry / 2);
        if (slot < 0) continue;
        const bool is_a = entry % 2 == 0;
        const Vec3 force = turned(is_a ? -state.slots.force[slot] : state.slots.force[slot]);
        const Vec3 torque = turned(is_a ? state.slots.torque_a[slot] : state.slots.torque_b[slot]);
        if (norm2(force) + norm2(torque) == 0.0) continue;
        const InterfaceBonds& f = state.interfaces;
        if (slot < f.size()) {
            const Buffer<Vec3>& positions = is_a ? state.corners.position_a : state.corners.position_b;
            std::vector<Vec3> corners;
            for (int c = f.corner_begin[slot]; c < f.corner_begin[slot + 1]; ++c) corners.push_back(positions[c]);
            if (!is_a) std::reverse(corners.begin(), corners.end());  // counter-clockwise from outside the grain
            const PlaneMoments m = plane_moments(corners.data(), static_cast<int>(corners.size()));
            g.corners.push_back(std::move(corners));
            const Wrench resultant{force, torque - cross(m.centroid, force)};
            g.face_loads.push_back(
                {g.corners.back().data(), static_cast<int>(g.corners.back().size()), fit_tractions(m, resultant)});
        } else {
            const int parallel = slot - f.size();
            Vec3 point;
            if (parallel < state.parallels.size()) {
                point = (is_a ? state.parallels.position_a : state.parallels.position_b)[parallel];
            } else {
                point = place.to_body(state.contacts.point[slot - state.bond_slots()].position);
            }
            g.point_loads.push_back({point, force, torque - cross(point, force)});
        }
    }
    return g;
}

/// A grain that is bent has little stress in the mean: what one of its faces carries lets it through as well.
bool face_passes(const State& state, int body, const CleavageGate& gate)
{
    if (gate.kind != CleavageGate::Kind::principal_and_shear) return false;
    const InterfaceBonds& f = state.interfaces;
    const Quat q = state.bodies.orientation[body];
    const double tension = gate.share * gate.tension_threshold, shear = gate.share * gate.shear_threshold;
    for (int k = state.incidence.begin[body]; k < state.incidence.begin[body + 1]; ++k) {
        const int slot = state.incidence.entry[k] / 2;  // of an interface
        if (slot >= f.size()) break;                    // which come first
        const bool is_a = state.incidence.entry[k] % 2 == 0;
        const Vec3 force = rotate_back(q, is_a ? -state.slots.force[slot] : state.slots.force[slot]);
        const Vec3 torque = rotate_back(q, is_a ? state.slots.torque_a[slot] : state.slots.torque_b[slot]);
        if (norm2(force) + norm2(torque) == 0.0) continue;
        const Vec3* corners = &(is_a ? state.corners.position_a : state.corners.position_b)[f.corner_begin[slot]];
        const int count = f.corner_begin[slot + 1] - f.corner_begin[slot];
        const PlaneMoments m = plane_moments(corners, count);  // its normal points to b
        const TractionField t = fit_tractions(m, {force, torque - cross(m.centroid, force)});
        const double outward = is_a ? 1.0 : -1.0;
        for (int c = 0; c < count; ++c) {
            if (outward * t.normal_stress(corners[c]) >= tension || norm(t.shear_stress(corners[c])) >= shear)
                return true;
        }
    }
    return false;
}

/// Brings what the threads read to the host before they start: the first to ask would copy it from the device.
void on_the_host(const State& state)
{
    const Bodies& b = state.bodies;
    const Slots& s = state.slots;
    for (const Buffer<Vec3>* v :
         {&b.position, &b.velocity, &b.angular_velocity, &b.force, &b.torque, &s.force, &s.torque_a, &s.torque_b})
        v->host();
    b.orientation.host();
    state.contacts.point.host();
    state.pairs.contact.host();
}

bool passes(const State& state, int body, const Mat3& stress, const CleavageGate& gate)
{
    return gate(stress) || face_passes(state, body, gate);
}

GrainCleavage worst_plane(const Model& model, const State& state, int body, const CleavageRules& rules)
{
    LoadedGrain grain = loaded_grain(model, state, body);
    const GrainLoads loads = grain.loads();
    const Placement place = placement(state.bodies, body);
    const Quat crystal = state.bodies.crystal[body];
    const bool whole = state.bodies.generation[body] == 0;
    GrainCleavage found;
    int candidate = -1;
    for (std::size_t f = 0; f < rules.families.size(); ++f) {
        const CleavageFamily& family = rules.families[f];
        for (const Plane& in_crystal : family.planes) {
            ++candidate;
            if (!whole && in_crystal.offset != 0.0) continue;  // slabs are places within the undisturbed grain
            const Plane plane{rotate(crystal, in_crystal.normal), in_crystal.offset};
            const PlaneCut cut = cut_by_plane(grain.faces, plane, grain.size);
            if (cut.status != CutStatus::ok) continue;
            const PlaneTractions t = plane_tractions(cut, grain.motion, loads);
            const Cleavage c = rules.surface_flaws
                                   ? surface_flaw(family.law, t.field, cut.section.corners, cut.section.count)
                                   : buried_flaw(family.law, t.field, cut.section.corners, cut.section.count);
            const Vec3 n = rotate(place.orientation, plane.normal);
            const Plane in_space{n, plane.offset + dot(n, place.position)};
            if (c.f > found.worst.f) {
                found.worst = c;
                found.worst.where = place.to_space(c.where);
                found.family = static_cast<std::int32_t>(f);
                found.plane = in_space;
            }
            if (c.f <= found.nearest || (state.bodies.saturated[body] & candidate_bit(candidate)) != 0) continue;
            found.nearest = c.f;
            if (c.f >= 1.0) found.due = {body, in_space, family.split, candidate, c.K_I, c.K_II};
        }
    }
    return found;
}

const CleavageRules* rules_of(const State& state, int body, const std::vector<CleavageRules>& rules)
{
    if (state.bodies.inverse_mass[body] == 0.0) return nullptr;
    const auto group = static_cast<std::size_t>(state.bodies.group[body]);
    return group >= rules.size() || rules[group].families.empty() ? nullptr : &rules[group];
}

}  // namespace

std::vector<GrainCleavage> find_cleavage(const Model& model, const State& state,
                                         const std::vector<CleavageRules>& rules, const std::vector<int>& bodies)
{
    std::vector<GrainCleavage> found(bodies.size());
    struct Work {
        const Model& model;
        const State& state;
        const std::vector<CleavageRules>& rules;
        const std::vector<int>& bodies;
        std::vector<GrainCleavage>& found;

        void operator()(int begin, int end) const
        {
            for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
                found[k] = worst_plane(model, state, bodies[k], *rules_of(state, bodies[k], rules));
        }
    };
    const Work work{model, state, rules, bodies, found};
    on_the_host(state);
    const int n = static_cast<int>(bodies.size());
    if (threads() == 1 || n < least_for_threads) {
        work(0, n);
    } else {
        pool_detail::run([](const void* w, int begin, int end) { (*static_cast<const Work*>(w))(begin, end); }, &work,
                         n);
    }
    return found;
}

std::vector<GrainCleavage> find_cleavage(const Model& model, const State& state, const std::vector<Mat3>& stress,
                                         const std::vector<CleavageRules>& rules)
{
    std::vector<int> look;
    for (int i = 0; i < state.bodies.size(); ++i) {
        if (const CleavageRules* r = rules_of(state, i, rules);
            r != nullptr && passes(state, i, stress[static_cast<std::size_t>(i)], r->gate))
            look.push_back(i);
    }
    const std::vector<GrainCleavage> of_those = find_cleavage(model, state, rules, look);
    std::vector<GrainCleavage> found(static_cast<std::size_t>(state.bodies.size()));
    for (std::size_t k = 0; k < look.size(); ++k) found[static_cast<std::size_t>(look[k])] = of_those[k];
    return found;
}

namespace {

/// Grains that are to be looked at now, by their own plan.
std::vector<int> due_for_a_look(const State& state, const std::vector<CleavageRules>& rules)
{
    std::vector<int> due;
    for (int i = 0; i < state.bodies.size(); ++i) {
        if (state.bodies.next_look[i] <= state.step && rules_of(state, i, rules) != nullptr) due.push_back(i);
    }
    return due;
}

/// Steps between two looks that ask the gate.
std::int64_t interval(const std::vector<CleavageRules>& rules, double dt)
{
    double transit = 0.0;
    for (const CleavageRules& r : rules) {
        if (!r.families.empty() && (transit == 0.0 || r.pause < transit)) transit = r.pause;
    }
    return std::max<std::int64_t>(least_steps, std::llround(transits * transit / dt));
}

/// Those of `bodies` that the gate lets pass; the others are asked again when the gate is next.
std::vector<int> ask_the_gate(State& state, const std::vector<Mat3>& stress, const std::vector<CleavageRules>& rules,
                              const std::vector<int>& bodies, double dt)
{
    state.next_look = state.step + interval(rules, dt);
    std::vector<int> passing;
    Bodies& b = state.bodies;
    for (const int i : bodies) {
        if (passes(state, i, stress[static_cast<std::size_t>(i)], rules_of(state, i, rules)->gate)) {
            passing.push_back(i);
            continue;
        }
        b.cleavage_factor.at(i) = 0.0;
        b.last_look.at(i) = state.step;
        b.next_look.at(i) = state.next_look;
    }
    return passing;
}

/// Plans the next look at each of `bodies`, of which `found` is.
void plan_looks(State& state, const std::vector<int>& bodies, const std::vector<GrainCleavage>& found,
                const std::vector<CleavageRules>& rules, double dt)
{
    const std::int64_t unit = interval(rules, dt);
    Bodies& b = state.bodies;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        const int i = bodies[k];
        const double f = found[k].nearest, growth = f - b.cleavage_factor[i];
        const auto since = static_cast<double>(std::max<std::int64_t>(1, state.step - b.last_look[i]));
        double wait = static_cast<double>(unit);
        if (f < 1.0) {  // else it waits for the end of its pause, or for nothing
            const auto longest = static_cast<double>(most_intervals * unit);
            wait = f > 0.0 ? std::min(longest, patience * (1.0 / f - 1.0) * static_cast<double>(unit)) : longest;
            if (growth > 0.0) wait = std::min(wait, 0.5 * (1.0 - f) / growth * since);
        }
        b.cleavage_factor.at(i) = f;
        b.last_look.at(i) = state.step;
        b.next_look.at(i) = state.step + std::max<std::int64_t>(1, std::llround(wait));
    }
}

}  // namespace

std::vector<SplitRequest> splits_due(const State& state, const std::vector<GrainCleavage>& found,
                                     const std::vector<CleavageRules>& rules)
{
    std::vector<SplitRequest> due;
    for (const GrainCleavage& c : found) {
        const int i = c.due.body;
        if (i < 0) continue;
        const double last = state.bodies.split_time[i];
        if (last >= 0.0 && state.time - last < rules_of(state, i, rules)->pause) continue;
        due.push_back(c.due);
    }
    return due;
}

bool gate_is_due(const State& state)
{
    return state.step + 1 >= state.next_look;
}

std::vector<SplitRequest> look_for_splits(const Model& model, State& state, const std::vector<Mat3>* stress,
                                          const std::vector<CleavageRules>& rules, double dt)
{
    std::vector<int> look = due_for_a_look(state, rules);
    if (stress != nullptr) look = ask_the_gate(state, *stress, rules, look, dt);
    const std::vector<GrainCleavage> found = find_cleavage(model, state, rules, look);
    plan_looks(state, look, found, rules, dt);
    return splits_due(state, found, rules);
}

}  // namespace grainfrac
