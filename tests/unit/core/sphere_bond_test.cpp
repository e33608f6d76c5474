// SPDX-License-Identifier: GPL-3.0-or-later
// One bond between two spheres: balance, potential, objectivity, limits of the step. Closed forms and tolerances:
// docs/theory/sphere_bonds.md, sections 1 to 5.
#include "model/validate.h"
#include "support/spheres.h"

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

constexpr BondSprings stiff{3.0, 1.7, 0.9, 0.6};  // no two alike; [N/m], [N m]

/// Spheres of radii 0.5 and 0.8 along a slanted line.
Assembly slanted_pair(bool incremental, double damping = 0.0, const BondSprings& k = stiff)
{
    Assembly a = sphere_assembly(unbreakable_bond(incremental, damping));
    sphere(a, {0.3, -0.2, 0.1}, 0.5);
    sphere(a, Vec3{0.3, -0.2, 0.1} + 1.3 * Vec3{0.48, 0.6, 0.64}, 0.8);
    join(a, 0, 1, k);
    build_incidence(a.state);
    start_bonds(a.model, a.state);
    return a;
}

void deform(State& s, int& draw, double size)
{
    for (const int i : {0, 1}) {
        shift(s, i, size * random_vector(draw));
        turn(s, i, random_turn(draw, size));
    }
}

/// Velocities that lead to where the bodies will be after dt, and then go there.
void give_motion(State& s, int& draw, double speed)
{
    for (const int i : {0, 1}) {
        s.bodies.velocity.at(i) = speed * random_vector(draw);
        s.bodies.angular_velocity.at(i) = speed * random_vector(draw);
    }
}
void follow_motion(State& s, double dt)
{
    for (const int i : {0, 1}) {
        shift(s, i, dt * s.bodies.velocity[i]);
        const Vec3 w = s.bodies.angular_velocity[i];
        if (norm(w) > 0.0) turn(s, i, from_axis_angle(normalized(w), dt * norm(w)));
    }
}

double imbalance(const State& s)
{
    const Vec3 d = s.bodies.position[1] - s.bodies.position[0], F = s.slots.force[0];
    const Vec3 sum = s.slots.torque_a[0] + s.slots.torque_b[0] + cross(d, F);
    return norm(sum) / (norm(d) * norm(F) + norm(s.slots.torque_a[0]) + norm(s.slots.torque_b[0]));
}

double energy(Assembly& a)
{
    evaluate_bonds(a);
    return a.state.sphere_bonds.stored_energy[0];
}

}  // namespace

TEST_CASE("a sphere bond's forces and moments balance in any state")
{
    int draw = 0;
    double worst = 0.0;
    for (const bool incremental : {false, true}) {
        for (int k = 0; k < 100; ++k) {
            Assembly a = slanted_pair(incremental, 0.3);
            deform(a.state, draw, 0.3);
            start_bonds(a.model, a.state);
            for (int step = 0; step < 5; ++step) {
                give_motion(a.state, draw, 1.0);
                follow_motion(a.state, 0.05);
                bond_forces(a.model, a.state, 0.05);
                worst = std::max(worst, imbalance(a.state));
            }
            gather_forces(a.model, a.state);
            CHECK(norm(a.state.bodies.force[0] + a.state.bodies.force[1]) == 0.0);
        }
    }
    CHECK(worst < 1e-14);
}

