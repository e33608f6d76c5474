// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bond_faces.h"

#include "fracture/parallel_law.h"
#include "geometry/polyhedron.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace grainfrac {

namespace {

/// Thirds, so that "mixed" is what neither mode dominates by two to one.
constexpr double tension_share = 1.0 / 3.0, shear_share = 2.0 / 3.0;  // [-]
constexpr int disc_corners = 16;

Vec3 to_world(const Bodies& bodies, int body, const Vec3& point)
{
    return bodies.position[body] + rotate(bodies.orientation[body], point);
}

Vec3 mean_normal(const Bodies& bodies, int a, int b, const Vec3& normal_a, const Vec3& normal_b)
{
    return normalized(rotate(bodies.orientation[a], normal_a) + rotate(bodies.orientation[b], normal_b));
}

void draw_disc(BondFace& face)
{
    const double radius = std::sqrt(face.area / std::numbers::pi);
    const Vec3 first = any_perpendicular(face.normal), second = cross(face.normal, first);
    for (int k = 0; k < disc_corners; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / disc_corners;
        face.polygon.push_back(face.center + radius * (std::cos(angle) * first + std::sin(angle) * second));
    }
}

BondFace face_of(const State& state, const InterfaceBonds& bonds, int i)
{
    const int a = bonds.a[i], b = bonds.b[i];
    BondFace face;
    face.normal = mean_normal(state.bodies, a, b, bonds.normal_a[i], bonds.normal_b[i]);
    face.area = bonds.area[i];
    for (int c = bonds.corner_begin[i]; c < bonds.corner_begin[i + 1]; ++c) {
        const Vec3 on_a = to_world(state.bodies, a, state.corners.position_a[c]);
        const Vec3 on_b = to_world(state.bodies, b, state.corners.position_b[c]);
        face.polygon.push_back(0.5 * (on_a + on_b));
    }
    double weight = 0.0;
    for (int q = bonds.point_begin[i]; q < bonds.point_begin[i + 1]; ++q) {
        const Vec3 on_a = to_world(state.bodies, a, state.points.position_a[q]);
        const Vec3 on_b = to_world(state.bodies, b, state.points.position_b[q]);
        face.opening += state.points.weight[q] * dot(on_b - on_a, face.normal);
        face.center += (0.5 * state.points.weight[q]) * (on_a + on_b);
        weight += state.points.weight[q];
    }
    if (weight > 0.0) {
        face.opening /= weight;
        face.center *= 1.0 / weight;
    }
    if (face.polygon.size() >= 3) {
        face.center = polygon_centroid(face.polygon);
    } else {
        face.polygon.clear();
        draw_disc(face);  // a patch of a fibre's surface has no corners
    }
    return face;
}

BondFace face_of(const State& state, const ParallelBonds& bonds, int i)
{
    const int a = bonds.a[i], b = bonds.b[i];
    const Vec3 on_a = to_world(state.bodies, a, bonds.position_a[i]);
    const Vec3 on_b = to_world(state.bodies, b, bonds.position_b[i]);
    BondFace face;
    face.normal = mean_normal(state.bodies, a, b, bonds.normal_a[i], bonds.normal_b[i]);
    face.opening = dot(on_b - on_a, face.normal);
    face.area = CircularSection(bonds.radius[i]).area;
    face.center = 0.5 * (on_a + on_b);
    draw_disc(face);
    return face;
}

BondFace face_of(const State& state, const SphereBonds& bonds, int i)
{
    const Vec3 from = state.bodies.position[bonds.a[i]], branch = state.bodies.position[bonds.b[i]] - from;
    BondFace face;
    face.normal = normalized(branch);
    const SphereBondKind& kind = bonds.kind_of(i);
    face.opening = norm(branch) - kind.length;
    face.area = CircularSection(kind.radius).area;
    face.center = from + kind.share * branch;
    draw_disc(face);
    return face;
}

CrackCause cause_of(const InterfaceBonds& bonds, int i)
{
    if (bonds.failure_time[i] < 0.0) return CrackCause::none;
    const double damaged_area = bonds.damage[i] * bonds.area[i];
    const double share = damaged_area > 0.0 ? bonds.shear_share[i] / damaged_area : 0.0;
    if (share < tension_share) return CrackCause::tension;
    return share > shear_share ? CrackCause::shear : CrackCause::mixed;
}

BondStage stage_of(const InterfaceBonds& bonds, int i)
{
    if (bonds.retired[i] != 0) return BondStage::retired;
    if (bonds.failure_time[i] >= 0.0) return BondStage::broken;
    return bonds.damage[i] > 0.0 ? BondStage::damaged : BondStage::whole;
}

BondFacts facts_of(const InterfaceBonds& bonds, int i)
{
    BondFacts f;
    f.a = bonds.a[i];
    f.b = bonds.b[i];
    f.stage = stage_of(bonds, i);
    f.cause = cause_of(bonds, i);
    f.area = bonds.area[i];
    f.damage = bonds.damage[i];
    f.normal_stiffness = bonds.normal_stiffness[i];
    f.shear_stiffness = bonds.shear_stiffness[i];
    f.stored_energy = bonds.stored_energy[i];
    f.fracture_work = bonds.fracture_work[i];
    f.first_damage_time = bonds.first_damage_time[i];
    f.failure_time = bonds.failure_time[i];
    f.transgranular = bonds.transgranular[i] != 0;
    f.K_I = bonds.K_I[i];
    f.K_II = bonds.K_II[i];
    return f;
}

/// What breaks at once: parallel bonds and bonds of spheres. `size` has their radius and stiffnesses, `section` makes
/// these ones per area.
template <class Bonds>
BondFacts facts_of_circle(BondKind kind, const Bonds& bonds, int i, const SphereBondKind& size, double section)
{
    BondFacts f;
    f.kind = kind;
    f.a = bonds.a[i];
    f.b = bonds.b[i];
    const bool whole = bonds.cause[i] == static_cast<int>(BondCause::whole);
    f.stage = whole ? BondStage::whole : BondStage::broken;
    const bool sheared = bonds.cause[i] == static_cast<int>(BondCause::shear);
    if (!whole) f.cause = sheared ? CrackCause::shear : CrackCause::tension;
    f.radius = size.radius;
    f.area = CircularSection(f.radius).area;
    f.damage = whole ? 0.0 : 1.0;
    f.normal_stiffness = size.normal_stiffness / section;
    f.shear_stiffness = size.shear_stiffness / section;
    f.stored_energy = bonds.stored_energy[i];
    f.fracture_work = bonds.fracture_work[i];
    f.first_damage_time = f.failure_time = bonds.failure_time[i];
    return f;
}

BondFacts facts_of(const ParallelBonds& bonds, int i)
{
    SphereBondKind size;
    size.radius = bonds.radius[i];
    size.normal_stiffness = bonds.normal_stiffness[i];
    size.shear_stiffness = bonds.shear_stiffness[i];
    return facts_of_circle(BondKind::parallel, bonds, i, size, 1.0);
}

BondFacts facts_of(const SphereBonds& bonds, int i)
{
    const SphereBondKind& size = bonds.kind_of(i);
    return facts_of_circle(BondKind::sphere, bonds, i, size, CircularSection(size.radius).area);
}

/// visit(bonds, i) for the bond in a slot.
template <class Visit>
void at_slot(const State& state, int slot, Visit&& visit)
{
    state.for_each_bond_kind([&](const auto& bonds, int first) {
        if (slot >= first && slot < first + bonds.size()) visit(bonds, slot - first);
    });
}

}  // namespace

