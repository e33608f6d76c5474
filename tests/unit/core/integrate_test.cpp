// SPDX-License-Identifier: GPL-3.0-or-later
// Free rotation and flight against their exact solutions.
#include "motion/integrate.h"

#include "motion/energy.h"
#include "support/assembly.h"

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

/// One body with given principal moments, no forces.
Assembly free_body(const Vec3& inertia)
{
    Assembly a = assemble({grain(make_box({1, 1, 1}), {})});
    a.state.bodies.inertia.host()[0] = inertia;
    a.state.bodies.inverse_inertia.host()[0] = {1 / inertia.x, 1 / inertia.y, 1 / inertia.z};
    a.state.bodies.inverse_mass.host()[0] = a.state.bodies.mass.host()[0] = 1.0;
    return a;
}

Quat orientation_after(double dt, double time)
{
    Assembly a = free_body({1, 2, 3});
    a.state.bodies.angular_momentum.host()[0] = {0.01, 2, 0.01};
    const int steps = static_cast<int>(std::lround(time / dt));
    for (int i = 0; i < steps; ++i) drift(a.model, a.state, dt);
    return a.state.bodies.orientation[0];
}

double angle_between(const Quat& a, const Quat& b)
{
    return norm(rotation_vector(conjugate(a) * b));
}

double rotational_energy(const State& s)
{
    const Vec3 L = s.bodies.angular_momentum[0], I = s.bodies.inertia[0];
    return 0.5 * (L.x * L.x / I.x + L.y * L.y / I.y + L.z * L.z / I.z);
}

}  // namespace

TEST_CASE("sine and cosine of small and large turns to an ulp")
{
    long double worst = 0;
    for (int i = 0; i < 20000; ++i) {
        const double angle = (i % 2 == 0 ? 1 : -1) * 0.2 * std::pow(10.0, -9.0 * i / 20000);
        const SineCosine found = sine_cosine(angle);
        const long double x = angle;
        worst = std::max(worst, std::fabs((found.sine - std::sin(x)) / std::sin(x)));
        worst = std::max(worst, std::fabs((found.cosine - std::cos(x)) / std::cos(x)));
    }
    CHECK(worst < 1.2e-16L);
    CHECK(sine_cosine(0.0).sine == 0.0);
    CHECK(sine_cosine(0.0).cosine == 1.0);
}

TEST_CASE("free rotation about the unstable axis is second order")
{
    // The reference is the same scheme at a step 16 times smaller: its own error is 1/256 of the finest tested.
    const double time = 8.0;
    const Quat exact = orientation_after(0.02 / 64, time);
    const double e1 = angle_between(orientation_after(0.02, time), exact);
    const double e2 = angle_between(orientation_after(0.01, time), exact);
    const double e3 = angle_between(orientation_after(0.005, time), exact);
    CHECK(e1 / e2 == Approx(4.0).margin(0.1));
    CHECK(e2 / e3 == Approx(4.0).margin(0.1));
}

TEST_CASE("free rotation keeps energy without drift and the momentum in space")
{
    Assembly a = free_body({1, 2, 3});
    a.state.bodies.angular_momentum.host()[0] = {0.01, 2, 0.01};
    const double E0 = rotational_energy(a.state);
    const Vec3 L0 = rotate(a.state.bodies.orientation[0], a.state.bodies.angular_momentum[0]);
    double worst_first = 0.0, worst_last = 0.0, worst_L = 0.0;
    const int steps = 100000;
    for (int i = 0; i < steps; ++i) {
        drift(a.model, a.state, 0.02);
        const double error = std::fabs(rotational_energy(a.state) / E0 - 1.0);
        (i < steps / 2 ? worst_first : worst_last) = std::max(i < steps / 2 ? worst_first : worst_last, error);
        worst_L =
            std::max(worst_L, norm(rotate(a.state.bodies.orientation[0], a.state.bodies.angular_momentum[0]) - L0));
    }
    CHECK(worst_first < 3e-6);
    CHECK(worst_last < 1.01 * worst_first);
    // round-off of 1e5 rotations walks: sqrt(1e5) 1e-16 x 5 factors
    CHECK(worst_L < 1e-12 * norm(L0) * 2.0);
}

TEST_CASE("flight under gravity is exact")
{
    Assembly a = assemble({grain(make_box({1e-3, 1e-3, 1e-3}), {}, 1e-5)}, 3100.0);
    a.model.skin = 1e-4;
    a.model.gravity = {0, 0, -9.807};
    const Vec3 v0{0.3, -0.2, 1.0};
    a.state.bodies.velocity.host()[0] = v0;
    start(a.model, a.state);
    const int steps = 1000;
    const double dt = 1e-4;
    for (int i = 0; i < steps; ++i) step(a.model, a.state, dt);
    const double t = steps * dt;
    const Vec3 expected = t * v0 + (0.5 * t * t) * a.model.gravity;
    CHECK(norm(a.state.bodies.position[0] - expected) < 1e-13);
    const Ledger e = energy_ledger(a.model, a.state);
    CHECK(std::fabs(e.residual()) < 1e-12 * e.kinetic);
}

TEST_CASE("a fall of 50 mm takes 0.100979 s and ends with 0.99030 m/s")
{
    Assembly a = assemble({grain(make_box({1e-3, 1e-3, 1e-3}), {}, 1e-5)}, 3100.0);
    a.model.gravity = {0, 0, -9.807};
    start(a.model, a.state);
    const double time = std::sqrt(2 * 0.05 / 9.807), dt = time / 1000;
    for (int i = 0; i < 1000; ++i) step(a.model, a.state, dt);
    CHECK(time == Approx(0.100979).epsilon(1e-5));
    CHECK(a.state.bodies.position[0].z == Approx(-0.05).epsilon(1e-12));
    CHECK(a.state.bodies.velocity[0].z == Approx(-0.99030).epsilon(1e-5));
}
