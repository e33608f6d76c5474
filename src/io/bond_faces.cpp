// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bond_faces.h"

#include <cmath>
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

}  // namespace

BondFace interface_face(const State& state, int i)
{
    const InterfaceBonds& bonds = state.interfaces;
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
        const Vec3 jump = to_world(state.bodies, b, state.points.position_b[q]) -
                          to_world(state.bodies, a, state.points.position_a[q]);
        face.opening += state.points.weight[q] * dot(jump, face.normal);
        weight += state.points.weight[q];
    }
    if (weight > 0.0) face.opening /= weight;
    return face;
}

BondFace parallel_face(const State& state, int i)
{
    const ParallelBonds& bonds = state.parallels;
    const int a = bonds.a[i], b = bonds.b[i];
    const Vec3 on_a = to_world(state.bodies, a, bonds.position_a[i]);
    const Vec3 on_b = to_world(state.bodies, b, bonds.position_b[i]);
    const double radius = bonds.radius[i];
    BondFace face;
    face.normal = mean_normal(state.bodies, a, b, bonds.normal_a[i], bonds.normal_b[i]);
    face.opening = dot(on_b - on_a, face.normal);
    face.area = std::numbers::pi * radius * radius;
    const Vec3 center = 0.5 * (on_a + on_b);
    const Vec3 first = any_perpendicular(face.normal), second = cross(face.normal, first);
    for (int k = 0; k < disc_corners; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / disc_corners;
        face.polygon.push_back(center + radius * (std::cos(angle) * first + std::sin(angle) * second));
    }
    return face;
}

CrackCause interface_cause(const InterfaceBonds& bonds, int i)
{
    if (bonds.failure_time[i] < 0.0) return CrackCause::none;
    const double damaged_area = bonds.damage[i] * bonds.area[i];
    const double share = damaged_area > 0.0 ? bonds.shear_share[i] / damaged_area : 0.0;
    if (share < tension_share) return CrackCause::tension;
    return share > shear_share ? CrackCause::shear : CrackCause::mixed;
}

CrackCause parallel_cause(const ParallelBonds& bonds, int i)
{
    if (bonds.cause[i] == 0) return CrackCause::none;
    return bonds.cause[i] == 2 ? CrackCause::shear : CrackCause::tension;
}

BondStage interface_stage(const InterfaceBonds& bonds, int i)
{
    if (bonds.retired[i] != 0) return BondStage::retired;
    if (bonds.failure_time[i] >= 0.0) return BondStage::broken;
    return bonds.damage[i] > 0.0 ? BondStage::damaged : BondStage::whole;
}

BondStage parallel_stage(const ParallelBonds& bonds, int i)
{
    return bonds.cause[i] == 0 ? BondStage::whole : BondStage::broken;
}

std::vector<double> mean_bond_damage(const State& state)
{
    const auto n = static_cast<std::size_t>(state.bodies.size());
    std::vector<double> damaged(n, 0.0), whole(n, 0.0);
    const auto add = [&](int body, double area, double damage) {
        damaged[static_cast<std::size_t>(body)] += area * damage;
        whole[static_cast<std::size_t>(body)] += area;
    };
    for (int i = 0; i < state.interfaces.size(); ++i) {
        for (const int body : {state.interfaces.a[i], state.interfaces.b[i]})
            add(body, state.interfaces.area[i], state.interfaces.damage[i]);
    }
    for (int i = 0; i < state.parallels.size(); ++i) {
        const double radius = state.parallels.radius[i];
        for (const int body : {state.parallels.a[i], state.parallels.b[i]})
            add(body, std::numbers::pi * radius * radius, state.parallels.cause[i] != 0 ? 1.0 : 0.0);
    }
    for (std::size_t i = 0; i < n; ++i) damaged[i] = whole[i] > 0.0 ? damaged[i] / whole[i] : 0.0;
    return damaged;
}

}  // namespace grainfrac
