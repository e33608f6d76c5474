// SPDX-License-Identifier: GPL-3.0-or-later
// Programmes of walls and stages: servo, bonds made in a stage, unloading, containers, triangulated walls.
#include "experiment/bond_stage.h"
#include "experiment/specimen.h"
#include "experiment/walls.h"
#include "motion/servo.h"
#include "support/assembly.h"
#include "support/disc.h"

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

/// `layers` hexagonal prisms upon each other along z, between two plates that touch it, or leave the gap of the grains.
/// Its bonds, where there are any, do not break.
Case column_case(int layers, double gap = 0.0)
{
    Case c = disc_case(0.6e-3, false);
    PartSpec& p = c.parts[0];
    p.name = "column";
    p.thickness = 1e-3;
    p.gap = gap;
    p.region.shape = "box";
    p.region.size = {1.1e-3, 1.3e-3, layers * p.thickness};
    c.bonds[0].failure = "unbreakable";
    c.contacts[0].friction = 0.0;
    c.contacts[0].dissipation = "none";
    for (const int side : {1, -1}) {
        WallSpec w;
        w.name = side > 0 ? "top" : "bottom";
        w.normal = {0.0, 0.0, static_cast<double>(-side)};
        w.center = {0.0, 0.0, side * 0.5 * p.region.size.z};
        w.size = {3e-3, 3e-3};
        c.walls.push_back(w);
    }
    c.test = {};
    return c;
}

StageSpec moving(const std::string& name, const std::string& wall, double speed)
{
    StageSpec s;
    s.name = name;
    s.duration = 1.0;
    s.motions = {{wall, {0.0, 0.0, speed}, {}}};
    return s;
}
StageSpec pressing(const std::string& name, const std::string& wall, double stress)
{
    StageSpec s = moving(name, wall, 0.0);
    s.motions[0].servo.stress = stress;
    return s;
}
StageSpec bonding(double distance)
{
    StageSpec s;
    s.name = "bonds_on";
    s.kind = "bond";
    s.bond_distance = distance;
    return s;
}

Built begun(const Case& c)
{
    Built b = build(c, default_device());
    start(b.model, b.state);
    return b;
}
void enter(Built& b, std::size_t stage)
{
    begin_stage(b.experiment.stages.at(stage), b.model, b.state);
}
double push_on(const Built& b, int wall, const Vec3& direction)
{
    return wall_push(b.model, b.state, wall, direction);
}
double ledger_error(const Built& b)
{
    return energy_ledger(b.model, b.state).relative_error();
}
double largest_force(const State& s)
{
    double most = 0.0;
    for (int i = 0; i < s.slots.size(); ++i) most = std::max(most, norm(s.slots.force[i]));
    return most;
}

constexpr double hexagon = 0.935307436087194e-6;  // 3 sqrt(3)/2 (0.6 mm)^2 [m^2]

}  // namespace

