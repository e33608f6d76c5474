// SPDX-License-Identifier: GPL-3.0-or-later
// Splitting a grain: what must be kept, and what must not jump.
#include "contact/find_pairs.h"
#include "experiment/walls.h"
#include "fracture/split_grains.h"
#include "geometry/mass_properties.h"
#include "model/validate.h"
#include "motion/energy.h"
#include "motion/integrate.h"
#include "support/assembly.h"

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

constexpr double k_n = 5e3, k_s = 2e3;

SplitRules easy_rules()
{
    SplitRules r;
    r.normal_stiffness = 4e3;
    r.shear_stiffness = 1.5e3;
    r.damping = 0.05;
    r.least_volume = r.least_section = 0.0;
    r.least_inradius = 0.0;
    r.most_generations = 10;
    return r;
}

/// Cohesive law of the grains and of new surfaces.
InterfaceLaw cohesive_law()
{
    InterfaceLaw l = elastic_law();
    l.failure = FailureUnit::point;
    l.softening = Softening::bilinear;
    l.tensile_strength = 20;
    l.cohesion = 40;
    l.friction = 0.5;
    l.residual_friction = 0.4;
    l.fracture_energy_I = 2;
    l.fracture_energy_II = 6;
    return l;
}

/// A box of side 1 cut by random planes, its middle at `center`.
Polyhedron random_body(const Vec3& center, int& draw)
{
    Polyhedron p = make_box({1, 1, 1}, center);
    for (int k = 0; k < 5; ++k) {
        const Vec3 n = normalized(random_vector(draw));
        const double d = dot(n, center) + 0.35 + 0.15 * std::fabs(random_vector(draw).x);
        const CutResult c = cut(p, {n, d});
        if (c.status == CutStatus::ok) p = c.inside;
    }
    return p;
}

/// 3 x 3 x 3 cubes, displaced, turned, moving; the middle one is body 13.
Assembly block(int& draw, double size = 1e-3)
{
    std::vector<GrainSpec> grains;
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                const Vec3 c{1.0 * x, 1.0 * y, 1.0 * z};
                grains.push_back(grain(make_box({1, 1, 1}, c), c));
            }
    Assembly a = assemble(std::move(grains));
    bond(a, cohesive_law(), 0.0, k_n, k_s / k_n, QuadratureRule::automatic, 0.1);
    for (int i = 0; i < a.state.bodies.size(); ++i) {
        shift(a.state, i, size * random_vector(draw));
        turn(a.state, i, from_axis_angle(normalized(random_vector(draw)), size));
        a.state.bodies.velocity.host()[static_cast<std::size_t>(i)] = 0.1 * random_vector(draw);
        const Vec3 w = random_vector(draw);
        set_spin(a.state.bodies, i, w);
    }
    a.model.gravity = {0.3, -1, 2};
    a.model.skin = 0.05;
    start(a.model, a.state);
    return a;
}

struct Totals {
    double mass = 0, kinetic = 0;
    Vec3 first_moment, momentum, angular;
    Mat3 inertia;
};
Totals totals(const State& s, const std::vector<int>& bodies)
{
    Totals t;
    const Bodies& b = s.bodies;
    for (const int i : bodies) {
        const double m = b.mass[i];
        const Vec3 x = b.position[i], v = b.velocity[i], w = b.angular_velocity[i];
        const Mat3 R = to_matrix(b.orientation[i]), I = R * (Mat3::diagonal(b.inertia[i]) * transpose(R));
        t.mass += m;
        t.first_moment += m * x;
        t.momentum += m * v;
        t.angular += m * cross(x, v) + I * w;
        t.kinetic += 0.5 * m * dot(v, v) + 0.5 * dot(w, I * w);
        t.inertia = t.inertia + I + m * (norm2(x) * Mat3::identity() - Mat3::outer(x, x));
    }
    return t;
}
double off(const Mat3& a, const Mat3& b)
{
    double worst = 0, size = 0;
    for (int r = 0; r < 3; ++r) {
        worst = std::max(worst, norm(a[r] - b[r]));
        size = std::max(size, norm(a[r]));
    }
    return worst / size;
}