TEST_CASE("the total form is the gradient of its energy")
{
    int draw = 1000;
    double worst = 0.0;
    for (int k = 0; k < 20; ++k) {
        Assembly a = slanted_pair(false);
        deform(a.state, draw, 0.4);
        evaluate_bonds(a);
        const Slots slots = a.state.slots;
        const double scale = norm(slots.force[0]) + norm(slots.torque_a[0]) + norm(slots.torque_b[0]), h = 1e-5;
        for (const int body : {0, 1}) {
            const Vec3 force = body == 0 ? -slots.force[0] : slots.force[0];
            const Vec3 torque = body == 0 ? slots.torque_a[0] : slots.torque_b[0];
            for (int axis = 0; axis < 3; ++axis) {
                Vec3 e;
                e[axis] = 1.0;
                const Vec3 x = a.state.bodies.position[body];
                const Quat q = a.state.bodies.orientation[body];
                double U[2], T[2];
                for (const int side : {0, 1}) {
                    const double step = side == 0 ? -h : h;
                    set_position(a.state, body, x + step * e);
                    U[side] = energy(a);
                    set_position(a.state, body, x);
                    set_orientation(a.state, body, normalized(from_axis_angle(e, step) * q));
                    T[side] = energy(a);
                    set_orientation(a.state, body, q);
                }
                worst = std::max(worst, std::fabs((U[0] - U[1]) / (2 * h) - force[axis]) / scale);
                worst = std::max(worst, std::fabs((T[0] - T[1]) / (2 * h) - torque[axis]) / scale);
            }
        }
    }
    CHECK(worst < 1e-8);
}

TEST_CASE("the total form turns with its spheres")
{
    int draw = 2000;
    for (int k = 0; k < 20; ++k) {
        Assembly a = slanted_pair(false);
        deform(a.state, draw, 0.4);
        const double U = energy(a);
        const Slots before = a.state.slots;
        const Quat q = random_turn(draw, 3.0);
        move_rigidly(a.state, q, 5.0 * random_vector(draw));
        CHECK(std::fabs(energy(a) - U) < 1e-13 * U);
        CHECK(norm(a.state.slots.force[0] - rotate(q, before.force[0])) < 1e-13 * norm(before.force[0]));
        CHECK(norm(a.state.slots.torque_a[0] - rotate(q, before.torque_a[0])) < 1e-13 * norm(before.torque_a[0]));
        CHECK(norm(a.state.slots.torque_b[0] - rotate(q, before.torque_b[0])) < 1e-13 * norm(before.torque_b[0]));
    }
}

TEST_CASE("both forms agree in small motions, whatever the arms")
{
    int draw = 3000;
    const auto difference = [&](double size) {
        Assembly total = slanted_pair(false), stepped = slanted_pair(true);
        int same = draw;
        give_motion(stepped.state, same, size);
        same = draw;
        give_motion(total.state, same, size);
        for (Assembly* a : {&total, &stepped}) {
            follow_motion(a->state, 1.0);
            bond_forces(a->model, a->state, 1.0);
        }
        const Slots &x = total.state.slots, &y = stepped.state.slots;
        return std::max({norm(x.force[0] - y.force[0]) / norm(x.force[0]),
                         norm(x.torque_a[0] - y.torque_a[0]) / norm(x.torque_a[0]),
                         norm(x.torque_b[0] - y.torque_b[0]) / norm(x.torque_b[0])});
    };
    for (int k = 0; k < 10; ++k, draw += 100) {
        const double coarse = difference(1e-4), fine = difference(1e-5);
        CHECK(fine < 1e-4);
        CHECK(fine == Approx(0.1 * coarse).epsilon(0.1));  // the difference is of second order in the motion
    }
}