TEST_CASE("custom: a servo holds its stress and its work is in the account")
{
    Case c = column_case(5);
    StageSpec press = pressing("press", "top", 50e6);
    press.ramp = 10e-6;
    press.motions[0].servo.area = hexagon;
    c.stages = {press};
    // no strength sets the limit of the speed where nothing can break
    CHECK(begun(c).experiment.stages[0].servos[0].max_speed == Approx(1e-5 * std::sqrt(410e9 / 3100)));
    c.bonds[0].failure = BondSpec{}.failure;
    Built b = begun(c);
    enter(b, 0);
    const double dt = stable_step(b), wanted = 50e6 * hexagon;
    // speed for what is wanted in the ramp: 50 MPa/E of 5 mm in 10 us is 60 mm/s; the auto limit is 0.01 sigma_c/(rho
    // c)
    CHECK(b.experiment.stages[0].servos[1].max_speed == 0.0);
    CHECK(b.experiment.stages[0].servos[0].max_speed == Approx(0.01 * 100e6 / std::sqrt(3100 * 410e9)));
    double fastest = 0.0;
    int held_from = -1, steps = 12000;
    for (int i = 0; i < steps; ++i) {
        step(b.model, b.state, dt);
        for (int k = 0; k < b.state.bodies.size(); ++k) {
            if (b.state.bodies.wall[k] == 0) fastest = std::max(fastest, norm(b.state.bodies.velocity[k]));
        }
        const bool held = std::fabs(push_on(b, 0, {0, 0, -1}) - wanted) < 0.01 * wanted;
        if (!held) held_from = -1;
        if (held && held_from < 0) held_from = i;
    }
    CAPTURE(dt, held_from, push_on(b, 0, {0, 0, -1}) / wanted, ledger_error(b));
    CHECK(fastest <= b.experiment.stages[0].servos[0].max_speed * (1 + 1e-12));
    CHECK(held_from > 0);
    CHECK(held_from < steps / 2);                                      // and never lost again
    CHECK(push_on(b, 0, {0, 0, -1}) == Approx(wanted).epsilon(1e-6));  // it has come to rest
    CHECK(push_on(b, 1, {0, 0, 1}) == Approx(wanted).epsilon(1e-6));
    CHECK(servos_hold(b.model, b.state));
    const Ledger e = energy_ledger(b.model, b.state);
    CHECK(e.relative_error() < 1e-3);
    CHECK(e.external == Approx(e.elastic_bonds + e.elastic_contacts + e.damping + e.kinetic).epsilon(1e-3));
    // the static answer: P^2/2 over the springs in series, 4 faces of E/h and 2 contacts of 10 E/h'
    CHECK(e.elastic_bonds == Approx(0.5 * wanted * wanted * 4 * 1e-3 / (410e9 * hexagon)).epsilon(1e-4));
}

TEST_CASE("custom: bonds after compaction join what touches without stress and as stiff as from the start")
{
    constexpr double gap = 2e-6;
    Case loose = column_case(4, gap);
    loose.bonds[0].made_in = "bonds_on";
    loose.contacts[0].normal_stiffness = 4e14;  // as the bonds
    loose.contacts[0].friction = 0.3;           // a column of smooth faces slides apart under its load, by and by
    loose.contacts[0].dissipation = "viscous";
    loose.contacts[0].restitution = 0.5;
    StageSpec press = pressing("compact", "top", 1e6);
    press.kind = "compact";
    press.motions[0].servo.max_speed = 0.2;
    press.local_damping = 0.3;
    StageSpec load = moving("load", "top", -0.02);
    load.ramp = 10e-6;
    loose.stages = {press, bonding(0.1e-6), load};
    Built b = begun(loose);
    CHECK(b.state.interfaces.size() == 0);
    CHECK(b.experiment.reference_stage == 2);
    enter(b, 0);
    double dt = 0.7 * stable_step(b);  // impacts of a few steps each, while the servo gets hold of loose grains
    for (int k = 0; k < 40 && !(servos_hold(b.model, b.state) && unbalanced_force_ratio(b.state) < 1e-3); ++k)
        run_steps(b, dt, 1000);
    const double compacted = push_on(b, 0, {0, 0, -1});
    CHECK(servos_hold(b.model, b.state));
    CHECK(unbalanced_force_ratio(b.state) < 1e-3);

    enter(b, 1);
    const Ledger before = energy_ledger(b.model, b.state);
    CHECK(before.relative_error() < 0.01);
    const BondsMade made = make_bonds(b.model, b.state, *b.experiment.stages[1].bonds, 1);
    CHECK(made.number == 3);
    const double area = 1.5 * std::sqrt(3.0) * std::pow(0.6e-3 - gap / std::sqrt(3.0), 2);
    CHECK(made.area == Approx(3 * area).epsilon(1e-4));  // impacts left them a few nanometres aside
    CHECK(why_not_valid(b.model, b.state).empty());
    CHECK(largest_force(b.state) < 1e-9 * compacted);
    CHECK(norm(total_momentum(b.model, b.state).linear) == 0.0);
    const Ledger after = energy_ledger(b.model, b.state);
    CHECK(after.kinetic + after.elastic_bonds + after.elastic_contacts < 1e-12 * before.elastic_contacts);
    CHECK(after.inserted == Approx(before.inserted - before.kinetic - before.elastic_contacts));
    CHECK(made.removed_energy == Approx(before.kinetic + before.elastic_contacts));
    CHECK(after.residual() == Approx(before.residual()).margin(1e-12 * before.external));

    // the same column with its bonds from the start, where it lies now
    Case whole = column_case(4);
    whole.parts[0].side -= gap / std::sqrt(3.0);
    whole.parts[0].thickness -= gap;
    whole.parts[0].region.size.z = 4 * whole.parts[0].thickness;
    for (WallSpec& w : whole.walls) w.center.z = -w.normal.z * 0.5 * whole.parts[0].region.size.z;
    whole.contacts = loose.contacts;
    whole.stages = {load};
    Built reference = begun(whole);
    enter(b, 2);
    take_reference(b.experiment, b.model, b.state);
    enter(reference, 0);
    dt = 0.5 * std::min(stable_step(b), stable_step(reference));
    const int steps = static_cast<int>(40e-6 / dt);
    const auto loaded = [&](Built& x) {
        run_steps(x, dt, steps);
        return measure(x.experiment, x.model, x.state);
    };
    const Measurement m1 = loaded(b), r1 = loaded(reference), m = loaded(b), r = loaded(reference);
    CAPTURE(m.load, r.load, m.displacement, r.displacement, before.relative_error());
    CHECK(m.load - m1.load == Approx(r.load - r1.load).epsilon(1e-4));  // the modulus, as the area
    REQUIRE(m.displacement == Approx(r.displacement).epsilon(1e-9));
    CHECK(m.load > 10 * compacted);
    CHECK(m.load == Approx(r.load).epsilon(1e-3));  // overlaps of 2.4 nm, a little tilted, under the platens
    CHECK(ledger_error(b) < 1e-3);
}