/// Rate of the angular velocity of a body, in space.
Vec3 spin_rate(const State& s, int i)
{
    const Bodies& b = s.bodies;
    const Vec3 I = b.inertia[i], w = rotate_back(b.orientation[i], b.angular_velocity[i]);
    const Vec3 L{I.x * w.x, I.y * w.y, I.z * w.z};
    const Vec3 t = rotate_back(b.orientation[i], b.torque[i]) - cross(w, L);
    return rotate(b.orientation[i], {t.x / I.x, t.y / I.y, t.z / I.z});
}

}  // namespace

TEST_CASE("a split keeps mass, first moment, inertia, momenta and kinetic energy")
{
    int draw = 0;
    for (int k = 0; k < 50; ++k) {
        const Vec3 center = 3.0 * random_vector(draw);
        Assembly a = assemble({grain(random_body(center, draw), center, 0.02)}, 2.7);
        a.model.interface_laws.host() = {cohesive_law()};
        a.state.bodies.velocity.host()[0] = random_vector(draw);
        const Vec3 w = 5.0 * random_vector(draw);
        set_spin(a.state.bodies, 0, w);
        turn(a.state, 0, from_axis_angle(normalized(random_vector(draw)), 1.0));
        set_spin(a.state.bodies, 0, w);
        start(a.model, a.state);
        const Totals before = totals(a.state, {0});
        SplitRequest r;
        r.rules = easy_rules();
        r.body = 0;
        r.plane.normal = normalized(random_vector(draw));
        r.plane.offset = dot(r.plane.normal, a.state.bodies.position[0]) + 0.1 * random_vector(draw).x;
        const auto report = split_grains(a.model, a.state, {r});
        REQUIRE(report.size() == 1);
        REQUIRE(report[0].status == SplitStatus::done);
        REQUIRE(why_not_valid(a.model, a.state).empty());
        const Totals after = totals(a.state, {0, 1});
        CHECK(relative(after.mass, before.mass) < 1e-14);
        CHECK(norm(after.first_moment - before.first_moment) < 2e-14 * before.mass * norm(center));
        CHECK(norm(after.momentum - before.momentum) < 1e-14 * before.mass);
        CHECK(norm(after.angular - before.angular) < 3e-14 * before.mass * norm(center));
        CHECK(relative(after.kinetic, before.kinetic) < 1e-14);
        CHECK(off(after.inertia, before.inertia) < 1e-13);
    }
}

TEST_CASE("a split in a loaded, spinning block: no jump of forces, accelerations or energy")
{
    int draw = 1000;
    for (int k = 0; k < 20; ++k) {
        Assembly a = block(draw, k % 2 == 0 ? 1e-3 : 8e-3);  // whole, and damaged
        if (k % 2 == 1)
            CHECK(*std::max_element(a.state.histories.damage.host().begin(), a.state.histories.damage.host().end()) >
                  0.1);
        const Bodies& b = a.state.bodies;
        std::vector<Vec3> force, torque;
        for (int i = 0; i < b.size(); ++i) {
            force.push_back(b.force[i]);
            torque.push_back(b.torque[i]);
        }
        const int grain = k % 4 < 2 ? 13 : 14;
        const Vec3 c = b.position[grain], a_c = b.force[grain] * b.inverse_mass[grain], w = b.angular_velocity[grain],
                   w_rate = spin_rate(a.state, grain);
        const Ledger before = energy_ledger(a.model, a.state);
        SplitRequest r;
        r.rules = easy_rules();
        r.body = grain;
        r.plane.normal = normalized(random_vector(draw));
        r.plane.offset = dot(r.plane.normal, c) + 0.2 * random_vector(draw).x;
        const auto report = split_grains(a.model, a.state, {r});
        REQUIRE(report[0].status == SplitStatus::done);
        REQUIRE(why_not_valid(a.model, a.state).empty());
        double scale = 0, scale_t = 0;
        for (const Vec3& f : force) scale = std::max(scale, norm(f));
        for (const Vec3& t : torque) scale_t = std::max(scale_t, norm(t));
        for (int i = 0; i < static_cast<int>(force.size()); ++i) {
            if (i == grain) continue;
            CHECK(norm(b.force[i] - force[static_cast<std::size_t>(i)]) < 1e-12 * scale);
            CHECK(norm(b.torque[i] - torque[static_cast<std::size_t>(i)]) < 1e-12 * scale_t);
        }
        double size = norm(a_c) + norm(w_rate);
        for (const int part : {report[0].body, report[0].new_body}) {
            const Vec3 x = b.position[part] - c;
            const Vec3 expected = a_c + cross(w_rate, x) + cross(w, cross(w, x));
            CHECK(norm(b.force[part] * b.inverse_mass[part] - expected) < 1e-12 * size);
            CHECK(norm(spin_rate(a.state, part) - w_rate) < 1e-12 * size);
        }
        const Ledger after = energy_ledger(a.model, a.state);
        CHECK(relative(after.kinetic, before.kinetic) < 1e-13);
        CHECK(std::fabs(after.residual() - before.residual()) < 1e-13 * before.elastic_bonds);
        CHECK(relative(after.elastic_bonds, before.elastic_bonds + report[0].inserted_energy) < 1e-12);
    }
}

