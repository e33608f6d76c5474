// SPDX-License-Identifier: GPL-3.0-or-later
// Three hexagonal prisms, a plate and a ball for walls, two bonds of which one broke, one contact: small enough to know
// every number that must come out.
#pragma once

#include "generate/spheres.h"
#include "geometry/mass_properties.h"
#include "geometry/shared_faces.h"
#include "io/results.h"

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <unistd.h>

namespace sample {

using namespace grainfrac;

inline constexpr double side = 0.6e-3, thickness = 5e-3, density = 3100.0;  // [m], [m], [kg/m^3]
inline constexpr double crack_opening = 2e-6;                               // [m]
inline const double prism_volume = 1.5 * std::sqrt(3.0) * side * side * thickness;

struct World {
    Model model;
    State state;
    SnapshotFields fields;
};

inline void add_body(State& state, int id, int shape, int wall, const Vec3& position, const Quat& orientation)
{
    Bodies& bodies = state.bodies;
    const int i = bodies.size();
    bodies.for_each_array([&](const char*, auto& array) { array.resize(i + 1); });
    bodies.id.host()[i] = id;
    bodies.shape.host()[i] = shape;
    bodies.wall.host()[i] = wall;
    bodies.group.host()[i] = wall < 0 ? 0 : 1;
    bodies.mass.host()[i] = wall < 0 ? density * prism_volume : 1.0;
    bodies.position.host()[i] = bodies.start_position.host()[i] = position;
    bodies.orientation.host()[i] = bodies.start_orientation.host()[i] = orientation;
    bodies.velocity.host()[i] = {0.1 * i, -0.2, 0.3};
    bodies.angular_velocity.host()[i] = {1.0, 2.0, 3.0 + i};
    bodies.crystal.host()[i] = from_axis_angle({0, 0, 1}, 0.3 * i);
    bodies.inertia.host()[i] = density * mass_properties(make_hexagonal_prism(side, thickness)).principal_inertia;
    bodies.origin.host()[i] = id;
    bodies.parent.host()[i] = -1;
}

/// The face between bodies a and b, with its corners as quadrature points.
inline void add_interface(State& state, const SharedFace& face, int a, int b)
{
    Bodies& bodies = state.bodies;
    InterfaceBonds& bonds = state.interfaces;
    const int i = bonds.size();
    bonds.for_each_array([&](const std::string& name, auto& array) {
        if (!name.ends_with("_begin")) array.resize(i + 1);
    });
    if (i == 0) bonds.point_begin.host() = bonds.corner_begin.host() = {0};
    bonds.a.host()[i] = a;
    bonds.b.host()[i] = b;
    bonds.normal_a.host()[i] = rotate_back(bodies.orientation[a], face.normal);
    bonds.normal_b.host()[i] = rotate_back(bodies.orientation[b], face.normal);
    bonds.area.host()[i] = norm(area_vector(face.polygon));
    bonds.normal_stiffness.host()[i] = 4e14;
    bonds.shear_stiffness.host()[i] = 2e14;
    bonds.failure_time.host()[i] = bonds.first_damage_time.host()[i] = -1.0;
    bonds.history.host()[i] = no_history::none;
    for (const Vec3& corner : face.polygon) {
        const Vec3 on_a = rotate_back(bodies.orientation[a], corner - bodies.position[a]);
        const Vec3 on_b = rotate_back(bodies.orientation[b], corner - bodies.position[b]);
        state.corners.position_a.host().push_back(on_a);
        state.corners.position_b.host().push_back(on_b);
        const int q = state.points.size();
        state.points.for_each_array([&](const char*, auto& array) { array.resize(q + 1); });
        state.points.position_a.host()[q] = on_a;
        state.points.position_b.host()[q] = on_b;
        state.points.weight.host()[q] = bonds.area[i] / static_cast<double>(face.polygon.size());
    }
    bonds.corner_begin.host().push_back(state.corners.size());
    bonds.point_begin.host().push_back(state.points.size());
}

inline void add_contact(State& state, int a, int b)
{
    Contacts& contacts = state.contacts;
    const int i = contacts.size();
    contacts.for_each_array([&](const char*, auto& array) { array.resize(i + 1); });
    state.pairs.for_each_array([&](const char*, auto& array) { array.resize(i + 1); });
    state.pairs.a.host()[i] = contacts.a.host()[i] = a;
    state.pairs.b.host()[i] = contacts.b.host()[i] = b;
    state.pairs.contact.host()[i] = contacts.pair.host()[i] = i;
    contacts.active.host()[i] = 1;
    contacts.normal_force.host()[i] = 25.0;
    contacts.point.host()[i] = {{0, -1, 0}, {0, -side, 0}, 1e-15, 0.0, 1e-22, 1e-8, 0.0, 1e-7};
}

/// Bodies 0..2 are the grains of ids 2, 0, 1 (bodies may be renumbered, ids not), body 3 a plate below them, body 4 a
/// ball above. Bond 0 (bodies 0 and 1) broke at 2 us and opened by crack_opening, bond 1 (bodies 1 and 2) is damaged by
/// a quarter.
inline World make_world()
{
    World w;
    w.model.materials = {{"sic", density, 410e9, 0.16}};
    w.model.groups = {{"disc", 0, false}, {"platens", -1, true}};
    w.model.walls = {"bottom", "top"};
    w.model.wall_motion.resize(2);
    w.model.wall_motion.host()[1].velocity = {0, -0.02, 0};
    const Polyhedron prism = make_hexagonal_prism(side, thickness);
    w.model.grain_shapes = {prism, prism, prism, {}, {}};
    add_shape(w.model.shapes, make_hexagonal_prism(0.9 * side, thickness - 0.2 * side), 0.1 * side);
    add_shape(w.model.shapes, make_box({8e-3, 0.8e-3, 5.8e-3}), 0.1e-3);
    add_sphere_shape(w.model.shapes, 1e-3);

    const double pitch = std::sqrt(3.0) * side;
    const Quat turned = from_axis_angle({0, 0, 1}, std::numbers::pi / 3.0);
    add_body(w.state, 2, 0, -1, {0, 0, 0}, {});
    add_body(w.state, 0, 0, -1, {pitch, 0, 0}, turned);  // looks the same
    add_body(w.state, 1, 0, -1, {0.5 * pitch, 1.5 * side, 0}, {});
    add_body(w.state, 3, 1, 0, {0, -side - 0.5e-3, 0}, {});
    add_body(w.state, 4, 2, 1, {0.5 * pitch, 2.5 * side + 1e-3, 0}, {});

    std::vector<Polyhedron> cells;
    for (int i = 0; i < 3; ++i)
        cells.push_back(translated(rotated(prism, w.state.bodies.orientation[i]), w.state.bodies.position[i]));
    for (const SharedFace& face : find_shared_faces(cells)) {
        if (face.b - face.a == 1) add_interface(w.state, face, face.a, face.b);
    }
    InterfaceBonds& bonds = w.state.interfaces;
    bonds.damage.host() = {1.0, 0.25};
    bonds.failure_time.host()[0] = 2e-6;
    bonds.first_damage_time.host()[0] = 1e-6;
    bonds.shear_share.host()[0] = 0.1 * bonds.area[0];
    bonds.stored_energy.host()[1] = 3e-4;
    w.state.bodies.position.host()[0].x -= crack_opening;
    add_contact(w.state, 0, 3);
    w.state.slots.resize(3);
    w.state.slots.force.host()[1] = -1e6 * bonds.area[1] * rotate(w.state.bodies.orientation[1], bonds.normal_a[1]);
    w.state.slots.force.host()[2] = {0, -25, 0};
    w.state.incidence.begin.host() = {0, 2, 4, 5, 6, 6};
    w.state.incidence.entry.host() = {0, 4, 1, 2, 3, 5};
    w.state.past_contacts = {1e-9, 2e-9, 3e-9};
    w.state.time = 3e-6;
    w.state.step = 300;
    w.state.travel = 1e-6;
    w.state.initial_energy = 4e-5;

    w.fields.stress.assign(5, Mat3{});
    w.fields.stress[0] = {{{10e6, 2e6, 0}, {2e6, -30e6, 1e6}, {0, 1e6, 5e6}}};
    w.fields.cluster = {1, 0, 0, -1, -1};
    return w;
}

/// A parallel bond between bodies 0 and 2 that broke in shear at 2.5 us.
inline void add_parallel_bond(State& state)
{
    ParallelBonds& bonds = state.parallels;
    bonds.for_each_array([&](const char*, auto& array) { array.resize(1); });
    bonds.b.host()[0] = 2;
    const Vec3 a = state.bodies.position[0], b = state.bodies.position[2];
    bonds.position_a.host()[0] = 0.5 * (b - a);
    bonds.position_b.host()[0] = 0.5 * (a - b);
    bonds.normal_a.host()[0] = bonds.normal_b.host()[0] = normalized(b - a);
    bonds.radius.host()[0] = 0.2e-3;
    bonds.cause.host()[0] = 2;
    bonds.failure_time.host()[0] = 2.5e-6;
}

inline constexpr double sphere_radius = 0.5, sphere_gap = 1e-3;  // [m]

/// Three spheres in a row along x, ids as indices, bonded; the third belongs to wall "grip", its bond broke in tension
/// at 2 us. The first bond is longer by sphere_gap and twisted: F = K_n gap, M = K_t 0.01.
inline World make_spheres()
{
    World w;
    w.model.materials = {{"stone", 2000.0, 1e9, 0.1}};
    w.model.groups = {{"chain", 0, false}};
    w.model.walls = {"grip"};
    w.model.wall_motion.resize(1);
    ParallelLaw strength{};
    strength.moment_contribution = 1.0;
    w.model.sphere_bond_laws.host().push_back({strength, 0.0, false});
    for (int i = 0; i < 3; ++i) {
        SphereSpec s;
        s.position = {2.0 * sphere_radius * i, 0, 0};
        s.radius = sphere_radius;
        add_sphere(w.model, w.state, s);
    }
    for (int i = 0; i < 2; ++i) {
        SpherePair pair;
        pair.a = i;
        pair.b = i + 1;
        pair.radius = 0.25;
        pair.springs = circular_bond(1e9, 4e8, pair.radius, true);
        add_sphere_bond(w.model, w.state, pair);
    }
    w.state.bodies.wall.host()[2] = 0;
    w.state.bodies.held.host()[2] = 1;
    w.state.bodies.position.host()[0].x -= sphere_gap;
    w.state.bodies.orientation.host()[0] = from_axis_angle({1, 0, 0}, 0.01);
    w.state.sphere_bonds.cause.host()[1] = 1;
    w.state.sphere_bonds.failure_time.host()[1] = 2e-6;
    w.state.time = 3e-6;
    w.state.step = 300;
    w.fields.stress.assign(3, Mat3{});
    w.fields.cluster = {0, 0, 1};
    return w;
}

inline RunFacts facts()
{
    return {"0.1.0", "0123abcd", "cpu", 42, 2, "brazilian"};
}

inline HistoryRow history_row(int k)
{
    HistoryRow row;
    row.step = 1000000 * k;
    row.time = 1e-7 * k;
    row.displacement = 0.1 / 3.0 * k;
    row.load = 100.0 * k;
    row.energy.external = 0.5 * k;
    row.energy.kinetic = 0.25 * k;
    row.energy.elastic_bonds = 0.25 * k;
    row.broken_bonds_tension = k;
    return row;
}

/// A folder that is gone when the test ends.
class TemporaryFolder {
public:
    TemporaryFolder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "grainfrac_test_XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
        path_ = name;
    }
    ~TemporaryFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace sample