TEST_CASE("custom: bonds of a stage go between those that are there and those keep their forces")
{
    Case c = column_case(2);
    PartSpec high = c.parts[0];
    high.name = "high";
    high.region.center.z = 2e-3 + 10e-6;
    c.parts.push_back(high);
    c.walls.clear();
    BondSpec within = c.bonds[0], across = c.bonds[0];
    within.between = {"column", "column"};
    across.between = {"column", "high"};
    across.made_in = "bonds_on";
    across.quadrature = "cross";
    BondSpec other = within;
    other.between = {"high", "high"};
    c.bonds = {within, other, across};
    c.stages = {bonding(12e-6)};
    Built b = begun(c);
    REQUIRE(b.state.interfaces.size() == 2);
    shift(b.state, 0, {0, 0, 1e-7});  // presses the lower bond
    bond_forces(b.model, b.state, 0.0);
    const Vec3 before = b.state.slots.force[0];
    CHECK(norm(before) > 0.0);
    const BondsMade made = make_bonds(b.model, b.state, *b.experiment.stages[0].bonds, 1);
    CHECK(made.number == 1);
    REQUIRE(b.state.interfaces.size() == 3);
    CHECK(why_not_valid(b.model, b.state).empty());
    CHECK(b.state.interfaces.a[1] == 1);
    CHECK(b.state.interfaces.b[1] == 2);
    CHECK(b.state.slots.force[0] == before);
    const double round_off = 4e-12 * norm(before);  // 4e-19 m, of positions of 2 mm, over the 0.1 um of the pressed one
    CHECK(norm(b.state.slots.force[1]) < round_off);
    CHECK(norm(b.state.slots.force[2]) < round_off);
    CHECK(b.state.interfaces.normal_stiffness[1] == Approx(410e9 / (1e-3 + 10e-6)));
    // half-way across the gap
    const int q = b.state.interfaces.point_begin[1];
    CHECK(b.state.points.position_a[q].z == Approx(0.5e-3 + 5e-6));
    CHECK(b.state.points.position_b[q].z == Approx(-0.5e-3 - 5e-6));
    // and again: what is bonded is left alone
    CHECK(make_bonds(b.model, b.state, *b.experiment.stages[0].bonds, 1).number == 0);
}

