// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/spheres.h"

#include "geometry/near_boxes.h"
#include "model/grain_body.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace grainfrac {

namespace {

struct SphereMass {
    double mass, inertia;
};

SphereMass mass_of(const SphereSpec& s, double density)
{
    if (s.section_radius > 0.0) {
        const double R = s.section_radius, m = density * std::numbers::pi * R * R * s.piece;
        return {m, m * (3.0 * R * R + s.piece * s.piece) / 12.0};  // about a diameter; spin about the axis is no matter
    }
    const double m = density * 4.0 / 3.0 * std::numbers::pi * s.radius * s.radius * s.radius;
    return {m, 0.4 * m * s.radius * s.radius};
}

/// Equal spheres share one shape.
int shape_of(Shapes& shapes, double radius)
{
    const int last = shapes.size() - 1;
    const bool same = last >= 0 && shapes.vertex_begin[last + 1] - shapes.vertex_begin[last] == 1 &&
                      shapes.radius[last] == radius && shapes.point_area[last] > 0.0;
    return same ? last : add_ball_shape(shapes, radius);
}

}  // namespace

int add_sphere(Model& model, State& state, const SphereSpec& s)
{
    Bodies& b = state.bodies;
    const int i = b.size();
    b.for_each_array([&](const char*, auto& array) { array.resize(i + 1); });
    model.grain_shapes.emplace_back();
    const double density = model.materials[static_cast<std::size_t>(s.material)].density;
    const auto [mass, inertia] = mass_of(s, density);
    b.id.at(i) = b.origin.at(i) = i;
    b.position.at(i) = b.start_position.at(i) = s.position;
    b.velocity.at(i) = s.velocity;
    b.mass.at(i) = mass;
    b.inverse_mass.at(i) = 1.0 / mass;
    b.inertia.at(i) = {inertia, inertia, inertia};
    b.inverse_inertia.at(i) = {1.0 / inertia, 1.0 / inertia, 1.0 / inertia};
    set_spin(b, i, s.angular_velocity);
    b.shape.at(i) = shape_of(model.shapes, s.radius);
    b.group.at(i) = s.group;
    b.wall.at(i) = b.parent.at(i) = -1;
    b.split_time.at(i) = -1.0;
    b.origin_volume.at(i) = mass / density;
    return i;
}

std::vector<std::pair<int, int>> touching_spheres(const std::vector<SphereSpec>& spheres, double gap_factor)
{
    std::vector<Box> boxes;
    boxes.reserve(spheres.size());
    for (const SphereSpec& s : spheres) {
        const double r = s.radius * (1.0 + gap_factor);
        boxes.push_back({s.position - Vec3{r, r, r}, s.position + Vec3{r, r, r}});
    }
    std::vector<std::pair<int, int>> pairs = overlapping_boxes(boxes);
    std::erase_if(pairs, [&](const std::pair<int, int>& p) {
        const SphereSpec &x = spheres[static_cast<std::size_t>(p.first)],
                         &y = spheres[static_cast<std::size_t>(p.second)];
        return norm(y.position - x.position) > (1.0 + gap_factor) * (x.radius + y.radius);
    });
    return pairs;
}

BondSprings circular_bond(double normal_stiffness, double shear_stiffness, double radius, bool moments)
{
    const CircularSection s(radius);
    return {normal_stiffness * s.area, shear_stiffness * s.area, moments ? normal_stiffness * s.bending : 0.0,
            moments ? shear_stiffness * s.polar : 0.0};
}

void add_sphere_bond(Model& model, State& state, const SpherePair& pair)
{
    SphereBonds& p = state.sphere_bonds;
    const Bodies& b = state.bodies;
    const int n = p.size();
    p.for_each_array([&](const char*, auto& array) { array.resize(n + 1); });
    p.a.at(n) = pair.a;
    p.b.at(n) = pair.b;
    p.law.at(n) = pair.law;
    const double ra = model.shapes.radius[b.shape[pair.a]], rb = model.shapes.radius[b.shape[pair.b]];
    const Vec3 branch = b.position[pair.b] - b.position[pair.a];
    p.kind.at(n) = n;
    p.kinds.at(n) = {ra / (ra + rb),     norm(branch),
                     pair.radius,        pair.springs.normal,
                     pair.springs.shear, pair.springs.bending,
                     pair.springs.twist, conjugate(b.orientation[pair.a]) * b.orientation[pair.b]};
    p.strength_factor.at(n) = pair.strength;
    p.axis_a.at(n) = rotate_back(b.orientation[pair.a], normalized(branch));
    p.normal.at(n) = normalized(branch);
    p.failure_time.at(n) = -1.0;
}

namespace {

/// One entry for kinds of the same bits.
void merge_kinds(SphereBonds& bonds)
{
    const std::vector<SphereBondKind> all = bonds.kinds.host();
    const auto before = [&](int i, int j) {
        return std::memcmp(&all[static_cast<std::size_t>(i)], &all[static_cast<std::size_t>(j)], sizeof all[0]) < 0;
    };
    std::map<int, std::int32_t, decltype(before)> number(before);
    std::vector<SphereBondKind> different;
    for (std::int32_t& kind : bonds.kind.host()) {
        const auto [found, is_new] = number.emplace(kind, static_cast<std::int32_t>(different.size()));
        if (is_new) different.push_back(all[static_cast<std::size_t>(kind)]);
        kind = found->second;
    }
    different.shrink_to_fit();
    bonds.kinds.host() = std::move(different);
}

}  // namespace

void settle(const Model& model, SphereBonds& bonds)
{
    merge_kinds(bonds);
    bool total = false, incremental = false, damped = false;
    for (const SphereBondLaw& law : model.sphere_bond_laws.host()) {
        (law.incremental ? incremental : total) = true;
        damped = damped || law.damping > 0.0;
    }
    const auto keep = [](bool needed, auto&... arrays) {
        if (!needed) ((arrays = {}), ...);
    };
    keep(total, bonds.axis_a);
    keep(incremental, bonds.shear_force, bonds.moment, bonds.twist, bonds.normal);
    keep(damped, bonds.viscous_force, bonds.viscous_moment);
}

}  // namespace grainfrac
