// SPDX-License-Identifier: GPL-3.0-or-later
// Cleavage on Brazilian discs: one look at all grains, and one split.
#include "../tests/support/disc.h"
#include "fracture/cleave.h"
#include "fracture/grain_stress.h"
#include "gpu/thread_pool.h"

#include <benchmark/benchmark.h>

using namespace grainfrac;

namespace {

Built cleaving_disc(double side)
{
    Case c = test::disc_case(side, side < 0.5e-3);
    CleavageSpec& s = c.materials[0].cleavage;
    s.planes = {"{10-10}", "{11-20}"};
    s.toughness = {1e6};
    s.flaw_size = 0.2 * side;
    s.gate = "none";
    Built b = build(c, default_device());
    test::begin(b);
    test::run_steps(b, test::stable_step(b), 200);
    step(b.model, b.state, test::stable_step(b), true);
    return b;
}

/// Planes of all grains, as if the gate held none back.
void look(benchmark::State& state)
{
    set_threads(static_cast<int>(state.range(1)));
    Built b = cleaving_disc(1e-6 * static_cast<double>(state.range(0)));
    for (auto _ : state) {
        benchmark::DoNotOptimize(find_cleavage(b.model, b.state, grain_stress(b.model, b.state), b.cleavage));
    }
    state.counters["grains"] = b.state.bodies.size();
}

/// One grain after another along its first plane; what the run does after a split is counted too.
void split(benchmark::State& state)
{
    set_threads(1);
    Built b = cleaving_disc(1e-6 * static_cast<double>(state.range(0)));
    const int grains = b.state.bodies.size() / 2;
    int next = 0, done = 0;
    for (auto _ : state) {
        SplitReport r;
        while (r.status != SplitStatus::done && next < grains) {
            SplitRequest request;
            request.body = next++;
            request.rules = b.cleavage[0].families[0].split;
            request.plane.normal = {0.0, 1.0, 0.0};
            request.plane.offset = b.state.bodies.position[request.body].y;
            r = split_grains(b.model, b.state, {request}).front();
        }
        if (r.status != SplitStatus::done) {
            state.SkipWithError("no grain is left");
            break;
        }
        ++done;
        if (!why_not_valid(b.model, b.state).empty()) state.SkipWithError("not a valid state");
        benchmark::DoNotOptimize(time_step_bound(b.model, b.state, {r.body, r.new_body}));
    }
    state.counters["grains"] = b.state.bodies.size();
    state.counters["splits"] = done;
}

}  // namespace

BENCHMARK(look)->ArgsProduct({{600, 150}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(split)->Args({600})->Args({150})->Unit(benchmark::kMillisecond)->Iterations(300);