TEST_CASE("custom: unloading goes back along the line of loading")
{
    Case c = column_case(4);
    StageSpec load = moving("load", "top", -0.02), back;
    load.ramp = back.ramp = 10e-6;
    back.name = "back";
    back.kind = "unload";
    c.stages = {load, back};
    Built b = begun(c);
    const double dt = stable_step(b, 0.5);
    CHECK(b.experiment.stages[1].unloads);
    CHECK(b.experiment.stages[1].load_direction == Vec3{0, 0, -1});
    CHECK(b.experiment.stages[1].wall_velocity[0] == Vec3{0, 0, 0.02});
    enter(b, 0);
    std::vector<std::pair<double, double>> forth;  // displacement, load
    const auto now = [&] {
        const Measurement m = measure(b.experiment, b.model, b.state);
        return std::pair{m.displacement, m.load};
    };
    while (now().first < 1e-6) {
        run_steps(b, dt, 20);
        forth.push_back(now());
    }
    const double most = forth.back().second;
    // one plate pressed onto 4 grains, 3 faces of E/h and two contacts of 10 E/h in series
    const double h_contact = 2.0 * std::min(0.5e-3, 0.6e-3 * std::sqrt(3.0) / 2);
    const double stiffness = hexagon * 410e9 / (3 * 1e-3 + 2 * h_contact / 10);
    enter(b, 1);
    double worst = 0.0;
    while (now().second > 0.02 * most) {
        run_steps(b, dt, 20);
        const auto [u, load_now] = now();
        worst = std::max(worst, std::fabs(load_now - stiffness * u) / most);
    }
    CAPTURE(most / (stiffness * forth.back().first), worst, now().first);
    CHECK(most == Approx(stiffness * forth.back().first).epsilon(0.01));
    CHECK(worst < 0.01);  // waves of the turn-round
    CHECK(ledger_error(b) < 1e-3);
}

TEST_CASE("custom: the account closes where a stage changes gravity")
{
    Case c = column_case(3);
    StageSpec fall = moving("down", "top", 0.0), up = fall;
    fall.gravity = Vec3{0, 0, -2000};
    up.name = "up";
    up.gravity = Vec3{500, 0, 1000};
    c.walls.pop_back();  // nothing below
    c.stages = {fall, up};
    Built b = begun(c);
    const double dt = stable_step(b);
    enter(b, 0);
    run_steps(b, dt, 500);
    const Momentum m = total_momentum(b.model, b.state);
    CHECK(m.linear.z == Approx(-2000 * m.mass * b.state.time));
    CHECK(ledger_error(b) < 1e-6);  // nothing but free fall
    enter(b, 1);
    const double turned = b.state.time;
    run_steps(b, dt, 200);
    const Momentum n = total_momentum(b.model, b.state);
    CHECK(n.linear.x == Approx(500 * m.mass * (b.state.time - turned)));
    CHECK(ledger_error(b) < 1e-6);
}

namespace {

/// A few loose grains that fly about in a container that the test adds; nothing dissipates.
Case flying_case()
{
    Case c = disc_case(0.6e-3, false);
    PartSpec& p = c.parts[0];
    p.thickness = 1e-3;
    p.gap = 0.1e-3;
    p.region.shape = "box";
    p.region.size = {2.2e-3, 2.2e-3, 2e-3};
    p.velocity = {3.0, 2.0, -4.0};
    p.angular_velocity = {500.0, 300.0, 100.0};
    c.bonds.clear();
    c.contacts[0].normal_stiffness = 1e13;
    c.test = {};
    StageSpec fly;
    fly.name = "fly";
    fly.duration = 1.0;
    fly.gravity = Vec3{0, 0, -100};
    c.stages = {fly};
    return c;
}

WallSpec box_of(const Vec3& size)
{
    WallSpec w;
    w.name = "box";
    w.shape = "box";
    w.size = {size.x, size.y, size.z};
    w.open = {"+z"};
    return w;
}

struct Flight {
    std::uint64_t hash = 0;
    std::vector<Vec3> positions;
    int touched = 0;
    double error = 0.0;
};
Flight fly(Built b, int steps)
{
    start(b.model, b.state);
    enter(b, 0);
    Flight f;
    for (int i = 0; i < steps; ++i) {
        step(b.model, b.state, 20e-9);
        for (int k = 0; k < b.state.contacts.size(); ++k) f.touched += b.state.contacts.normal_force[k] > 0.0 ? 1 : 0;
    }
    for (int i = 0; i < b.state.bodies.size(); ++i) {
        if (b.state.bodies.inverse_mass[i] > 0.0) f.positions.push_back(b.state.bodies.position[i]);
    }
    f.error = ledger_error(b);
    f.hash = state_hash(b.state);
    return f;
}

/// Text of an ASCII STL file with these triangles.
std::string stl_text(const std::vector<std::array<Vec3, 3>>& triangles)
{
    std::ostringstream out;
    out.precision(17);
    out << "solid test\n";
    for (const auto& t : triangles) {
        out << "facet normal 0 0 0\nouter loop\n";
        for (const Vec3& x : t) out << "vertex " << x.x << ' ' << x.y << ' ' << x.z << '\n';
        out << "endloop\nendfacet\n";
    }
    out << "endsolid test\n";
    return out.str();
}

/// The rectangle from `corner` along u and v, as n x n squares of two triangles each; normal along u x v.
void add_rectangle(std::vector<std::array<Vec3, 3>>& triangles, const Vec3& corner, const Vec3& u, const Vec3& v, int n)
{
    const auto at = [&](int i, int j) { return corner + (i / double(n)) * u + (j / double(n)) * v; };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
}

struct TemporaryStl {
    std::string path;
    explicit TemporaryStl(const std::string& text)
    {
        path = std::filesystem::temp_directory_path() /
               ("grainfrac_custom_" + std::to_string(reinterpret_cast<std::uintptr_t>(this)) + ".stl");
        std::ofstream(path, std::ios::binary) << text;
    }
    ~TemporaryStl() { std::filesystem::remove(path); }
};

WallSpec stl_wall(const std::string& file)
{
    WallSpec w;
    w.name = "surface";
    w.shape = "stl";
    w.file = file;
    w.file_unit = 1e-3;
    w.closed = false;
    return w;
}

}  // namespace