TEST_CASE("splits of neighbours, again and again, with a plate on top: the forces on everything else stay")
{
    int draw = 3000;
    Assembly a = block(draw);
    const int wall = add_wall(a.model, "plate");
    add_plate(a.model, a.state, wall, {0, 0, 1.5 - 2e-3}, {0, 0, -1}, {1, 0, 0}, 10, 10, 1);
    a.model.contact_laws.host() = {{3e3, 0.5, 0.4, 1.0, 0.0}};
    a.model.contact_law_of.assign(4, 0);
    start(a.model, a.state);
    for (int i = 0; i < 20; ++i) step(a.model, a.state, 1e-4);
    double pressed = 0;
    for (const double p : a.state.contacts.normal_force.host()) pressed += p;
    REQUIRE(pressed > 1.0);

    const double mass = total_momentum(a.model, a.state).mass;
    for (int round = 0; round < 4; ++round) {
        std::vector<SplitRequest> requests;
        for (int i = 0; i < a.state.bodies.size(); ++i) {
            if (a.state.bodies.wall[i] >= 0 || i % 3 != round % 3) continue;
            SplitRequest r;
            r.rules = easy_rules();
            r.body = i;
            r.plane.normal = normalized(random_vector(draw));
            r.plane.offset = dot(r.plane.normal, a.state.bodies.position[i]);
            requests.push_back(r);
        }
        std::reverse(requests.begin(), requests.end());
        const Bodies& b = a.state.bodies;
        const int before = b.size();
        Vec3 force, torque, plate;
        const auto sum = [&](Vec3& f, Vec3& t) {
            f = t = Vec3{};
            for (int i = 0; i < b.size(); ++i) {
                if (b.wall[i] >= 0) continue;
                f += b.force[i];
                t += b.torque[i] + cross(b.position[i], b.force[i]);
            }
        };
        sum(force, torque);
        for (int i = 0; i < b.size(); ++i) plate += b.wall[i] >= 0 ? b.force[i] : Vec3{};
        const Ledger energy = energy_ledger(a.model, a.state);
        const auto reports = split_grains(a.model, a.state, requests);
        REQUIRE(why_not_valid(a.model, a.state).empty());
        int done = 0;
        for (const SplitReport& r : reports) done += r.status == SplitStatus::done ? 1 : 0;
        CHECK(done == static_cast<int>(requests.size()));
        CHECK(b.size() == before + done);
        Vec3 force_after, torque_after, plate_after;
        sum(force_after, torque_after);
        for (int i = 0; i < b.size(); ++i) plate_after += b.wall[i] >= 0 ? b.force[i] : Vec3{};
        CHECK(norm(force_after - force) < 1e-3 * norm(plate));
        CHECK(norm(plate_after - plate) < 1e-3 * norm(plate));
        CHECK(norm(torque_after - torque) <
              3e-2 * norm(plate));  // the shares act at the middles of the parts' contacts
        CHECK(relative(total_momentum(a.model, a.state).mass, mass) < 1e-13);
        const Ledger now = energy_ledger(a.model, a.state);
        CHECK(relative(now.kinetic, energy.kinetic) < 1e-12);
        CHECK(std::fabs(now.residual() - energy.residual()) < 1e-12 * energy.elastic_bonds);
        for (int i = 0; i < 200; ++i) step(a.model, a.state, 5e-5);
        CHECK(energy_ledger(a.model, a.state).relative_error() < 1e-3);
        for (int i = 0; i < a.state.contacts.size(); ++i) CHECK(a.state.contacts.point[i].depth < 0.05);
    }
    CHECK(a.state.bodies.size() > 60);
}

