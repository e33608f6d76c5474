// SPDX-License-Identifier: GPL-3.0-or-later
// Whole steps, and each of their stages, of the models of cases.h: MODEL/BODIES/THREADS/STAGE.
#include "cases.h"
#include "gpu/parallel.h"
#include "stages.h"

#include <fmt/format.h>

#include <benchmark/benchmark.h>
#include <vector>

using namespace grainfrac;
using namespace grainfrac::bench;

namespace {

void run(benchmark::State& state, Kind kind, int bodies, int threads, const TimedStage& stage)
{
    set_threads(threads);
    Loaded& l = loaded(kind, bodies);
    for (auto _ : state) stage.run(l.built.model, l.built.state, l.dt);
    using C = benchmark::Counter;
    const auto seconds_per = [](double n) { return C(n, C::kIsIterationInvariantRate | C::kInvert); };
    state.counters["s/body"] = seconds_per(l.bodies);
    state.counters["s/interaction"] = seconds_per(l.interactions());
    state.counters["bodies"] = l.bodies;
    state.counters["bonds"] = l.bonds;
    state.counters["touching"] = l.touching;
    state.counters["candidates"] = l.built.state.pairs.size();
    state.counters["rebuilds/step"] = static_cast<double>(l.rebuilds) / l.watched;
    state.counters["B/step"] = l.traffic;
    state.counters["B/body"] = l.memory / l.bodies;
}

/// The floor: a STREAM-like triad on the same threads, over more than the caches hold.
struct Triad {
    static constexpr const char* name = "triad";
    View<const double> a, b;
    View<double> c;
    void operator()(int i) const { c[i] = a[i] + 0.5 * b[i]; }
};
void triad(benchmark::State& state, int threads)
{
    set_threads(threads);
    constexpr int n = 20000000;
    Buffer<double> a, b, c;
    a.assign(n, 1.0);
    b.assign(n, 2.0);
    c.assign(n, 0.0);
    const Triad kernel{a.read(Device::cpu), b.read(Device::cpu), c.write(Device::cpu)};
    for (auto _ : state) parallel_for(Device::cpu, n, kernel);
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * n * 24);
}

struct Sizes {
    Kind kind;
    std::vector<int> bodies;
};

}  // namespace

int main(int argc, char** argv)
{
    const std::vector<Sizes> models = {{Kind::honeycomb, {168, 1000, 5000, 100000}},
                                       {Kind::prisms, {168, 1000, 5000}},
                                       {Kind::bonded_spheres, {1000, 6000, 50000, 1000000}},
                                       {Kind::loose_spheres, {5000}}};
    for (const int threads : {1, 2}) {
        benchmark::RegisterBenchmark(fmt::format("triad/{}", threads).c_str(), [=](benchmark::State& s) {
            triad(s, threads);
        })->UseRealTime();
    }
    for (const Sizes& m : models) {
        for (const int bodies : m.bodies) {
            for (const int threads : {1, 2}) {
                for (const TimedStage& stage : stages) {
                    benchmark::RegisterBenchmark(
                        fmt::format("{}/{}/{}/{}", name_of(m.kind), bodies, threads, stage.name).c_str(),
                        [=](benchmark::State& s) { run(s, m.kind, bodies, threads, stage); })
                        ->UseRealTime();
                }
            }
        }
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