TEST_CASE("custom: a box is its plates bit for bit and triangles in their place do the same")
{
    const Vec3 inside{3.0e-3, 3.2e-3, 2.6e-3};
    Case c = flying_case(), plates = flying_case(), triangles = flying_case();
    c.walls = {box_of(inside)};
    const double t = 0.1 * inside.y;
    for (int e = 0; e < 3; ++e) {
        const int f = e == 0 ? 1 : 0, g = 3 - e - f;
        for (const int side : {1, -1}) {
            if (e == 2 && side == 1) continue;
            WallSpec w;
            w.name = std::string("plate") + "xyz"[e] + (side > 0 ? "p" : "m");
            w.normal = -side * axis_vector(e);
            w.center = {};
            w.center[e] = side * 0.5 * inside[e];
            w.size = {inside[f] + 2 * t, inside[g] + 2 * t};
            w.thickness = t;
            plates.walls.push_back(w);
        }
    }
    const Flight box = fly(build(c, default_device()), 10000), as_plates = fly(build(plates, default_device()), 10000);
    CHECK(box.touched > 1000);
    CHECK(box.hash == as_plates.hash);
    CHECK(box.error < 3e-3);  // 85 steps an impact; second order, 7e-6 at 1,700 (docs/theory/contact.md)

    std::vector<std::array<Vec3, 3>> surface;  // in mm, normals inwards; sides reach past the corners as the plates do
    const Vec3 h = 500.0 * inside, reach = h + Vec3{0.5, 0.5, 0.5};
    add_rectangle(surface, {-h.x, -reach.y, -reach.z}, {0, 2 * reach.y, 0}, {0, 0, 2 * reach.z}, 3);
    add_rectangle(surface, {h.x, -reach.y, -reach.z}, {0, 0, 2 * reach.z}, {0, 2 * reach.y, 0}, 1);
    add_rectangle(surface, {-reach.x, -h.y, -reach.z}, {0, 0, 2 * reach.z}, {2 * reach.x, 0, 0}, 2);
    add_rectangle(surface, {-reach.x, h.y, -reach.z}, {2 * reach.x, 0, 0}, {0, 0, 2 * reach.z}, 1);
    add_rectangle(surface, {-reach.x, -reach.y, -h.z}, {2 * reach.x, 0, 0}, {0, 2 * reach.y, 0}, 4);
    const TemporaryStl file(stl_text(surface));
    triangles.walls = {stl_wall(file.path)};
    const Built b = build(triangles, default_device());
    int bodies = 0;
    for (int i = 0; i < b.state.bodies.size(); ++i) bodies += b.state.bodies.wall[i] == 0 ? 1 : 0;
    CHECK(bodies == 5);  // a facet for each side, however it is divided
    // flat impacts: on edges and corners a plate's rounding matters, and triangles have none
    for (Case* x : {&c, &triangles}) {
        x->parts[0].velocity = {0.0, 0.0, -4.0};
        x->parts[0].angular_velocity = {};
    }
    const int steps = 4500;  // the first impacts; round-off grows with each
    const Flight a = fly(build(c, default_device()), steps), s = fly(build(triangles, default_device()), steps);
    CHECK(a.touched > 50);
    double worst = 0.0;
    for (std::size_t i = 0; i < a.positions.size(); ++i) worst = std::max(worst, norm(a.positions[i] - s.positions[i]));
    CAPTURE(a.touched, s.touched);
    CHECK(1e12 * worst / inside.x < 1.0);
}