TEST_CASE("one step after a split differs by the square of the step")
{
    const auto difference = [](double dt) {
        int draw = 5000;
        Assembly a = block(draw), cut = block(draw = 5000);
        SplitRequest r;
        r.rules = easy_rules();
        r.body = 13;
        r.plane.normal = normalized(Vec3{1, 2, -1});
        r.plane.offset = dot(r.plane.normal, cut.state.bodies.position[13]);
        const auto report = split_grains(cut.model, cut.state, {r});
        step(a.model, a.state, dt);
        step(cut.model, cut.state, dt);
        const Bodies &whole = a.state.bodies, &parts = cut.state.bodies;
        double worst = 0;
        for (const int i : {report[0].body, report[0].new_body}) {
            const Vec3 v =
                whole.velocity[13] + cross(whole.angular_velocity[13], parts.position[i] - whole.position[13]);
            worst = std::max(worst, norm(parts.velocity[i] - v));
        }
        return worst;
    };
    const double coarse = difference(2e-4), fine = difference(1e-4);
    CAPTURE(coarse, fine);
    CHECK(coarse / fine > 3.5);
}

TEST_CASE("what a split refuses, and a free surface")
{
    int draw = 6000;
    Assembly a = block(draw);
    SplitRequest r;
    r.body = 13;
    r.plane.normal = {1, 0, 0};
    const Vec3 c = a.state.bodies.position[13];
    const auto status = [&](double offset, const SplitRules& rules) {
        r.plane.offset = c.x + offset;
        r.rules = rules;
        return why_not_split(a.model, a.state, r);
    };
    SplitRules rules = easy_rules();
    CHECK(status(0.7, rules) == SplitStatus::outside);
    rules.least_volume = 0.1;
    CHECK(status(0.45, rules) == SplitStatus::small_part);
    rules = easy_rules();
    rules.least_inradius = 3.0;
    CHECK(status(0.45, rules) == SplitStatus::thin_part);
    rules = easy_rules();
    rules.most_generations = 0;
    CHECK(status(0.0, rules) == SplitStatus::generation);
    rules = easy_rules();
    rules.cohesive = false;
    r.rules = rules;
    r.plane.offset = c.x;
    const int interfaces = a.state.interfaces.size();
    const auto report = split_grains(a.model, a.state, {r});
    CHECK(report[0].status == SplitStatus::done);
    CHECK(report[0].inserted_energy == 0.0);
    const InterfaceBonds& f = a.state.interfaces;
    CHECK(f.size() == interfaces + 5);  // the four side faces are shared out; the new surface is a crack from the start
    CHECK(std::count(f.transgranular.host().begin(), f.transgranular.host().end(), 1) == 1);
    for (int i = 0; i < f.size(); ++i) {
        if (f.transgranular[i] == 0) continue;
        CHECK(f.area[i] == Approx(report[0].area).epsilon(1e-12));
        CHECK(f.failure_time[i] == a.state.time);
        CHECK(f.retired[i] == 1);
        CHECK(f.stored_energy[i] == 0.0);
        CHECK(f.inserted_work[i] == 0.0);
        CHECK(a.state.slots.force[i] == Vec3{});
    }
}

TEST_CASE("a refused plane is remembered, the others stay candidates; parts start afresh")
{
    int draw = 6100;
    Assembly a = block(draw);
    const Vec3 c = a.state.bodies.position[13];
    SplitRequest r;
    r.rules = easy_rules();
    r.rules.least_volume = 0.1;
    r.body = 13;
    r.plane = {{1, 0, 0}, c.x + 0.45};
    r.candidate = 2;
    CHECK(split_grains(a.model, a.state, {r})[0].status == SplitStatus::small_part);
    CHECK(a.state.bodies.saturated[13] == candidate_bit(2));
    r.plane.offset = c.x;
    r.candidate = 0;
    const auto report = split_grains(a.model, a.state, {r});
    CHECK(report[0].status == SplitStatus::done);
    CHECK(a.state.bodies.saturated[13] == 0);
    CHECK(a.state.bodies.saturated[report[0].new_body] == 0);
    r.rules.most_generations = 1;
    CHECK(split_grains(a.model, a.state, {r})[0].status == SplitStatus::generation);
    CHECK(a.state.bodies.saturated[13] == ~std::int64_t{0});
}
