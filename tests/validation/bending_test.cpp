// SPDX-License-Identifier: GPL-3.0-or-later
// Ready-made tests against closed forms: uniaxial modulus, bending, notched beam, double cantilever beam, drop.
#include "experiment/bending.h"

#include "experiment/dcb.h"
#include "experiment/specimen.h"
#include "fracture/grain_stress.h"
#include "support/disc.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <numbers>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

constexpr double r = 0.6e-3, t = 1.3e-3, E = 410e9;
const double pitch = std::numbers::sqrt3 * r;

/// Layer of whole hexagons, elastic, nu = 0 (k_n = k_s = E/h).
Case layer(int columns, int rows, const char* kind)
{
    Case c;
    c.simulation.seed = 1;
    c.materials = {{"sic", 3100, E, 0.17}};
    PartSpec p;
    p.name = "layer";
    p.material = "sic";
    p.side = r;
    p.thickness = t;
    p.region.size = {pitch * columns * 1.0001, 1.5 * r * rows + 0.4 * r, t};
    p.orientation.choices = {0.0};
    c.parts = {p};
    BondSpec b;
    b.failure = "unbreakable";
    b.damping = 0.2;
    c.bonds = {b};
    c.contacts = {ContactSpec{}};
    c.test.kind = kind;
    c.test.platen_speed = 0.02;
    return c;
}

/// Load for `ramps` times the ramp of the test, the last step with stresses; the course of the load.
std::vector<CurvePoint> load_up(Built& b, double ramps, int rows = 400)
{
    begin(b);
    const double dt = stable_step(b);
    const int steps = static_cast<int>(ramps * b.experiment.stages.front().ramp / dt),
              every = std::max(1, steps / rows);
    std::vector<CurvePoint> curve;
    for (int i = 1; i <= steps; ++i) {
        step(b.model, b.state, dt, i == steps);
        if (i % every != 0) continue;
        const Measurement m = measure(b.experiment, b.model, b.state);
        curve.push_back({b.state.time, m.load, m.strain, m.stress});
    }
    return curve;
}