BondFacts bond_facts(const State& state, int slot)
{
    BondFacts facts;
    at_slot(state, slot, [&](const auto& bonds, int i) { facts = facts_of(bonds, i); });
    return facts;
}

std::vector<BondFacts> all_bond_facts(const State& state)
{
    std::vector<BondFacts> facts;
    facts.reserve(static_cast<std::size_t>(state.bond_slots()));
    state.for_each_bond_kind([&](const auto& bonds, int) {
        for (int i = 0; i < bonds.size(); ++i) facts.push_back(facts_of(bonds, i));
    });
    return facts;
}

BondFace bond_face(const State& state, int slot)
{
    BondFace face;
    at_slot(state, slot, [&](const auto& bonds, int i) { face = face_of(state, bonds, i); });
    return face;
}

BondLoad bond_load(const State& state, int slot, const BondFacts& facts, const BondFace& face)
{
    BondLoad load;
    load.peak_normal_stress = load.peak_shear_stress = std::numeric_limits<double>::quiet_NaN();
    if (slot >= state.slots.size() || !(face.area > 0.0)) return load;
    const Vec3 on_b = state.slots.force[slot];
    const Vec3 moment = state.slots.torque_b[slot] - cross(face.center - state.bodies.position[facts.b], on_b);
    load.normal_force = -dot(on_b, face.normal);
    load.shear_force = norm(tangential(on_b, face.normal));
    load.bending_moment = norm(tangential(moment, face.normal));
    load.twisting_moment = std::fabs(dot(moment, face.normal));
    load.normal_stress = load.normal_force / face.area;
    load.shear_stress = load.shear_force / face.area;
    if (facts.radius > 0.0) {
        const CircularSection s(facts.radius);
        load.peak_normal_stress = load.normal_stress + load.bending_moment * facts.radius / s.bending;
        load.peak_shear_stress = load.shear_stress + load.twisting_moment * facts.radius / s.polar;
    }
    return load;
}

std::vector<double> mean_bond_damage(const State& state)
{
    const auto n = static_cast<std::size_t>(state.bodies.size());
    std::vector<double> damaged(n, 0.0), whole(n, 0.0);
    for (int slot = 0; slot < state.bond_slots(); ++slot) {
        const BondFacts f = bond_facts(state, slot);
        for (const std::int32_t body : {f.a, f.b}) {
            damaged[static_cast<std::size_t>(body)] += f.area * f.damage;
            whole[static_cast<std::size_t>(body)] += f.area;
        }
    }
    for (std::size_t i = 0; i < n; ++i) damaged[i] = whole[i] > 0.0 ? damaged[i] / whole[i] : 0.0;
    return damaged;
}

}  // namespace grainfrac
