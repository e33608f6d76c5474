// SPDX-License-Identifier: GPL-3.0-or-later
// Where a crack meets a boundary inclined by 60 degrees: into the boundary where that is weak, else through the grain.
#include "experiment/cleavage_rules.h"
#include "fracture/grain_stress.h"
#include "support/disc.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

/// docs/studies/competition in short: a double cantilever beam pulled open across the flats of its grains.
Case beam(double ratio)
{
    constexpr double energy = 60.0, strength = 165e6;
    Case c;
    c.simulation.seed = 1;
    c.materials = {{"sic", 3100, 410e9, 0.17, {}}};
    CleavageSpec& k = c.materials[0].cleavage;
    k.planes = {"{10-10}"};
    k.slabs = false;
    const double toughness = std::sqrt(energy * 410e9 / (1 - 0.17 * 0.17));
    k.toughness = {toughness};
    k.mode_ratio = 1.0;
    k.flaw_size = std::pow(toughness / strength, 2) / std::numbers::pi;
    k.finite_width = false;
    PartSpec p;
    p.name = "beam";
    p.material = "sic";
    p.side = 0.6e-3;
    p.thickness = 1.3e-3;
    p.region.size = {10.4e-3, 12.1e-3, 1.3e-3};
    p.orientation.choices = {0.0};
    c.parts = {p};
    BondSpec b;
    b.onset = "quadratic";
    b.tensile_strength = b.cohesion = strength * std::sqrt(ratio);
    b.fracture_energy_I = b.fracture_energy_II = energy * ratio;
    c.bonds = {b};
    c.contacts = {ContactSpec{}};
    c.test.kind = "dcb";
    c.test.direction = "x";
    c.test.platen_speed = 0.2;
    c.test.crack_length = 5e-3;
    return c;
}

/// Share of the broken area that lies within grains, when 3 mm^2 are broken.
double share_through_grains(double ratio)
{
    Built b = build(beam(ratio), default_device());
    begin(b);
    double dt = stable_step(b);
    double through = 0.0, between = 0.0;
    for (int i = 1; through + between < 3e-6 && i < 60000; ++i) {
        const bool look = i % 20 == 0;
        step(b.model, b.state, dt, look);
        if (!look) continue;
        const auto due = splits_due(
            b.state, find_cleavage(b.model, b.state, grain_stress(b.model, b.state), b.cleavage), b.cleavage);
        if (!due.empty()) {
            split_grains(b.model, b.state, due);
            dt = std::min(dt, stable_step(b));
        }
        through = between = 0.0;
        const InterfaceBonds& f = b.state.interfaces;
        for (int k = 0; k < f.size(); ++k) {
            if (f.failure_time[k] < 0.0) continue;
            (f.transgranular[k] == 1 ? through : between) += f.area[k];
        }
    }
    CHECK(energy_ledger(b.model, b.state).relative_error() < 1e-3);
    REQUIRE(through + between > 0.0);
    return through / (through + between);
}

}  // namespace

TEST_CASE("a crack takes boundaries inclined by 60 degrees well below cos^4(30 deg) of the grain's energy, not above")
{
    CHECK(share_through_grains(0.3) == 0.0);
    CHECK(share_through_grains(1.0) > 0.5);  // 2/3 if it runs straight: upright boundaries lie between the grains
}
