// SPDX-License-Identifier: GPL-3.0-or-later
// The Brazilian disc: stresses against Hondros (1959), rest without bonds, invariances, determinism, energy account.
#include "contact/find_contacts.h"
#include "fracture/grain_stress.h"
#include "gpu/thread_pool.h"
#include "support/assembly.h"
#include "support/disc.h"

#include <numbers>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

/// Hondros, arc half-angle alpha under uniform pressure q, s = r/R; on the loaded diameter and across it.
struct Stresses {
    double across, along;  // normal to the load, along it
};
Stresses on_loaded_diameter(double s, double alpha, double q)
{
    const double s2 = s * s, a = (1 - s2) * std::sin(2 * alpha) / (1 - 2 * s2 * std::cos(2 * alpha) + s2 * s2);
    const double b = std::atan((1 + s2) / (1 - s2) * std::tan(alpha));
    return {2 * q / std::numbers::pi * (a - b), -2 * q / std::numbers::pi * (a + b)};
}
Stresses on_cross_diameter(double s, double alpha, double q)
{
    const double s2 = s * s, a = (1 - s2) * std::sin(2 * alpha) / (1 + 2 * s2 * std::cos(2 * alpha) + s2 * s2);
    const double b = std::atan((1 - s2) / (1 + s2) * std::tan(alpha));
    return {2 * q / std::numbers::pi * (a - b), -2 * q / std::numbers::pi * (a + b)};
}

Case coarse_case()
{
    Case c = disc_case(1.1e-3, false);
    c.bonds[0].tensile_strength = 60e6;
    c.bonds[0].cohesion = 150e6;
    c.bonds[0].weibull_modulus = 8;
    c.test.platen_speed = 0.2;
    c.test.contact_half_width = 1.2e-3;
    return c;
}

}  // namespace

TEST_CASE("Hondros' formulas at the values of the literature")
{
    const double s[] = {0, 0.3, 0.6, 0.8}, across[] = {0.301469, 0.290484, 0.203058, -0.219310},
                 along[] = {-0.938088, -1.048688, -1.497746, -2.154087};
    for (int i = 0; i < 4; ++i) {
        CHECK(on_loaded_diameter(s[i], 0.2, 2.5).across == Approx(across[i]).margin(1e-6));
        CHECK(on_loaded_diameter(s[i], 0.2, 2.5).along == Approx(along[i]).margin(1e-6));
    }
}

TEST_CASE("assembly at rest without bonds: nothing presses")
{
    for (const bool cut : {false, true}) {
        Case c = disc_case(0.6e-3, cut);
        c.bonds.clear();
        Built b = build(c, default_device());
        start(b.model, b.state);
        double deepest = 0, strongest = 0;
        for (int i = 0; i < b.state.contacts.size(); ++i) deepest = std::max(deepest, b.state.contacts.point[i].depth);
        for (int i = 0; i < b.state.bodies.size(); ++i) strongest = std::max(strongest, norm(b.state.bodies.force[i]));
        CHECK(b.state.pairs.size() > 400);
        CHECK(deepest < 1e-12 * b.model.nominal_length);
        const double k = b.model.contact_laws[0].area_stiffness * 3e-6;  // largest face
        CHECK(strongest < k * 1e-12 * b.model.nominal_length);
    }
}

