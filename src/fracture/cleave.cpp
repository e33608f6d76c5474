// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/cleave.h"

#include "fracture/plane_tractions.h"
#include "gpu/thread_pool.h"
#include "model/grain_body.h"

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

/// Bodies per share of work that a thread takes at once is the pool's; fewer than this are done by the caller.
constexpr int least_for_threads = 64;
/// The latest next look: after this many steps, or this share of the time that a wave takes through a grain if that is
/// more. Small fragments make small steps, but stresses change no faster.
constexpr std::int64_t most_steps = 20;
constexpr double most_transits = 1.0;

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

    const int begin = state.incidence.begin[body], end = state.incidence.begin[body + 1];
    g.corners.reserve(static_cast<std::size_t>(end - begin));
    for (int k = begin; k < end; ++k) {
        const int entry = state.incidence.entry[k], slot = entry / 2;
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
        const int slot = state.incidence.entry[k] / 2;
        if (slot >= f.size()) break;  // interfaces come first
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

std::vector<GrainCleavage> find_cleavage(const Model& model, const State& state, const std::vector<Mat3>& stress,
                                         const std::vector<CleavageRules>& rules)
{
    std::vector<GrainCleavage> found(static_cast<std::size_t>(state.bodies.size()));
    std::vector<int> look;
    for (int i = 0; i < state.bodies.size(); ++i) {
        const CleavageRules* r = rules_of(state, i, rules);
        if (r != nullptr && (r->gate(stress[static_cast<std::size_t>(i)]) || face_passes(state, i, r->gate)))
            look.push_back(i);
    }
    struct Work {
        const Model& model;
        const State& state;
        const std::vector<CleavageRules>& rules;
        const std::vector<int>& look;
        std::vector<GrainCleavage>& found;

        void operator()(int begin, int end) const
        {
            for (int k = begin; k < end; ++k) {
                const int i = look[static_cast<std::size_t>(k)];
                found[static_cast<std::size_t>(i)] = worst_plane(model, state, i, *rules_of(state, i, rules));
            }
        }
    };
    const Work work{model, state, rules, look, found};
    const int n = static_cast<int>(look.size());
    if (threads() == 1 || n < least_for_threads) {
        work(0, n);
    } else {
        pool_detail::run([](const void* w, int begin, int end) { (*static_cast<const Work*>(w))(begin, end); }, &work,
                         n);
    }
    return found;
}

void plan_next_look(State& state, const std::vector<GrainCleavage>& found, const std::vector<CleavageRules>& rules,
                    double dt)
{
    double transit = 0.0;
    for (const CleavageRules& r : rules) {
        if (!r.families.empty() && (transit == 0.0 || r.pause < transit)) transit = r.pause;
    }
    std::int64_t wait = std::max<std::int64_t>(most_steps, std::llround(most_transits * transit / dt));
    const auto since = static_cast<double>(std::max<std::int64_t>(1, state.step - state.last_look));
    auto& before = state.bodies.cleavage_factor.host();
    for (std::size_t i = 0; i < found.size(); ++i) {
        const double now = found[i].nearest, growth = now - before[i];
        before[i] = now;
        if (now < 1.0 && growth > 0.0)
            wait = std::min(wait, std::max<std::int64_t>(1, std::llround(0.5 * (1.0 - now) / growth * since)));
    }
    state.last_look = state.step;
    state.next_look = state.step + wait;
}

std::vector<SplitRequest> splits_due(const State& state, const std::vector<GrainCleavage>& found,
                                     const std::vector<CleavageRules>& rules)
{
    std::vector<SplitRequest> due;
    for (int i = 0; i < state.bodies.size(); ++i) {
        const SplitRequest& request = found[static_cast<std::size_t>(i)].due;
        if (request.body < 0) continue;
        const double last = state.bodies.split_time[i];
        if (last >= 0.0 && state.time - last < rules_of(state, i, rules)->pause) continue;
        due.push_back(request);
    }
    return due;
}

}  // namespace grainfrac