namespace {

struct Slide {
    double bump = 0.0, slowed = 0.0, turned = 0.0;  // largest; share of v^2; rad/s
    double way = 0.0, error = 0.0;
    int facets = 0;
};

/// A grain slides without friction over a floor of triangles, from the origin towards +x and a little +y.
Slide slide_over(const std::vector<std::array<Vec3, 3>>& floor)
{
    Case c = flying_case();
    PartSpec& p = c.parts[0];
    p.gap = 0.0;
    p.region.size = {1.1e-3, 1.3e-3, 1e-3};
    p.velocity = {3.0, 0.7, 0.0};
    p.angular_velocity = {};
    c.contacts[0].friction = 0.0;
    c.contacts[0].dissipation = "none";
    c.stages[0].gravity = Vec3{0, 0, -1e4};
    const TemporaryStl file(stl_text(floor));
    c.walls = {stl_wall(file.path)};
    Built b = begun(c);
    enter(b, 0);
    // at rest on the floor: m g = k_c A g, over the core's face
    const double core = 1.5 * std::sqrt(3.0) * std::pow(0.6e-3 - 2 / std::sqrt(3.0) * b.model.shapes.radius[0], 2);
    shift(b.state, 0, {0, 0, -b.state.bodies.mass[0] * 1e4 / (1e13 * core)});
    start(b.model, b.state);
    const Vec3 from = b.state.bodies.position[0];
    const double height = from.z;
    const Vec3 v = b.state.bodies.velocity[0];
    Slide s;
    for (int i = 0; i < b.state.bodies.size(); ++i) s.facets += b.state.bodies.wall[i] == 0 ? 1 : 0;
    for (int i = 0; i < 20000; ++i) {
        step(b.model, b.state, 40e-9);
        s.bump = std::max(s.bump, std::fabs(b.state.bodies.position[0].z - height));
        s.slowed = std::max(s.slowed, std::fabs(norm2(b.state.bodies.velocity[0]) / norm2(v) - 1.0));
        s.turned = std::max(s.turned, norm(b.state.bodies.angular_velocity[0]));
    }
    s.way = norm(b.state.bodies.position[0] - from);
    s.error = ledger_error(b);
    return s;
}

}  // namespace

TEST_CASE("custom: a grain feels nothing of the inner edges of a triangulated floor")
{
    std::vector<std::array<Vec3, 3>> floor;
    add_rectangle(floor, {-1.5, -3, -0.5}, {6, 0, 0}, {0, 6, 0}, 7);
    const Slide s = slide_over(floor);
    CHECK(s.facets == 1);
    CHECK(s.way > 2.4e-3);  // over several squares and their diagonals
    CHECK(s.bump < 1e-9 * 1e-3);
    CHECK(s.slowed < 1e-9);
    CHECK(s.turned < 1e-9 * 3.0 / 1e-3);
    CHECK(s.error < 1e-9);
}

TEST_CASE("custom: the joints between pieces of a floor that is not convex make no energy")
{
    std::vector<std::array<Vec3, 3>> floor;  // an L
    add_rectangle(floor, {-3, -3, -0.5}, {4, 0, 0}, {0, 6, 0}, 6);
    add_rectangle(floor, {1, -3, -0.5}, {5, 0, 0}, {0, 5, 0}, 5);
    const Slide s = slide_over(floor);
    CHECK(s.facets > 1);
    CHECK(s.way > 2.4e-3);
    CHECK(s.error < 1e-8);
    CHECK(s.bump < 3.3e-9);  // they are felt, as edges of 3.3 nm: the overlap m g/(k_c A) under the grain's weight
    CHECK(s.slowed < 1e-6);
}