TEST_CASE("elastic disc of 3,000 grains: centre stress within 3 %, both diameters within 5 % of Hondros", "[slow]")
{
    Case c = disc_case(0.15e-3, true);
    c.bonds[0].failure = "unbreakable";
    c.bonds[0].quadrature = "cross";
    c.bonds[0].damping = 0.1;
    c.contacts[0].friction = 0;
    c.test.platen = "curved";
    c.test.platen_radius = 7.5e-3;
    c.test.contact_half_width = 0.75e-3;
    c.contacts[0].normal_stiffness = 1.6e15;
    Built b = build(c, default_device());
    REQUIRE(b.state.bodies.size() > 3000);
    begin(b);
    const double dt = stable_step(b);
    const double time = 6.0 * 10 * 15e-3 / b.experiment.wave_speed;  // six ramps
    run_steps(b, dt, static_cast<int>(time / dt));
    step(b.model, b.state, dt, true);
    const std::vector<Mat3> stress = grain_stress(b.model, b.state);
    const double P = measure(b.experiment, b.model, b.state).load;
    const double R = 7.5e-3, t = 5e-3, alpha = 1.5 * 2 * std::numbers::pi / 96;  // three facets press
    const double q = P / (2 * R * t * std::sin(alpha));
    const double centre = 2 * P / (std::numbers::pi * 2 * R * t);

    // mean over the grains near a point, against the mean of the formula over the same grains
    double sx = 0, sy = 0;
    int n = 0;
    for (int i = 0; i < b.state.bodies.size(); ++i) {
        const Vec3 x = b.state.bodies.position[i];
        if (b.state.bodies.inverse_mass[i] == 0 || std::hypot(x.x, x.y) > 0.08 * R) continue;
        sx += stress[static_cast<std::size_t>(i)][0].x;
        sy += stress[static_cast<std::size_t>(i)][1].y;
        ++n;
    }
    const Stresses exact = on_loaded_diameter(0, alpha, q);
    INFO("centre: sigma_x " << sx / n / centre << ", sigma_y " << sy / n / centre << " of 2P/(pi D t); Hondros "
                            << exact.across / centre << ", " << exact.along / centre);
    CHECK(sx / n == Approx(exact.across).epsilon(0.03));
    CHECK(sy / n == Approx(exact.along).epsilon(0.03));

    const auto profile = [&](bool loaded, double from, double to, double& across, double& along, Stresses& expected) {
        int count = 0;
        across = along = 0;
        expected = {0, 0};
        for (int i = 0; i < b.state.bodies.size(); ++i) {
            const Vec3 x = b.state.bodies.position[i];
            const double r = loaded ? x.y : x.x, off = loaded ? x.x : x.y;
            if (b.state.bodies.inverse_mass[i] == 0 || std::fabs(off) > 0.03 * R || std::fabs(r) < from * R ||
                std::fabs(r) >= to * R)
                continue;
            const Stresses h =
                loaded ? on_loaded_diameter(std::fabs(r) / R, alpha, q) : on_cross_diameter(std::fabs(r) / R, alpha, q);
            across += stress[static_cast<std::size_t>(i)][0].x;
            along += stress[static_cast<std::size_t>(i)][1].y;
            expected.across += h.across;
            expected.along += h.along;
            ++count;
        }
        REQUIRE(count > 0);
        across /= count;
        along /= count;
        expected.across /= count;
        expected.along /= count;
    };
    double worst = 0;
    for (const bool loaded : {true, false}) {
        for (double from = 0; from < 0.69; from += 0.1) {
            double across, along;
            Stresses h{};
            profile(loaded, from, from + 0.1, across, along, h);
            INFO((loaded ? "loaded" : "cross")
                 << " diameter, r/R " << from << ": " << across / centre << " (" << h.across / centre << "), "
                 << along / centre << " (" << h.along / centre << ")");
            // 5 % of the local principal stress scale: sigma_x goes through zero near the platens
            CHECK(std::fabs(across - h.across) < 0.05 * std::max(std::fabs(h.across), centre));
            CHECK(std::fabs(along - h.along) < 0.05 * std::max(std::fabs(h.along), centre));
            worst = std::max({worst, std::fabs(across - h.across) / centre,
                              std::fabs(along - h.along) / std::max(std::fabs(h.along), centre)});
        }
    }
    WARN("Hondros: centre sigma_x " << sx / n / exact.across - 1 << ", sigma_y " << sy / n / exact.along - 1
                                    << "; worst on the diameters " << worst);
    const Ledger e = energy_ledger(b.model, b.state);
    CHECK(e.relative_error() < 1e-3);
}

