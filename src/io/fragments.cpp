// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/fragments.h"

#include "fracture/cleavage.h"
#include "geometry/mass_properties.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace grainfrac {

namespace {

double density(const Model& model, int group)
{
    const std::int32_t material = model.groups.at(static_cast<std::size_t>(group)).material;
    return material < 0 ? 0.0 : model.materials.at(static_cast<std::size_t>(material)).density;
}

/// Second moments of the mass about the principal axes, from the moments of inertia [kg m^2].
Vec3 second_moments(const Vec3& inertia)
{
    const double half = 0.5 * (inertia.x + inertia.y + inertia.z);
    return {half - inertia.x, half - inertia.y, half - inertia.z};
}

/// An ellipsoid of semi-axes a_i has the second moments m a_i^2/5.
Vec3 ellipsoid_axes(double mass, const Mat3& moments)
{
    const Vec3 m = principal_values(moments);
    const auto axis = [&](double moment) {
        return mass > 0.0 ? 2.0 * std::sqrt(5.0 * std::max(0.0, moment) / mass) : 0.0;
    };
    return {axis(m.x), axis(m.y), axis(m.z)};
}

/// Grain or sphere.
bool is_piece(const Model& model, const Bodies& bodies, int i)
{
    return !model.groups.at(static_cast<std::size_t>(bodies.group[i])).is_wall;
}

/// Volume and surface of the sharp polyhedron; of a body without one, those of the ball of its mass.
void add_solid(const Model& model, const Bodies& bodies, int i, PieceShape& shape)
{
    const Polyhedron& sharp = model.grain_shapes.at(static_cast<std::size_t>(i));
    shape.mass += bodies.mass[i];
    if (!sharp.faces.empty()) {
        shape.volume += mass_properties(sharp).volume;
        shape.surface += surface_area(sharp);
        return;
    }
    const double rho = density(model, bodies.group[i]);
    PieceShape ball;
    ball.volume = rho > 0.0 ? bodies.mass[i] / rho : 0.0;
    const double diameter = ball.equivalent_diameter();
    shape.volume += ball.volume;
    shape.surface += std::numbers::pi * diameter * diameter;
}

/// Faces that hold are no surface of a cluster, on neither side.
void take_bonded_faces(const State& state, const std::vector<std::int32_t>& cluster,
                       std::map<std::int32_t, Cluster>& clusters)
{
    const InterfaceBonds& bonds = state.interfaces;
    for (int i = 0; i < bonds.size(); ++i) {
        const std::int32_t c = cluster.at(static_cast<std::size_t>(bonds.a[i]));
        if (bonds.failure_time[i] >= 0.0 || c < 0 || c != cluster.at(static_cast<std::size_t>(bonds.b[i]))) continue;
        clusters[c].shape.surface -= 2.0 * bonds.area[i];
    }
}

}  // namespace

double PieceShape::equivalent_diameter() const
{
    return std::cbrt(6.0 * volume / std::numbers::pi);
}

double PieceShape::sphericity() const
{
    const double d = equivalent_diameter();
    return surface > 0.0 ? std::numbers::pi * d * d / surface : 0.0;
}

std::vector<Fragment> collect_fragments(const Model& model, const State& state, const SnapshotFields& fields)
{
    const Bodies& bodies = state.bodies;
    std::vector<Fragment> fragments;
    for (int i = 0; i < bodies.size(); ++i) {
        if (!is_piece(model, bodies, i)) continue;
        Fragment f;
        f.id = bodies.id[i];
        f.parent = bodies.parent[i];
        f.fragment_of = bodies.origin[i];
        f.generation = bodies.generation[i];
        f.cluster = fields.cluster.at(static_cast<std::size_t>(i));
        add_solid(model, bodies, i, f.shape);
        f.shape.axes = ellipsoid_axes(f.shape.mass, Mat3::diagonal(second_moments(bodies.inertia[i])));
        f.faces = static_cast<std::int32_t>(model.grain_shapes.at(static_cast<std::size_t>(i)).faces.size());
        f.position = bodies.position[i];
        f.velocity = bodies.velocity[i];
        fragments.push_back(f);
    }
    std::sort(fragments.begin(), fragments.end(), [](const Fragment& a, const Fragment& b) { return a.id < b.id; });
    return fragments;
}

std::vector<Cluster> collect_clusters(const Model& model, const State& state, const SnapshotFields& fields)
{
    const Bodies& bodies = state.bodies;
    std::map<std::int32_t, Cluster> by_number;
    const auto each = [&](auto&& visit) {
        for (int i = 0; i < bodies.size(); ++i) {
            const std::int32_t number = fields.cluster.at(static_cast<std::size_t>(i));
            if (number >= 0) visit(i, number);
        }
    };
    each([&](int i, std::int32_t number) {
        Cluster& c = by_number[number];
        c.cluster = number;
        ++c.fragments;
        add_solid(model, bodies, i, c.shape);
        c.position += bodies.mass[i] * bodies.position[i];
        c.velocity += bodies.mass[i] * bodies.velocity[i];
    });
    for (auto& [number, c] : by_number) {
        if (!(c.shape.mass > 0.0)) continue;
        c.position *= 1.0 / c.shape.mass;
        c.velocity *= 1.0 / c.shape.mass;
    }
    std::map<std::int32_t, Mat3> moments;
    each([&](int i, std::int32_t number) {
        const Mat3 turn = to_matrix(bodies.orientation[i]);
        const Vec3 d = bodies.position[i] - by_number[number].position;
        Mat3& m = moments[number];
        m = m + turn * Mat3::diagonal(second_moments(bodies.inertia[i])) * transpose(turn) +
            bodies.mass[i] * Mat3::outer(d, d);
    });
    take_bonded_faces(state, fields.cluster, by_number);
    std::vector<Cluster> clusters;
    for (auto& [number, c] : by_number) {
        c.shape.axes = ellipsoid_axes(c.shape.mass, moments[number]);
        clusters.push_back(c);
    }
    return clusters;
}

}  // namespace grainfrac
