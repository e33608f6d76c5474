// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/split_grains.h"

#include "contact/contact_forces.h"
#include "contact/find_contacts.h"
#include "contact/find_pairs.h"
#include "contact/gather.h"
#include "fracture/bond_forces.h"
#include "fracture/parting.h"
#include "fracture/plane_tractions.h"
#include "fracture/split_bonds.h"
#include "fracture/split_contacts.h"
#include "geometry/cut.h"
#include "geometry/mass_properties.h"
#include "model/grain_body.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace grainfrac {

namespace {

struct Parts {
    SplitStatus status = SplitStatus::outside;
    CutResult cut;  // in the frame of the body
};

Parts cut_grain(const Model& model, const State& state, const SplitRequest& r)
{
    const Bodies& b = state.bodies;
    const Polyhedron& grain = model.grain_shapes.at(static_cast<std::size_t>(r.body));
    Parts p;
    if (b.generation[r.body] >= r.rules.most_generations) {
        p.status = SplitStatus::generation;
        return p;
    }
    const Vec3 n = rotate_back(b.orientation[r.body], r.plane.normal);
    p.cut = cut_exact(grain, {n, r.plane.offset - dot(r.plane.normal, b.position[r.body])});
    p.status = why_not_parted(grain, p.cut, model.shapes.radius[b.shape[r.body]], b.origin_volume[r.body], r.rules);
    return p;
}

/// Body i becomes the part (given in the frame that the grain had) with the grain's motion.
void become_part(Model& model, State& state, int i, const Parting& p, const Polyhedron& part, double density)
{
    Bodies& b = state.bodies;
    const int parent = p.request.body;
    const Placement at_start{b.start_position[parent], b.start_orientation[parent]};
    const double rho = model.shapes.radius[b.shape[parent]];
    const Quat crystal = b.crystal[parent];
    const PrincipalFrame frame = set_grain_shape(model, b, i, part, p.before, density, rho);
    b.velocity.at(i) = p.velocity + cross(p.angular_velocity, b.position[i] - p.before.position);
    set_spin(b, i, p.angular_velocity);
    b.start_position.at(i) = at_start.to_space(frame.centroid);
    b.start_orientation.at(i) = normalized(at_start.orientation * frame.axes);
    b.crystal.at(i) = normalized(conjugate(frame.axes) * crystal);
}

void make_bodies(Model& model, State& state, Parting& p, const CutResult& cut)
{
    Bodies& b = state.bodies;
    const int parent = p.request.body, fresh = b.size();
    std::int32_t next_id = 0;
    for (int i = 0; i < fresh; ++i) next_id = std::max(next_id, b.id[i] + 1);
    b.for_each_array([&](const char*, auto& array) { array.resize(fresh + 1); });
    model.grain_shapes.emplace_back();
    p.part_1 = fresh;
    b.group.at(fresh) = b.group[parent];
    b.wall.at(fresh) = -1;
    b.origin.at(fresh) = b.origin[parent];
    b.origin_volume.at(fresh) = b.origin_volume[parent];
    b.generation.at(fresh) = b.generation[parent] + 1;
    b.parent.at(fresh) = b.id[parent];
    b.id.at(fresh) = next_id;
    const double density = p.mass / mass_properties(model.grain_shapes[static_cast<std::size_t>(parent)]).volume;
    // part 1 first: part 2 overwrites what both start from
    become_part(model, state, fresh, p, cut.outside, density);
    become_part(model, state, parent, p, cut.inside, density);
    b.split_time.at(fresh) = b.split_time.at(parent) = state.time;
    b.saturated.at(fresh) = b.saturated.at(parent) = 0;  // other shapes, other limits
    b.cleavage_factor.at(fresh) = b.cleavage_factor.at(parent) = 0.0;
    b.last_look.at(fresh) = b.last_look.at(parent) = state.step;
    b.next_look.at(fresh) = b.next_look.at(parent) = state.step + 1;
    b.generation.at(parent) = b.generation[fresh];
    b.parent.at(parent) = b.parent[fresh];
    b.id.at(parent) = next_id + 1;
}

/// Forces of all slots, before the arrays are sorted anew.
struct OldSlots {
    std::vector<Vec3> force, torque_a, torque_b;
    int interfaces = 0;
};

OldSlots slots_now(const State& state)
{
    OldSlots old;
    const Slots& s = state.slots;
    old.force = s.force.host();
    old.torque_a = s.torque_a.host();
    old.torque_b = s.torque_b.host();
    old.interfaces = state.interfaces.size();
    return old;
}

/// Forces back into the slots of bonds that were not touched; nothing in the others. find_pairs did it for contacts.
void restore_slots(State& state, const OldSlots& old, const std::vector<int>& interfaces,
                   const std::vector<int>& parallels)
{
    Slots& s = state.slots;
    auto &force = s.force.host(), &torque_a = s.torque_a.host(), &torque_b = s.torque_b.host();
    const auto put = [&](std::size_t slot, int source) {
        const bool known = source >= 0;
        const auto k = static_cast<std::size_t>(known ? source : 0);
        force[slot] = known ? old.force[k] : Vec3{};
        torque_a[slot] = known ? old.torque_a[k] : Vec3{};
        torque_b[slot] = known ? old.torque_b[k] : Vec3{};
    };
    std::size_t slot = 0;
    for (const int source : interfaces) put(slot++, source);
    for (const int source : parallels) put(slot++, old.interfaces + source);
    const int first_sphere = old.interfaces + static_cast<int>(parallels.size());  // a split touches none of these
    for (int i = 0; i < state.sphere_bonds.size(); ++i) put(slot++, first_sphere + i);
}

/// What acts on the parts, or may.
struct Touched {
    std::vector<int> interfaces, parallels, sphere_bonds, pairs, bodies;
};

Touched touched_by(const State& state, const std::vector<Parting>& partings)
{
    std::vector<char> is_part(static_cast<std::size_t>(state.bodies.size()), 0), concerned = is_part;
    for (const Parting& p : partings)
        is_part[static_cast<std::size_t>(p.request.body)] = is_part[static_cast<std::size_t>(p.part_1)] = 1;
    const auto list = [&](const auto& pairs) {
        std::vector<int> found;
        for (int i = 0; i < pairs.size(); ++i) {
            const auto a = static_cast<std::size_t>(pairs.a[i]), b = static_cast<std::size_t>(pairs.b[i]);
            if (is_part[a] == 0 && is_part[b] == 0) continue;
            found.push_back(i);
            concerned[a] = concerned[b] = 1;
        }
        return found;
    };
    Touched t{list(state.interfaces), list(state.parallels), list(state.sphere_bonds), list(state.pairs), {}};
    for (std::size_t i = 0; i < concerned.size(); ++i) {
        if (concerned[i] != 0) t.bodies.push_back(static_cast<int>(i));
    }
    return t;
}

void bring_up_to_date(const Model& model, State& state, const Touched& t)
{
    std::vector<int> contacts;
    for (const int pair : t.pairs) {
        if (state.pairs.contact[pair] >= 0) contacts.push_back(state.pairs.contact[pair]);
    }
    contact_forces(model, state, contacts);
    bond_forces(model, state, t.interfaces, t.parallels, t.sphere_bonds);
    gather_forces(model, state, t.bodies);
}

/// The traction that the plane carried: §12, from the loads on part 1 as they are shared out now. On part 2, at the
/// points of the surface [Pa].
std::vector<Vec3> tractions(const State& state, const Parting& p, const CutSurface& s)
{
    const Bodies& b = state.bodies;
    const int one = p.part_1, two = p.request.body;
    // the grain's acceleration from all loads on both parts
    const Vec3 c = p.before.position, force = b.force[one] + b.force[two];
    const Vec3 torque = b.torque[one] + b.torque[two] + cross(b.position[one] - c, b.force[one]) +
                        cross(b.position[two] - c, b.force[two]);
    const Quat q = p.before.orientation;
    const Vec3 w = p.angular_velocity;
    const Vec3 w_rate = rotate(q, angular_acceleration(p.inertia, rotate_back(q, w), rotate_back(q, torque)));

    const Vec3 r = b.position[one] - c;
    const Vec3 a_1 = force / p.mass + cross(w_rate, r) + cross(w, cross(w, r));
    const Quat q1 = b.orientation[one];
    const auto by_inertia = [&](const Vec3& v) {
        const Vec3 x = rotate_back(q1, v), J = b.inertia[one];
        return rotate(q1, {J.x * x.x, J.y * x.y, J.z * x.z});
    };
    const PlaneMoments m = plane_moments(s.polygon.data(), static_cast<int>(s.polygon.size()), s.normal);
    // F*, M*: part 2 on part 1, about the centroid of the plane
    const Vec3 F = b.mass[one] * a_1 - b.force[one];
    const Vec3 M =
        by_inertia(w_rate) + cross(w, by_inertia(w)) - b.torque[one] + cross(b.position[one] - m.centroid, F);

    // it acts on part 2; the quadrature integrates its products with the arms exactly
    const TractionField field = fit_tractions(m, {-F, -M});
    std::vector<Vec3> at_points;
    for (const QuadraturePoint& q_point : s.points) at_points.push_back(field.at(q_point.position));
    return at_points;
}

}  // namespace

