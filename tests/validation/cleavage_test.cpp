// SPDX-License-Identifier: GPL-3.0-or-later
// Grains that cleave: the load at which they do, pre-cut grains, what a run of splits keeps.
#include "experiment/cleavage_rules.h"
#include "fracture/grain_stress.h"
#include "gpu/thread_pool.h"
#include "support/assembly.h"
#include "support/disc.h"

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

constexpr double toughness = 2e6, flaw = 50e-6;

/// A bar of grains along y between two gripped rows, its crystals turned by `angle` about z.
Case bar_case(double angle, const std::string& planes)
{
    Case c = disc_case(0.6e-3, false);
    PartSpec& p = c.parts[0];
    p.thickness = 1.3e-3;
    p.region.shape = "box";
    p.region.size = {4.2e-3, 10e-3, 1.3e-3};
    p.orientation.choices = {angle};
    c.bonds[0].failure = "unbreakable";
    c.materials[0].cleavage.planes = {planes};
    c.materials[0].cleavage.toughness = toughness;
    c.materials[0].cleavage.flaw_size = flaw;
    c.materials[0].cleavage.finite_width = false;
    c.materials[0].cleavage.slabs = false;
    c.materials[0].cleavage.flaw_site = "buried";
    c.test.kind = "uniaxial_tension";
    c.test.platen_speed = 0.05;
    return c;
}

struct Outcome {
    std::vector<std::int32_t> split;  // parents, in order
    double first_f = 0.0, first_stress = 0.0;
    Ledger energy;
    double mass = 0.0;
    Vec3 momentum_jump;
    std::uint64_t hash = 0;
};

/// Load until `most` grains were split, or for `steps` steps.
Outcome load(Built b, int most, int steps)
{
    begin(b);
    double dt = stable_step(b, 0.5);
    Outcome o;
    std::vector<SplitRules> rules;
    for (const CleavageRules& r : b.cleavage) rules.push_back(r.split);
    for (int i = 0; i < steps && static_cast<int>(o.split.size()) < most; ++i) {
        const bool look = i % 10 == 9;
        step(b.model, b.state, dt, look);
        if (!look) continue;
        const std::vector<Mat3> stress = grain_stress(b.model, b.state);
        const auto found = find_cleavage(b.model, b.state, stress, b.cleavage);
        const auto due = splits_due(b.state, found, b.cleavage);
        if (due.empty()) continue;
        if (o.split.empty()) {
            const auto first = static_cast<std::size_t>(due[0].body);
            o.first_f = found[first].worst.f;
            const Vec3 n = due[0].plane.normal, t = stress[first] * n;
            const double sigma = dot(t, n), tau = norm(tangential(t, n));
            o.first_stress = std::sqrt(sigma * sigma + tau * tau / (0.816 * 0.816));  // the ellipse in stresses
        }
        const Momentum before = total_momentum(b.model, b.state);
        for (const SplitReport& r : split_grains(b.model, b.state, due, rules)) {
            if (r.status == SplitStatus::done) o.split.push_back(r.parent_id);
        }
        REQUIRE(why_not_valid(b.model, b.state).empty());
        const Momentum after = total_momentum(b.model, b.state);
        CHECK(std::fabs(after.mass - before.mass) < 1e-13 * before.mass);
        CHECK(norm(after.linear - before.linear) < 1e-12 * before.mass * 0.05);
        dt = std::min(dt, stable_step(b, 0.5));
    }
    o.energy = energy_ledger(b.model, b.state);
    o.mass = total_momentum(b.model, b.state).mass;
    o.hash = state_hash(b.state);
    return o;
}

}  // namespace

TEST_CASE("a grain under tension cleaves where the stress across its plane is K_c/sqrt(pi a)")
{
    const Outcome o = load(build(bar_case(0.0, "{10-10}"), default_device()), 1, 40000);
    REQUIRE(!o.split.empty());
    CHECK(o.first_f < 1.01);  // found within the steps between two looks
    // the mean stress of the grain stands for the traction in the middle of its plane
    CHECK(o.first_stress == Approx(toughness / std::sqrt(std::numbers::pi * flaw)).epsilon(0.02));
}

TEST_CASE("splits: the account closes, and the bits do not depend on threads")
{
    Case c = bar_case(0.3, "{11-20}");
    c.bonds[0].failure = "point";
    c.bonds[0].tensile_strength = 200e6;
    c.bonds[0].cohesion = 400e6;
    c.bonds[0].fracture_energy_I = 60;
    c.bonds[0].fracture_energy_II = 300;
    c.materials[0].cleavage.flaw_site = "surface";
    c.test.platen_speed = 0.5;
    set_threads(1);
    const Outcome one = load(build(c, default_device()), 30, 20000);
    set_threads(2);
    const Outcome two = load(build(c, default_device()), 30, 20000);
    set_threads(1);
    CHECK(one.split.size() >= 10);
    CHECK(one.split == two.split);
    CHECK(one.hash == two.hash);
    CAPTURE(one.energy.relative_error(), one.split.size());
    CHECK(one.energy.relative_error() < 1e-3);
}
