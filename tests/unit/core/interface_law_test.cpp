// SPDX-License-Identifier: GPL-3.0-or-later
// The cohesive law of one interface point: dissipation, reversibility, friction.
#include "fracture/interface_law.h"

#include "model/random.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace grainfrac;

namespace {

constexpr double k_n = 1e6, k_s = 4e5;

InterfaceLaw cohesive()
{
    InterfaceLaw l{};
    l.tensile_strength = 50;
    l.cohesion = 80;
    l.friction = 0.5;
    l.residual_friction = 0.4;
    l.fracture_energy_I = 0.03;
    l.fracture_energy_II = 0.09;
    l.mixed_mode_exponent = 1.8;
    l.onset = OnsetSurface::quadratic;
    l.softening = Softening::bilinear;
    l.failure = FailureUnit::point;
    l.mixed_mode = MixedMode::benzeggagh_kenane;
    return l;
}

/// A path of jumps with the account of work, storage and dissipation along it.
struct Walker {
    InterfaceLaw law = cohesive();
    InterfacePointState p;
    InterfaceResponse last;
    double d[3] = {0, 0, 0};
    double work = 0, fracture = 0, friction = 0, least_fracture_step = 0, least_friction_step = 0;

    void to(double n, double s1, double s2)
    {
        const InterfaceResponse r = law({n, s1, s2}, {d[0], d[1], d[2]}, k_n, k_s, 1.0, 1.0, true, false, p);
        work += 0.5 * ((r.normal + last.normal) * (n - d[0]) + (r.shear1 + last.shear1) * (s1 - d[1]) +
                       (r.shear2 + last.shear2) * (s2 - d[2]));
        fracture += r.fracture_work;
        friction += r.friction_work;
        least_fracture_step = std::fmin(least_fracture_step, r.fracture_work);
        least_friction_step = std::fmin(least_friction_step, r.friction_work);
        d[0] = n;
        d[1] = s1;
        d[2] = s2;
        last = r;
    }
};

double dissipated_at_angle(double degrees)
{
    Walker w;
    const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
    for (int i = 1; i <= 20000; ++i) w.to(i * 5e-7 * c, i * 5e-7 * s, 0);
    CHECK(w.p.damage == 1.0);
    return w.fracture;
}

}  // namespace

TEST_CASE("proportional opening dissipates the fracture energy of its mode mix")
{
    const double angle[] = {0, 20, 45, 70, 90}, expected[] = {0.030000, 0.030276, 0.036293, 0.065853, 0.090000};
    for (int i = 0; i < 5; ++i) {
        const double G = dissipated_at_angle(angle[i]);
        CHECK(G == Approx(expected[i]).margin(5e-7));  // the table has six decimals
        const double B = k_s * std::pow(std::sin(angle[i] * std::numbers::pi / 180), 2) /
                         (k_n * std::pow(std::cos(angle[i] * std::numbers::pi / 180), 2) +
                          k_s * std::pow(std::sin(angle[i] * std::numbers::pi / 180), 2));
        CHECK(G == Approx(0.03 + 0.06 * std::pow(B, 1.8)).epsilon(1e-8));
    }
}

TEST_CASE("unloading and reloading dissipates nothing")
{
    Walker w;
    for (int i = 1; i <= 100; ++i) w.to(i * 2e-6, i * 1e-6, 0);
    REQUIRE(w.p.damage > 0.1);
    REQUIRE(w.p.damage < 1.0);
    const double before = w.fracture, damage = w.p.damage;
    for (int i = 100; i >= 0; --i) w.to(i * 2e-6, i * 1e-6, 0);
    CHECK(std::fabs(w.last.normal) < 1e-12);
    for (int i = 0; i <= 100; ++i) w.to(i * 2e-6, i * 1e-6, 0);
    CHECK(w.fracture == before);
    CHECK(w.p.damage == damage);
}

TEST_CASE("shear box: peak c + p tan(phi), residual mu_r p, unloading with k_s")
{
    for (const double step : {1e-8, 1e-7}) {
        Walker w;
        const double p = 20, closing = -p / k_n;
        w.to(closing, 0, 0);
        double peak = 0;
        int i = 1;
        for (; w.p.damage < 1.0; ++i) {
            w.to(closing, i * step, 0);
            peak = std::fmax(peak, w.last.shear1);
            REQUIRE(w.last.normal == Approx(-p));
        }
        CHECK(peak == Approx(90).epsilon(step * k_s / 90));  // one increment of traction
        for (int k = 0; k < 100; ++k) w.to(closing, w.d[1] + 1e-6, 0);
        CHECK(w.last.shear1 == Approx(8).epsilon(1e-12));
        const double s = w.d[1];
        w.to(closing, s - 1e-6, 0);
        CHECK((8 - w.last.shear1) / 1e-6 == Approx(k_s).epsilon(1e-9));
        w.to(closing, s - 1e-3, 0);
        CHECK(w.last.shear1 == Approx(-8).epsilon(1e-12));
    }
}

TEST_CASE("confinement beyond G_II makes the point brittle and books the excess")
{
    Walker w;  // (c + p tan(phi))^2 / k_s = 0.324 at p = 560: lambda_0^2 > 2 G_II
    const double p = 560;
    w.to(-p / k_n, 0, 0);
    for (int i = 1; w.p.damage == 0.0; ++i) w.to(-p / k_n, i * 1e-8, 0);
    CHECK(w.p.damage == 1.0);
    const double onset = 80 + 0.5 * p;
    CHECK(w.fracture == Approx(onset * onset / (2 * k_s)).epsilon(1e-4));
}

TEST_CASE("random smooth paths: work = stored + dissipated, no dissipation is negative")
{
    for (std::uint32_t path = 0; path < 20; ++path) {
        const auto u = [&](std::uint32_t k) { return uniform_random(3, RandomPurpose::test, path, k); };
        double error[2];
        for (int level = 0; level < 2; ++level) {
            Walker w;
            const int n = 100000 << level;
            for (int i = 1; i <= n; ++i) {
                const double t = static_cast<double>(i) / n * 6.283185307179586;
                w.to(3e-4 * u(0) * std::sin(t * (1 + std::floor(3 * u(1)))) + 1e-4 * (u(2) - 0.5) * std::sin(5 * t),
                     6e-4 * u(3) * std::sin(t * (1 + std::floor(4 * u(4)))),
                     4e-4 * (1 - std::cos(t * (1 + std::floor(2 * u(5))))) * u(6));
            }
            error[level] = std::fabs(w.work - w.last.stored - w.fracture - w.friction);
            CHECK(w.least_friction_step >= 0.0);
            CHECK(w.least_fracture_step >= 0.0);
            CHECK(error[level] < 5e-6 * (w.fracture + w.friction + w.last.stored));
        }
        CHECK(error[1] < 0.5 * error[0] + 1e-10);
    }
}

TEST_CASE("closed paths dissipate")
{
    for (std::uint32_t path = 0; path < 50; ++path) {
        Walker w;
        const auto u = [&](std::uint32_t k) { return 2 * uniform_random(5, RandomPurpose::test, path, k) - 1; };
        for (int i = 1; i <= 2000; ++i) {
            const double t = i / 2000.0 * 6.283185307179586;
            w.to(2e-4 * u(0) * std::sin(t), 4e-4 * u(1) * std::sin(2 * t), 4e-4 * u(2) * (1 - std::cos(t)));
        }
        CHECK(w.work > -1e-9);
    }
}