const char* to_string(SplitStatus status)
{
    switch (status) {
        case SplitStatus::done:
            return "done";
        case SplitStatus::generation:
            return "split too often";
        case SplitStatus::small_part:
            return "a part would be too small";
        case SplitStatus::thin_part:
            return "a part would be too thin";
        case SplitStatus::small_section:
            return "the plane only chips the grain";
        case SplitStatus::outside:
            return "the plane misses the grain";
        case SplitStatus::degenerate:
            return "the cut is not clean";
    }
    return "";
}

SplitStatus why_not_parted(const Polyhedron& grain, const CutResult& cut, double radius, double whole_volume,
                           const SplitRules& rules)
{
    if (cut.status == CutStatus::all_inside || cut.status == CutStatus::all_outside) return SplitStatus::outside;
    if (cut.status != CutStatus::ok) return SplitStatus::degenerate;
    for (const Polyhedron* part : {&cut.inside, &cut.outside}) {
        if (mass_properties(*part).volume < rules.least_volume * whole_volume) return SplitStatus::small_part;
        if (inscribed_ball(*part).radius < rules.least_inradius * radius) return SplitStatus::thin_part;
    }
    if (norm(area_vector(cut.section)) < rules.least_section * surface_area(grain)) return SplitStatus::small_section;
    return SplitStatus::done;
}