namespace {

/// Largest change of force and moment, relative, in the frame of a pair that is turned rigidly by `angle` in `steps`.
double drift_in_rotation(bool incremental, double angle, int steps)
{
    int draw = 4000;
    Assembly a = slanted_pair(incremental);
    give_motion(a.state, draw, 0.05);
    follow_motion(a.state, 1.0);
    bond_forces(a.model, a.state, 1.0);  // strained now
    const Slots before = a.state.slots;
    const Vec3 axis = normalized(Vec3{1, -2, 3}), centre{0.7, 0.4, -0.3};
    const double dt = 1e-3, turned = angle / steps;
    const Vec3 from[2] = {a.state.bodies.position[0], a.state.bodies.position[1]};
    const Quat q[2] = {a.state.bodies.orientation[0], a.state.bodies.orientation[1]};
    for (int i = 1; i <= steps; ++i) {
        const Quat turn = from_axis_angle(axis, i * turned);
        for (const int body : {0, 1}) {
            const Vec3 x = centre + rotate(turn, from[body] - centre);
            a.state.bodies.velocity.at(body) = (x - a.state.bodies.position[body]) / dt;  // leapfrog
            a.state.bodies.angular_velocity.at(body) = (turned / dt) * axis;
            set_position(a.state, body, x);
            set_orientation(a.state, body, normalized(turn * q[body]));
        }
        bond_forces(a.model, a.state, dt);
    }
    const Quat turn = from_axis_angle(axis, angle);
    const Slots& after = a.state.slots;
    return std::max(norm(after.force[0] - rotate(turn, before.force[0])) / norm(before.force[0]),
                    norm(after.torque_b[0] - rotate(turn, before.torque_b[0])) / norm(before.torque_b[0]));
}

}  // namespace

TEST_CASE("a strained bond that turns ten times holds the force it had")
{
    const double turns = 20.0 * std::numbers::pi;
    CHECK(drift_in_rotation(false, turns, 2000) < 1e-12);
    const double coarse = drift_in_rotation(true, turns, 20000), fine = drift_in_rotation(true, turns, 40000);
    CHECK(coarse / fine == Approx(4.0).margin(0.1));
    CHECK(drift_in_rotation(true, turns, 800000) < 1e-6);
}

TEST_CASE("the force of a sheared bond turns with it by a right angle")
{
    CHECK(drift_in_rotation(true, 0.5 * std::numbers::pi, 20000) < 1e-6);
}

TEST_CASE(
    "equal bonds share their constants, and arrays that no law needs are empty: the forces are the same to the bit")
{
    for (const bool incremental : {false, true}) {
        for (const double zeta : {0.0, 0.2}) {
            int draw = 0;
            Assembly a = sphere_assembly(unbreakable_bond(incremental, zeta));
            sphere(a, {}, 0.5);
            for (int i = 1; i < 40; ++i) {
                sphere(a, {1.0 * i, 0, 0}, 0.5);
                join(a, i - 1, i, {3.0 + i % 4, 1.7, 0.9, 0.6});
            }
            build_incidence(a.state);
            start_bonds(a.model, a.state);
            Assembly settled = a;
            settle(settled.model, settled.state.sphere_bonds);
            SphereBonds &p = settled.state.sphere_bonds, &q = a.state.sphere_bonds;
            CHECK(p.kinds.size() == 4);
            CHECK(p.axis_a.empty() == incremental);
            CHECK(p.shear_force.empty() == !incremental);
            CHECK(p.viscous_force.empty() == (zeta == 0.0));
            for (int step = 0; step < 3; ++step) {
                for (int i = 0; i < 40; ++i) {
                    const Vec3 u = 1e-3 * random_vector(draw), v = random_vector(draw), w = random_vector(draw);
                    for (State* s : {&a.state, &settled.state}) {
                        shift(*s, i, u);
                        turn(*s, i, from_axis_angle(normalized(w), 1e-3));
                        s->bodies.velocity.at(i) = v;
                        s->bodies.angular_velocity.at(i) = w;
                    }
                }
                sphere_bond_forces(a.model, a.state, 1e-3);
                sphere_bond_forces(settled.model, settled.state, 1e-3);
                for (int i = 0; i < q.size(); ++i) {
                    CHECK(settled.state.slots.force[i] == a.state.slots.force[i]);
                    CHECK(settled.state.slots.torque_b[i] == a.state.slots.torque_b[i]);
                    CHECK(p.stored_energy[i] == q.stored_energy[i]);
                    CHECK(p.viscous_work[i] == q.viscous_work[i]);
                }
            }
            CHECK(state_hash(settled.state) == state_hash(a.state));
        }
    }
}
