// SPDX-License-Identifier: GPL-3.0-or-later
// Waves in a bonded bar of blocks: speed, plateau stress, reflection, lattice dispersion.
#include "motion/energy.h"
#include "motion/time_step.h"
#include "support/assembly.h"

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

/// N unit cubes along x, k = E/h with E = rho = 1: c_0 = 1.
Assembly bar(int N, double damping)
{
    std::vector<GrainSpec> grains;
    for (int i = 0; i < N; ++i) grains.push_back(grain(make_box({1, 1, 1}, {i + 0.5, 0, 0}), {i + 0.5, 0, 0}, 0.02));
    Assembly a = assemble(std::move(grains));
    bond(a, elastic_law(), 0.0, 1.0, 1.0, QuadratureRule::gauss2, damping);
    return a;
}

double stress_at(const State& s, int joint)
{
    return dot(-s.slots.force[joint], Vec3{1, 0, 0});
}

}  // namespace

TEST_CASE("step velocity: sigma = rho c_0 v, arrival at c_0, a free end doubles the velocity")
{
    const int N = 200;
    const double v = 1e-6, dt = 0.1;
    Assembly a = bar(N, 0.1);
    drive(a.state, 0, {v, 0, 0});
    start(a.model, a.state);
    double arrival = 0, plateau = 0, end_velocity = 0;
    int plateau_count = 0, end_count = 0;
    const int joint = 120;  // between blocks 120 and 121: 120 blocks from the face of the driven one's centre
    for (int i = 1; i * dt < 260; ++i) {
        step(a.model, a.state, dt);
        const double t = i * dt, sigma = -stress_at(a.state, joint);
        if (arrival == 0 && sigma > 0.5 * v) arrival = t;
        if (t > 150 && t < 240) {
            plateau += sigma;
            ++plateau_count;
        }
        if (t > 215) {
            end_velocity += a.state.bodies.velocity[N - 1].x;
            ++end_count;
        }
    }
    CHECK(arrival == Approx(120.5).epsilon(0.01));
    CHECK(plateau / plateau_count == Approx(v).epsilon(0.02));
    CHECK(end_velocity / end_count == Approx(2 * v).epsilon(0.02));
    CHECK(energy_ledger(a.model, a.state).relative_error() < 1e-3);
}

TEST_CASE("lattice dispersion: c/c_0 = sin(x)/x, x = pi h/lambda")
{
    for (const auto& [ratio, expected] : {std::pair{10, 0.9836}, {20, 0.9959}, {40, 0.9990}}) {
        // the free bar of N = lambda blocks swings in its second mode, u = cos(2 pi (i + 1/2)/N), with wave length
        // lambda
        const int N = ratio;
        Assembly a = bar(N, 0.0);
        const double x = std::numbers::pi / ratio, amplitude = 1e-7;
        for (int i = 0; i < N; ++i) shift(a.state, i, {amplitude * std::cos(2 * x * (i + 0.5)), 0, 0});
        start(a.model, a.state);
        const double dt = 0.02;
        double crossing[2] = {0, 0}, last = amplitude;
        int found = 0;
        for (int k = 1; found < 2; ++k) {
            step(a.model, a.state, dt);
            const double u = a.state.bodies.position[0].x - 0.5;
            if ((u > 0) != (last > 0)) crossing[found++] = (k - u / (u - last)) * dt;
            last = u;
        }
        const double omega = std::numbers::pi / (crossing[1] - crossing[0]);
        const double c = omega * ratio / (2 * std::numbers::pi);
        CHECK(c == Approx(std::sin(x) / x).epsilon(1e-4));
        CHECK(c == Approx(expected).margin(1e-4));
    }
}

TEST_CASE("time step bound: exact for the infinite chain, never above the stable limit")
{
    const int N = 60;
    const auto grows = [&](double share) {
        Assembly a = bar(N, 0.0);
        start(a.model, a.state);
        const double limit = time_step_bound(a.model, a.state).critical;
        // 6x6 bound of an inner block: the axial mode has lambda = 2 k/m, so that sqrt(2/lambda) = 1; bending is
        // stiffer
        CHECK(limit <= 1.0);
        int draw = 0;
        for (int i = 0; i < N; ++i) shift(a.state, i, 1e-9 * random_vector(draw));
        start(a.model, a.state);
        const double E0 = a.state.initial_energy;
        for (int i = 0; i < 4000; ++i) step(a.model, a.state, share * limit);
        const Ledger e = energy_ledger(a.model, a.state);
        return (e.kinetic + e.elastic_bonds) / E0;
    };
    CHECK(grows(0.99) < 20);

    // doubling all masses lengthens the step by sqrt(2)
    Assembly light = bar(10, 0.0), heavy = bar(10, 0.0);
    for (auto* p : {&heavy}) {
        for (double& m : p->state.bodies.mass.host()) m *= 2;
        for (double& m : p->state.bodies.inverse_mass.host()) m *= 0.5;
        for (Vec3& I : p->state.bodies.inverse_inertia.host()) I *= 0.5;
    }
    CHECK(time_step_bound(heavy.model, heavy.state).critical ==
          Approx(std::sqrt(2.0) * time_step_bound(light.model, light.state).critical).epsilon(1e-12));
}

TEST_CASE("time step of the honeycomb of SiC: 5.96e-8 s")
{
    // r = 0.6 mm, t = 1.3 mm, nu = 0.17: lambda_max = 5.629e14 1/s^2, rotation about z
    const double r = 0.6, t = 1.3, k_n = 4.7533e5, k_s = 1.9907e5;
    std::vector<GrainSpec> grains;
    const double h = std::numbers::sqrt3 * r;
    grains.push_back(grain(make_hexagonal_prism(r, t), {}));
    for (int k = 0; k < 6; ++k) {
        const Vec3 c{h * std::cos(k * std::numbers::pi / 3), h * std::sin(k * std::numbers::pi / 3), 0};
        grains.push_back(grain(make_hexagonal_prism(r, t, c), c));
    }
    Assembly a = assemble(std::move(grains), 3.1e-9);
    bond(a, elastic_law(), 0.0, k_n, k_s / k_n);
    const TimeStepBound b = time_step_bound(a.model, a.state);
    CHECK(b.body == 0);
    CHECK(2 / (b.critical * b.critical) == Approx(5.629e14).epsilon(2e-4));
    CHECK(b.critical == Approx(5.96e-8).epsilon(1e-3));
}
