// SPDX-License-Identifier: GPL-3.0-or-later
// Uniaxial compression between smooth platens: stress, the gate, which planes run, what holds without cleavage.
#include "experiment/cleavage_rules.h"
#include "experiment/specimen.h"
#include "fracture/grain_stress.h"
#include "support/disc.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

constexpr double r = 0.6e-3, t = 1.3e-3;

/// A bar along y with flat ends: 3 1/2 columns, 11 rows, as in examples/uniaxial_cleavage, elastic.
Case bar()
{
    Case c = disc_case(r, true);
    PartSpec& p = c.parts[0];
    p.thickness = t;
    p.region.shape = "box";
    p.region.size = {3.5 * std::sqrt(3.0) * r, 10.2e-3, t};
    c.bonds[0].failure = "unbreakable";
    c.bonds[0].elasticity = "plane";
    CleavageSpec& k = c.materials[0].cleavage;
    k.planes = {"{10-10}"};
    k.toughness = {3.5e6};
    k.flaw_size = 0.3e-3;
    k.friction = 0.85;
    c.contacts[0].friction = 0.0;
    c.test.kind = "uniaxial_compression";
    c.test.platen_speed = 0.05;
    return c;
}

}  // namespace

TEST_CASE(
    "uniaxial compression: between smooth platens the honeycomb of nu = 0 bears -p along the load and nothing across")
{
    Case c = bar();
    c.parts[0].region.size = {13.0 * std::sqrt(3.0) * r, 3.0e-3, t};  // along x cuts go through flats and centres
    c.parts[0].sliver_fraction = 0.05;
    c.test.direction = "x";
    c.bonds[0].elasticity = "homogeneous";
    c.bonds[0].damping = 0.3;
    Built b = build(c, default_device());
    begin(b);
    const double dt = stable_step(b);
    while (b.state.time < 2 * b.experiment.stages.front().ramp) step(b.model, b.state, dt);
    step(b.model, b.state, dt, true);
    const double p = measure(b.experiment, b.model, b.state).load / (3.0e-3 * t);
    const std::vector<Mat3> stress = grain_stress(b.model, b.state);
    double along = 0.0, across = 0.0;
    for (int i = 0; i < b.state.bodies.size(); ++i) {
        // small end faces are stiffer against the platen than large ones: one width away little of that is left
        if (b.state.bodies.inverse_mass[i] == 0.0 || std::fabs(b.state.bodies.position[i].x) > 2e-3) continue;
        const Mat3& s = stress[static_cast<std::size_t>(i)];
        along = std::max(along, std::fabs(s[0].x / p + 1));
        across = std::max({across, std::fabs(s[1].y) / p, std::fabs(s[0].y) / p});
    }
    WARN("sigma along the load within " << along << " of -p, others up to " << across << " p");
    CHECK(along < 2e-3);
    CHECK(across < 2e-3);
}

TEST_CASE(
    "uniaxial compression: the first planes that run lie along the load; the hydrostatic gate would keep all shut")
{
    Built b = build(bar(), default_device());
    begin(b);
    const double dt = stable_step(b);
    std::vector<CleavageRules> hydrostatic = b.cleavage;
    hydrostatic[0].gate.kind = CleavageGate::Kind::hydrostatic;
    hydrostatic[0].gate.hydrostatic_threshold = 0.0;
    std::vector<SplitRequest> due;
    std::vector<GrainCleavage> found, gated;
    for (int i = 1; due.empty() && i < 40000; ++i) {
        step(b.model, b.state, dt, i % 20 == 0);
        if (i % 20 != 0) continue;
        const std::vector<Mat3> stress = grain_stress(b.model, b.state);
        found = find_cleavage(b.model, b.state, stress, b.cleavage);
        gated = find_cleavage(b.model, b.state, stress, hydrostatic);
        due = splits_due(b.state, found, b.cleavage);
    }
    REQUIRE(!due.empty());
    for (const GrainCleavage& g : gated) CHECK(g.worst.f == 0.0);
    double open = 0.0, interior = 0.0;
    for (int i = 0; i < b.state.bodies.size(); ++i) {
        const GrainCleavage& g = found[static_cast<std::size_t>(i)];
        const Vec3 x = b.state.bodies.position[i];
        if (g.worst.K_I > open) open = g.worst.K_I;
        if (g.worst.K_I > 0.0) CHECK(std::fabs(g.plane.normal.y) < 1e-3);  // what opens lies along the load
        if (std::fabs(x.y) < 3e-3 && std::fabs(x.x) < 1e-3) interior = std::max(interior, g.worst.f);
    }
    WARN("first split at " << measure(b.experiment, b.model, b.state).stress / 1e6 << " MPa, " << due.size()
                           << " grains, largest K_I " << open / 1e6 << " MPa m^0.5, interior grains f = " << interior);
    CHECK(open > 0.0);
    CHECK(interior < 0.5);  // under uniform stress nothing pulls on an upright plane, and friction locks the others
}
