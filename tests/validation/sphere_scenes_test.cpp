// SPDX-License-Identifier: GPL-3.0-or-later
// What holds for every example with spheres, and for the slender beam, each in short: the energy account closes, two
// threads give the same bits, and the whole scene turned gives the turned result.
#include "experiment/pull_out.h"
#include "experiment/pull_out_path.h"
#include "gpu/thread_pool.h"
#include "io/input.h"
#include "support/assembly.h"
#include "support/disc.h"

#include <map>
#include <string>
#include <vector>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

/// An example with other values, and so many steps of each stage, or states of a path.
struct Example {
    std::string file;
    std::vector<std::string> values;
    std::vector<int> steps;
};

const std::vector<Example> examples = {
    {"damped_pair/damped_pair", {}, {1000, 500}},  // pulled, let go
    {"chain_beam/chain_beam", {}, {2000}},
    {"chain_catenary/chain_catenary", {}, {2000, 500}},
    {"chain_fountain/chain_fountain", {}, {300, 500}},  // at rest, the hand goes up
    {"chain_fountain/chain_string", {}, {300, 500}},
    {"sphere_on_plane/sphere_on_plane",
     {"parts.ball.region.diameter='10 m'", "walls.top.center=[2.047194, 3.311682, 3.884815]",
      "walls.bottom.center=[-2.047194, -3.311682, -3.884815]", "stages.press.ramp='2 ms'"},
     {200}},
    {"beam_slender/beam_slender",
     {"parts.beam.region.size=['30 mm', '3.7 mm', '1.3 mm']", "test.outer_span='26 mm'", "test.inner_span='13 mm'",
      "test.platen_speed='200 mm/s'"},
     {1000}},
    {"fibre_pullout/fibre_pullout",
     {"parts.matrix.region.height='3 m'", "parts.matrix.region.diameter='5 m'",
      "parts.fibre.fibre={from=[0, 0, '-1.8 m'], to=[0, 0, '1.8 m'], radius='1 m'}", "test.damage_step=0.1"},
     {4}},
    {"fibre_in_grains/fibre_in_grains",
     {"parts.matrix.region.height='30 um'", "parts.matrix.region.diameter='60 um'",
      "parts.fibre.fibre={from=[0, 0, '-15 um'], to=[0, 0, '20 um'], spacing='10 um', radius='8.5 um'}",
      "test.displacement_step='0.1 um'"},
     {4}},
};

struct Result {
    std::uint64_t hash = 0;
    double energy_error = 0.0;       ///< largest at the ends of stages and at the states of a path [-]
    Ledger energy;                   ///< at the end
    std::vector<Vec3> displacement;  ///< [m]
    double largest = 0.0;            ///< of the displacements [m]
};

void follow_path(int states, const Case& c, Built& b, Result& r)
{
    PathSettings s;
    s.by_damage = c.test.control == "damage";
    s.damage_step = c.test.damage_step;
    s.shift = c.test.displacement_step.value_or(1e-4);
    s.relax.tolerance = 1e-9;  // what is left of the motion is not to be seen
    PullOutPath path(*b.experiment.pull_out, s, b.model, b.state);
    for (int k = 0; k < states; ++k) {
        REQUIRE(path.next(b.model, b.state, {}) == PullOutPath::Found::equilibrium);
        r.energy_error = std::max(r.energy_error, energy_ledger(b.model, b.state).relative_error());
    }
}

Result run(const Example& e, const Case& c, Built& b, int threads)
{
    set_threads(threads);
    start(b.model, b.state);
    const double dt = c.control.time_step.value_or(stable_step(b, c.control.time_step_safety));
    Result r;
    for (std::size_t k = 0; k < e.steps.size(); ++k) {
        begin_stage(b.experiment.stages.at(k), b.model, b.state);
        if (b.experiment.pull_out) {
            follow_path(e.steps[k], c, b, r);
        } else {
            run_steps(b, dt, e.steps[k]);
            r.energy_error = std::max(r.energy_error, energy_ledger(b.model, b.state).relative_error());
        }
    }
    set_threads(1);
    r.hash = state_hash(b.state);
    r.energy = energy_ledger(b.model, b.state);
    for (int i = 0; i < b.state.bodies.size(); ++i) {
        r.displacement.push_back(b.state.bodies.position[i] - b.state.bodies.start_position[i]);
        r.largest = std::max(r.largest, norm(r.displacement.back()));
    }
    return r;
}

/// Axes along which a body is held, turned; they must come to lie on axes.
std::int32_t turned_axes(std::int32_t held, const Quat& q)
{
    if ((held & 7) == 7) return held;
    std::int32_t turned = held & ~7;
    for (int k = 0; k < 3; ++k) {
        if ((held & (1 << k)) == 0) continue;
        Vec3 axis;
        axis[k] = 1.0;
        axis = rotate(q, axis);
        int on = 0;
        while (on < 3 && std::fabs(axis[on]) < 1.0 - 1e-9) ++on;
        REQUIRE(on < 3);
        turned |= 1 << on;
    }
    return turned;
}

}  // namespace

TEST_CASE("examples with spheres: the account closes, two threads give the same bits, a turned scene turns")
{
    for (const Example& e : examples) {
        CAPTURE(e.file);
        std::map<std::string, SourcePlace> places;
        const Case c = read_case(GF_SOURCE_DIR "/examples/" + e.file + ".toml", e.values, places);
        Built first = build(c, default_device()), again = first, straight = first;
        const Result one = run(e, c, first, 1), two = run(e, c, again, 2);
        CHECK(one.largest > 0.0);
        CHECK(one.energy_error < 1e-3);
        CHECK(one.hash == two.hash);

        // local damping acts along the velocity, of which round-off makes one where a body starts from rest
        for (Stage& stage : straight.experiment.stages) stage.local_damping = 0.0;
        // by any angle, but where bodies are held along single axes: there a third of a turn brings axes onto axes
        bool by_axes = false;
        for (const std::int32_t held : straight.state.bodies.held.host())
            by_axes = by_axes || ((held & 7) != 0 && (held & 7) != 7);
        const Quat q = by_axes ? Quat{0.5, 0.5, 0.5, 0.5} : from_axis_angle(normalized(Vec3{0.3, -0.8, 0.5}), 1.1);
        Built other = straight;
        turn_all(other, q);
        for (std::int32_t& held : other.state.bodies.held.host()) held = turned_axes(held, q);
        const Result before = run(e, c, straight, 1), turned = run(e, c, other, 1);
        double farthest = 0.0;
        for (std::size_t i = 0; i < before.displacement.size(); ++i)
            farthest = std::max(farthest, norm(rotate(q, before.displacement[i]) - turned.displacement[i]));
        CHECK(farthest < 1e-6 * before.largest);
        CHECK(turned.energy.external == Approx(before.energy.external).epsilon(1e-6).margin(1e-12));
    }
}
