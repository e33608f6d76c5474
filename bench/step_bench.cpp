// SPDX-License-Identifier: GPL-3.0-or-later
// Kernels and whole steps on Brazilian discs of fixed size, with the bytes that a step cannot avoid moving.
#include "../tests/support/disc.h"
#include "contact/contact_forces.h"
#include "contact/find_contacts.h"
#include "contact/gather.h"
#include "experiment/experiment.h"
#include "fracture/bond_forces.h"
#include "gpu/device.h"
#include "gpu/parallel.h"
#include "gpu/thread_pool.h"
#include "motion/step.h"
#include "motion/time_step.h"

#include <benchmark/benchmark.h>
#include <vector>

using namespace grainfrac;

namespace {

struct Loaded {
    Built built;
    double dt = 0.0;
};

/// A disc pressed for a few hundred steps, so that contacts act and nothing is denormal.
Loaded disc(double side)
{
    Case c = test::disc_case(side, side < 0.5e-3);
    c.bonds[0].failure = "point";
    Loaded l{build(c, default_device()), 0.0};
    test::begin(l.built);
    l.dt = test::stable_step(l.built);
    test::run_steps(l.built, l.dt, 200);
    return l;
}

/// Compulsory traffic of bond_forces per interface point of an undamaged face of `points_per_face` points [B]:
/// positions and weight (56) and onset (8) of the point; of the face 188 B of constants, 28 B of indices, 208 B of
/// state read or written, 144 B of dashpot memory, 72 B of slots, 208 B of two bodies.
double bytes_per_point(double points_per_face)
{
    return 64.0 + (188.0 + 28.0 + 208.0 + 144.0 + 72.0 + 208.0) / points_per_face;
}

void report(benchmark::State& state, const State& s)
{
    const double points = s.points.size();
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * s.points.size());
    state.counters["points"] = points;
    state.counters["bytes/point"] = bytes_per_point(points / s.interfaces.size());
    state.SetBytesProcessed(static_cast<std::int64_t>(static_cast<double>(state.iterations()) * points *
                                                      bytes_per_point(points / s.interfaces.size())));
    // the third argument scales an inverted rate: seconds per point
    state.counters["s/point"] =
        benchmark::Counter(points, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void bonds(benchmark::State& state)
{
    set_threads(static_cast<int>(state.range(1)));
    Loaded l = disc(1e-6 * static_cast<double>(state.range(0)));
    for (auto _ : state) bond_forces(l.built.model, l.built.state, l.dt);
    report(state, l.built.state);
}

void contacts(benchmark::State& state)
{
    set_threads(static_cast<int>(state.range(1)));
    Loaded l = disc(1e-6 * static_cast<double>(state.range(0)));
    for (auto _ : state) {
        find_contacts(l.built.model, l.built.state);
        contact_forces(l.built.model, l.built.state, l.dt);
    }
    report(state, l.built.state);
}

void gather(benchmark::State& state)
{
    set_threads(static_cast<int>(state.range(1)));
    Loaded l = disc(1e-6 * static_cast<double>(state.range(0)));
    for (auto _ : state) gather_forces(l.built.model, l.built.state);
    report(state, l.built.state);
}

void whole_step(benchmark::State& state)
{
    set_threads(static_cast<int>(state.range(1)));
    Loaded l = disc(1e-6 * static_cast<double>(state.range(0)));
    for (auto _ : state) step(l.built.model, l.built.state, l.dt);
    report(state, l.built.state);
}

/// The floor: a STREAM-like triad over arrays of the size of the points' data, on the same threads.
struct Triad {
    static constexpr const char* name = "triad";
    View<const double> a, b;
    View<double> c;
    void operator()(int i) const { c[i] = a[i] + 0.5 * b[i]; }
};
void triad(benchmark::State& state)
{
    set_threads(static_cast<int>(state.range(1)));
    const int n = static_cast<int>(state.range(0));
    Buffer<double> a, b, c;
    a.assign(n, 1.0);
    b.assign(n, 2.0);
    c.assign(n, 0.0);
    const Triad kernel{a.read(Device::cpu), b.read(Device::cpu), c.write(Device::cpu)};
    for (auto _ : state) parallel_for(Device::cpu, n, kernel);
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * n * 24);
}

const std::vector<std::vector<std::int64_t>> discs = {{600, 150}, {1, 2}};  // side in um, threads

}  // namespace

BENCHMARK(bonds)->ArgsProduct(discs)->UseRealTime();
BENCHMARK(contacts)->ArgsProduct(discs)->UseRealTime();
BENCHMARK(gather)->ArgsProduct(discs)->UseRealTime();
BENCHMARK(whole_step)->ArgsProduct(discs)->UseRealTime();
BENCHMARK(triad)->ArgsProduct({{30000, 600000, 20000000}, {1, 2}})->UseRealTime();

BENCHMARK_MAIN();