SplitStatus why_not_split(const Model& model, const State& state, const SplitRequest& request)
{
    return cut_grain(model, state, request).status;
}

std::vector<SplitReport> split_grains(Model& model, State& state, std::vector<SplitRequest> requests)
{
    std::sort(requests.begin(), requests.end(),
              [](const SplitRequest& x, const SplitRequest& y) { return x.body < y.body; });
    std::vector<SplitReport> reports;
    std::vector<Parting> partings;
    std::vector<CutResult> cuts;
    std::vector<std::size_t> report_of;
    const Bodies& b = state.bodies;
    for (const SplitRequest& r : requests) {
        if (!reports.empty() && reports.back().body == r.body)
            throw std::logic_error("split_grains: two planes for one grain");
        SplitReport report;
        report.body = r.body;
        report.parent_id = b.id[r.body];
        Parts parts = cut_grain(model, state, r);
        report.status = parts.status;
        if (parts.status == SplitStatus::done) {
            Parting p;
            p.request = r;
            p.before = placement(b, r.body);
            p.mass = b.mass[r.body];
            p.inertia = b.inertia[r.body];
            p.velocity = b.velocity[r.body];
            p.angular_velocity = b.angular_velocity[r.body];
            p.on_plane = point_on_plane_tolerance * bounding_size(model.grain_shapes[static_cast<std::size_t>(r.body)]);
            for (const Vec3& x : parts.cut.section) p.section.push_back(p.before.to_space(x));
            report.area = norm(area_vector(p.section));
            partings.push_back(std::move(p));
            cuts.push_back(std::move(parts.cut));
            report_of.push_back(reports.size());
        } else {
            const bool for_good = parts.status == SplitStatus::generation;
            state.bodies.saturated.at(r.body) |= for_good ? ~std::int64_t{0} : candidate_bit(r.candidate);
        }
        reports.push_back(report);
    }
    if (partings.empty()) return reports;

    state.slots.dyad_a.resize(0);  // of the interactions that were; the next step that is asked for stresses makes room
    state.slots.dyad_b.resize(0);
    const OldSlots slots = slots_now(state);
    const std::vector<OldContact> contacts = take_contacts(state, partings);
    for (std::size_t k = 0; k < partings.size(); ++k) {
        make_bodies(model, state, partings[k], cuts[k]);
        reports[report_of[k]].new_body = partings[k].part_1;
    }
    std::vector<CutSurface> surfaces;
    for (const Parting& p : partings) surfaces.push_back(surface_of(p));
    const std::vector<int> interfaces = divide_interfaces(model, state, partings, surfaces);
    const std::vector<int> parallels = divide_parallel_bonds(state, partings);
    find_pairs(model, state);
    restore_slots(state, slots, interfaces, parallels);
    const Touched touched = touched_by(state, partings);
    find_contacts(model, state, touched.pairs);
    const std::vector<int> given = give_contacts(model, state, partings, contacts);
    // what they hold, or lose at once to a tighter cap, is put in without work
    const auto held_and_lost = [&](int i) {
        const Contacts& c = state.contacts;
        return c.stored_energy[i] + c.friction_work[i] + c.hysteresis_work[i];
    };
    for (const int i : given) state.contacts.inserted_work.at(i) -= held_and_lost(i);
    bring_up_to_date(model, state, touched);
    for (const int i : given) state.contacts.inserted_work.at(i) += held_and_lost(i);

    // the new surfaces carry nothing yet: the forces are those of the loads on the parts
    std::vector<std::vector<Vec3>> carried;
    for (std::size_t k = 0; k < surfaces.size(); ++k) carried.push_back(tractions(state, partings[k], surfaces[k]));
    Touched parts;
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
        load_surface(model, state, surfaces[k], carried[k]);
        parts.interfaces.push_back(surfaces[k].interface);
        parts.bodies.insert(parts.bodies.end(), {surfaces[k].a, surfaces[k].b});
        reports[report_of[k]].inserted_energy = state.interfaces.inserted_work[surfaces[k].interface];
    }
    bring_up_to_date(model, state, parts);
    return reports;
}

}  // namespace grainfrac