/// Slope of y over x through the points, least squares.
double slope(const std::vector<double>& x, const std::vector<double>& y)
{
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    const double n = static_cast<double>(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        sx += x[i];
        sy += y[i];
        sxx += x[i] * x[i];
        sxy += x[i] * y[i];
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace

TEST_CASE("uniaxial tension: E_app of the clamped honeycomb is 0.875 E along y, 1 - 1/(3 n) along x")
{
    Case c = layer(4, 11, "uniaxial_tension");
    Built b = build(c, default_device());
    CHECK(b.experiment.specimen.length == Approx(10 * 1.5 * r));
    CHECK(b.experiment.specimen.stress_area == Approx(4 * pitch * t).epsilon(1e-3));
    const double along_y = secant_modulus(load_up(b, 3)) / E;
    WARN("E_app/E along y " << along_y << " (0.875)");
    CHECK(along_y == Approx(0.875).epsilon(2e-3));  // waves at this speed: kinetic over elastic energy 1e-4

    // the grips hold staggered columns at one displacement: the difference of two lengths is free of what they add
    double compliance[2], length[2];
    for (const int k : {0, 1}) {
        c = layer(k == 0 ? 9 : 18, 5, "uniaxial_tension");
        c.test.direction = "x";
        b = build(c, default_device());
        length[k] = b.experiment.specimen.length;
        compliance[k] = length[k] / secant_modulus(load_up(b, 3));
    }
    const double along_x = (length[1] - length[0]) / (compliance[1] - compliance[0]) / E;
    WARN("E_app/E along x " << along_x << " (" << 1 - 1.0 / 15 << ")");
    CHECK(along_x == Approx(1 - 1.0 / 15).epsilon(2e-3));
}

TEST_CASE("uniaxial: compression with gripped ends is as stiff as tension")
{
    double modulus[2];
    for (const int k : {0, 1}) {
        Case c = layer(4, 11, k == 0 ? "uniaxial_tension" : "uniaxial_compression");
        c.test.ends = "gripped";
        Built b = build(c, default_device());
        modulus[k] = secant_modulus(load_up(b, 2));
    }
    CHECK(modulus[0] == Approx(modulus[1]).epsilon(1e-3));
}

/// Bending moment about the middle of the beam, from what the rollers on its left do to it: their friction included.
double moment_at_mid_span(const Built& b, const Vec3& middle)
{
    double M = 0;
    for (int i = 0; i < b.state.bodies.size(); ++i) {
        const Vec3 arm = b.state.bodies.position[i] - middle;
        if (b.state.bodies.wall[i] < 0 || arm.x > 0.0) continue;
        M += cross(arm, b.state.bodies.force[i]).z + b.state.bodies.torque[i].z;  // on the roller: the beam's opposite
    }
    return M;
}

// The free zigzag rows lower the bending stiffness of n rows to (1 - 1/(3 n))^3 E I, as they lower the tensile one to
// 1 - 1/(3 n); so the interior rows bear sigma_xx = M y/((1 - 1/(3 n))^3 I). The lattice itself is off by 2.3 % at 5
// rows.
TEST_CASE("four-point bending: slope of the grain stress over the height is M/I_effective within 2.3 % at 5 rows")
{
    const int rows = 5;
    Case c = layer(31, rows, "four_point_bending");
    c.test.outer_span = 28 * pitch;
    c.test.inner_span = 14 * pitch;
    c.bonds[0].damping = 0.5;
    Built b = build(c, default_device());
    load_up(b, 1.2);
    const Measurement m = measure(b.experiment, b.model, b.state);
    const double w = 1.5 * r * rows, I = t * w * w * w / 12.0;
    const Extent box = specimen_extent(b.model, b.state);
    const double M = moment_at_mid_span(b, box.center()),
                 nominal = 0.25 * m.load * (c.test.outer_span - c.test.inner_span);
    CHECK(m.stress == Approx(nominal * 0.5 * w / I).epsilon(1e-3));  // sigma = 3 P L_i/(t w^2)
    const std::vector<Mat3> stress = grain_stress(b.model, b.state);
    std::map<long, std::pair<double, int>> of_row;
    for (int i = 0; i < b.state.bodies.size(); ++i) {
        const Vec3 x = b.state.bodies.start_position[i] - box.center();
        if (b.state.bodies.inverse_mass[i] == 0.0 || std::fabs(x.x) > 3.0 * pitch) continue;
        auto& [sum, n] = of_row[std::lround(x.y / (1.5 * r))];
        sum += stress[static_cast<std::size_t>(i)][0].x;
        ++n;
    }
    REQUIRE(static_cast<int>(of_row.size()) == rows);
    std::vector<double> y, s;
    for (const auto& [row, sum] : of_row) {
        if (std::labs(row) > 1) continue;  // the free zigzag rows
        y.push_back(1.5 * r * static_cast<double>(row));
        s.push_back(sum.first / sum.second);
    }
    const double effective = I * std::pow(1.0 - 1.0 / (3.0 * rows), 3);
    const double ratio = -slope(y, s) / (std::fabs(M) / effective);
    WARN("slope of sigma_xx over the height is " << ratio << " of M/I_effective; M is " << std::fabs(M) / nominal
                                                 << " of P L_i/2; platen imbalance " << m.platen_imbalance);
    CHECK(ratio == Approx(1.0).margin(0.023));
}

TEST_CASE("notch factor: pure bending and the three-point values of ASTM E399 and of S/W = 8")
{
    for (const double a : {0.1, 0.3, 0.5}) {
        // Brown and Srawley 1966, S/W = 8
        const double eight = 1.107 + a * (-1.552 + a * (7.71 + a * (-13.55 + a * 14.25)));
        CHECK(notch_factor(a, 8.0) == Approx(eight).epsilon(0.01));
        CHECK(notch_factor(a, 1e9) == Approx(notch_factor(a, 0.0)).epsilon(1e-6));
    }
    CHECK(notch_factor(0.5, 4.0) * std::sqrt(std::numbers::pi * 0.5) * 6.0 / 4.0 ==
          Approx(2.66).epsilon(0.005));  // E399: K B sqrt(W) W/(P S) = 2.66 at a/W = 0.5
}

TEST_CASE("drop: first contact after sqrt(2 h/g), no force before, momentum of the fall")
{
    Case c = layer(2, 2, "drop");
    c.bonds.clear();
    c.contacts[0].normal_stiffness = 1e11;
    c.test.drop_height = 1e-3;
    c.test.stop.time = 0.02;
    Built b = build(c, default_device());
    begin(b);
    const double g = 9.81, fall = std::sqrt(2 * c.test.drop_height / g), dt = stable_step(b);
    while (measure(b.experiment, b.model, b.state).load == 0.0 && b.state.time < 2 * fall) {
        REQUIRE(total_momentum(b.model, b.state).linear.z ==
                Approx(-total_momentum(b.model, b.state).mass * g * b.state.time).margin(1e-18));
        step(b.model, b.state, dt);
    }
    CHECK(b.state.time >= fall * (1 - 1e-9));
    CHECK(b.state.time - fall < 2 * dt);
    // rebound without loss: the momentum turns round
    const double p = total_momentum(b.model, b.state).mass * g * fall;
    while (measure(b.experiment, b.model, b.state).load > 0.0) step(b.model, b.state, dt);
    CHECK(total_momentum(b.model, b.state).linear.z == Approx(p).epsilon(0.01));
    CHECK(energy_ledger(b.model, b.state).relative_error() < 1e-3);
}

TEST_CASE("double cantilever beam: release rate is the derivative of the compliance, a quarter of that of free ends")
{
    const double EI = 3.0, b = 0.7, f = 0.4, a = 2.0, da = 1e-5;
    const auto arms = [&](double length) { return DcbArms{length + f, f, EI, b}; };
    const double slope = (arms(a + da).compliance() - arms(a - da).compliance()) / (2 * da);
    CHECK(arms(a).release_rate(5.0) == Approx(25.0 / (2 * b) * slope).epsilon(1e-8));
    CHECK(arms(a).release_rate(5.0) == Approx(0.25 * 25.0 * (a + f) * (a + f) / (b * EI)).epsilon(1e-12));
}

TEST_CASE("lengths that do not fit the specimen are refused, with the key that is wrong")
{
    const auto wrong_key = [](Case c) {
        try {
            build(c, default_device());
        } catch (const InputError& e) {
            return e.problems.front().key;
        }
        return std::string();
    };
    Case c = layer(19, 6, "three_point_bending");
    c.test.outer_span = 16e-3;
    CHECK(wrong_key(c) == "");
    c.test.outer_span = 21e-3;
    CHECK(wrong_key(c) == "test.outer_span");
    c.test.outer_span = 16e-3;
    c.test.roller_radius = 8e-3;
    CHECK(wrong_key(c) == "test.roller_radius");
    c = layer(19, 6, "notched_beam");
    c.test.outer_span = 16e-3;
    c.test.notch_depth = 6e-3;
    CHECK(wrong_key(c) == "test.notch_depth");
    c.test.notch_depth = 2e-3;
    CHECK(wrong_key(c) == "");
    c = layer(19, 6, "dcb");
    c.test.crack_length = 21e-3;
    CHECK(wrong_key(c) == "test.crack_length");
    c.test.crack_length = 0.5e-3;  // within the grips
    CHECK(wrong_key(c) == "test.crack_length");
    c.test.crack_length = 10e-3;
    CHECK(wrong_key(c) == "");
    c = layer(4, 11, "uniaxial_tension");
    c.test.grip_length = 6e-3;
    CHECK(wrong_key(c) == "test.grip_length");
    c.test.grip_length = 1e-6;
    CHECK(wrong_key(c) == "test.grip_length");
}
