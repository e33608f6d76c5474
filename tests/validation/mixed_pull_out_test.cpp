// SPDX-License-Identifier: GPL-3.0-or-later
// A chain of spheres in a matrix of hexagonal grains. With a matrix that is all but rigid the bar on springs has closed
// forms: u'' = beta^2 u, beta^2 = 2 K_0/(E a), where the interface is whole, u'' = -kappa^2 (delta_1 - u),
// kappa^2 = beta^2 delta_0/(delta_1 - delta_0), where it softens.
#include "experiment/experiment.h"
#include "experiment/fibre_interface.h"
#include "experiment/pull_out.h"
#include "experiment/pull_out_path.h"
#include "motion/energy.h"
#include "motion/step.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace grainfrac;

namespace {

constexpr double side = 1e-3, radius = 0.85e-3, length = 12e-3, modulus = 400e9;
constexpr double shear_stiffness = 1.4e13, yield_slip = 1e-6, failure_slip = 3e-6;

Case mixed_case(double matrix_modulus)
{
    Case c;
    MaterialSpec stiff, matrix_material;
    stiff.name = "stiff";
    stiff.density = matrix_material.density = 3200.0;
    stiff.young_modulus = modulus;
    stiff.poisson_ratio = matrix_material.poisson_ratio = 0.2;
    matrix_material.name = "ceramic";
    matrix_material.young_modulus = matrix_modulus;
    c.materials = {stiff, matrix_material};
    PartSpec matrix, fibre;
    matrix.name = "matrix";
    matrix.material = "ceramic";
    matrix.side = side;
    matrix.thickness = 3e-3;
    matrix.at_region_boundary = "cut";
    matrix.centered = true;
    matrix.region.shape = "cylinder";
    matrix.region.diameter = 6e-3;
    matrix.region.height = length;
    fibre.name = "fibre";
    fibre.kind = "spheres";
    fibre.material = "stiff";
    fibre.generator = "chain";
    fibre.diameter = 0.5e-3;
    fibre.inside = "matrix";
    fibre.fibre.radius = radius;
    fibre.fibre.from = {0.0, 0.0, -0.5 * length};
    fibre.fibre.to = {0.0, 0.0, 0.5 * length + 0.5e-3};
    c.parts = {matrix, fibre};
    BondSpec grains, line, interface;
    grains.between = {"matrix", "matrix"};
    grains.law = "interface";
    grains.failure = "unbreakable";
    line.between = {"fibre", "fibre"};
    line.law = "parallel";
    line.failure = "unbreakable";
    interface.between = {"fibre", "matrix"};
    interface.law = "interface";
    interface.normal_stiffness = interface.shear_stiffness = shear_stiffness;
    interface.yield_slip = yield_slip;
    interface.failure_slip = failure_slip;
    c.bonds = {grains, line, interface};
    c.test.kind = "pull_out";
    c.test.fibre = "fibre";
    c.test.matrix = "matrix";
    return c;
}

const double beta = std::sqrt(2.0 * shear_stiffness / (modulus * radius));

/// Largest stress of the bar on softening springs: over the length of the softening zone at the exit.
double peak_stress()
{
    const double kappa = beta * std::sqrt(yield_slip / (failure_slip - yield_slip));
    double peak = 0.0;
    for (double zone = 0.0; zone <= length; zone += 1e-4 * length) {
        const double slope = beta * yield_slip * std::tanh(beta * (length - zone));
        const double c = std::cos(kappa * zone), s = std::sin(kappa * zone);
        const double slip = failure_slip - (failure_slip - yield_slip) * c + slope / kappa * s;
        if (slip > failure_slip) break;
        peak = std::max(peak, modulus * (kappa * (failure_slip - yield_slip) * s + slope * c));
    }
    return peak;
}

}  // namespace

TEST_CASE("patches of a fibre between grains are the fibre's surface", "[mixed]")
{
    for (const double around : {0.0, 0.2}) {  // of the side: the fibre need not be in the middle of the hole
        Case c = mixed_case(4e11);
        c.parts[1].fibre.radius = 0.6e-3;
        for (Vec3* end : {&c.parts[1].fibre.from, &c.parts[1].fibre.to}) end->x += around * side;
        Built b = build(c, default_device());
        start(b.model, b.state);
        double area = 0.0;
        const std::vector<int> patches = fibre_interfaces(*b.experiment.pull_out, b.state);
        for (const int i : patches) area += b.state.interfaces.area[i];
        CHECK(area == Approx(2.0 * std::numbers::pi * 0.6e-3 * length).epsilon(1e-9));
        CHECK(b.experiment.pull_out->length == Approx(length).epsilon(1e-9));
    }
}

TEST_CASE("a fibre of spheres in stiff grains: stiffness, strength and work of the bar on springs", "[mixed][slow]")
{
    Built b = build(mixed_case(4e13), default_device());
    start(b.model, b.state);
    const PullOut& p = *b.experiment.pull_out;
    PathSettings s;
    s.shift = 1e-5 * length;
    s.damage_step = 0.02;
    PullOutPath path(p, s, b.model, b.state);
    double peak = 0.0, work = 0.0;
    PullOutState before;
    bool first = true;
    while (path.next(b.model, b.state, {}) == PullOutPath::Found::equilibrium) {
        const PullOutState now = pull_out_state(p, b.state);
        if (first) {
            CHECK(now.end_stress / now.exit_slip == Approx(modulus * beta * std::tanh(beta * length)).epsilon(0.005));
            CHECK(now.embedded_slip == Approx(now.exit_slip / std::cosh(beta * length)).epsilon(0.01));
        }
        first = false;
        peak = std::max(peak, now.end_stress);
        work += 0.5 * (now.end_stress + before.end_stress) * (now.end_displacement - before.end_displacement);
        before = now;
    }
    CHECK(peak == Approx(peak_stress()).epsilon(0.002));  // of second order in damage_step
    const double toughness = 0.5 * shear_stiffness * yield_slip * failure_slip;
    const Ledger l = energy_ledger(b.model, b.state);
    CHECK(l.fracture == Approx(toughness * 2.0 * std::numbers::pi * radius * length).epsilon(1e-4));
    CHECK(work == Approx(2.0 * toughness * length / radius).epsilon(0.003));
    CHECK(l.relative_error() < 2e-3);
}