TEST_CASE("threads: same bits for 1 and 2 threads and for two runs, through fracture")
{
    const auto run = [](int n) {
        set_threads(n);
        Built b = build(coarse_case(), default_device());
        begin(b);
        run_steps(b, stable_step(b), 5000);
        CHECK(break_sequence(b.state).size() > 3);
        return state_hash(b.state);
    };
    const std::uint64_t one = run(1), again = run(1), two = run(2);
    CHECK(one == again);
    CHECK(one == two);
}

TEST_CASE("a turned experiment gives the turned result, and the same sequence of breaks")
{
    const Quat q = from_axis_angle(normalized(Vec3{0.3, -0.8, 0.5}), 1.1);
    Built a = build(coarse_case(), default_device()), b = build(coarse_case(), default_device());
    turn_all(b, q);
    begin(a);
    begin(b);
    const double dt = stable_step(a);
    CHECK(stable_step(b) == Approx(dt).epsilon(1e-9));
    // before anything breaks
    while (true) {
        run_steps(a, dt, 20);
        run_steps(b, dt, 20);
        double damaged = 0;
        for (const double t : a.state.interfaces.first_damage_time.host()) damaged = std::max(damaged, t);
        if (damaged > 0) break;
        const double scale = norm(a.state.bodies.position[a.state.bodies.size() - 1] -
                                  a.state.bodies.start_position[a.state.bodies.size() - 1]);
        for (int i = 0; i < a.state.bodies.size(); ++i) {
            const Vec3 u = a.state.bodies.position[i] - a.state.bodies.start_position[i],
                       v = b.state.bodies.position[i] - b.state.bodies.start_position[i];
            // displacements of micrometres on positions of millimetres: 1e-9 of the disc's radius is below 1e-16 m x
            // 1e5
            REQUIRE(norm(rotate(q, u) - v) < 1e-9 * scale + 1e-15);
        }
    }
    CHECK(measure(a.experiment, a.model, a.state).load ==
          Approx(measure(b.experiment, b.model, b.state).load).epsilon(1e-9));
    run_steps(a, dt, 3000);
    run_steps(b, dt, 3000);
    const std::vector<int> first = break_sequence(a.state), second = break_sequence(b.state);
    CHECK(first.size() > 3);
    CHECK(first == second);
}

TEST_CASE("energy account: below 1e-3 through fracture; before it, four times less with half the step")
{
    const auto error_at = [](double safety, double time) {
        Case c = coarse_case();
        c.test.platen_speed = 2.0;
        c.test.ramp = 2e-6;  // rough loading, so that the error is far above round-off
        c.bonds[0].failure = "unbreakable";
        Built b = build(c, default_device());
        begin(b);
        const double dt = time / std::ceil(time / stable_step(b, safety));
        double worst = 0;  // the residual swings with the platens: its envelope has the order
        for (int i = static_cast<int>(std::lround(time / dt)); i > 0; --i) {
            step(b.model, b.state, dt);
            worst = std::max(worst, std::fabs(energy_ledger(b.model, b.state).residual()));
        }
        return worst;
    };
    const double e1 = error_at(0.4, 2e-5), e2 = error_at(0.2, 2e-5), e3 = error_at(0.1, 2e-5);
    CHECK(e1 / e2 == Approx(4).margin(0.6));
    CHECK(e2 / e3 == Approx(4).margin(0.4));

    Built b = build(coarse_case(), default_device());
    begin(b);
    // 46 grains, violent: every onset cuts a corner of the traction-jump curve, an error of second order in the step
    const double dt = stable_step(b, 0.4);
    double worst = 0;
    for (int i = 0; i < 100; ++i) {
        run_steps(b, dt, 200);
        if (i > 5) worst = std::max(worst, energy_ledger(b.model, b.state).relative_error());
    }
    CHECK(break_sequence(b.state).size() > 3);
    CHECK(worst < 1e-3);
}
