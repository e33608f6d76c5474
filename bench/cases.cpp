// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases.h"

#include "gpu/device.h"
#include "gpu/thread_pool.h"
#include "io/input.h"
#include "model/grain_body.h"
#include "model/random.h"
#include "motion/energy.h"
#include "motion/integrate.h"
#include "motion/step.h"
#include "motion/time_step.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace grainfrac::bench {

namespace {

constexpr double side = 0.6e-3, thickness = 1.3e-3;  // of a prism, as in the files [m]
constexpr double largest_spin = 300.0;               // that takes the order out of a falling block [rad/s]
constexpr int loading_steps = 200, watched_steps = 500;
constexpr double settled_energy = 1e-3;  // kinetic energy over its largest

/// Region of a block of columns x rows x layers whole prisms, nearly a cube for any number.
std::string block(int bodies)
{
    int columns = 7, rows = 8, layers = 3;
    if (bodies != 168) {
        layers = std::max(1, static_cast<int>(std::lround(std::cbrt(bodies))));
        columns = std::max(1, static_cast<int>(std::lround(std::sqrt(bodies / static_cast<double>(layers)))));
        rows = std::max(1, static_cast<int>(std::lround(bodies / static_cast<double>(layers * columns))));
    }
    return fmt::format("parts[0].region.size=[{}, {}, {}]", std::sqrt(3.0) * side * columns * 1.0001,
                       1.5 * side * rows + 0.4 * side, layers * thickness);
}

std::vector<std::string> size_of(Kind kind, int bodies)
{
    if (kind == Kind::honeycomb || kind == Kind::prisms) return {block(bodies)};
    if (kind == Kind::bonded_spheres) {  // pi/4 d^3 holds sqrt(2) spheres of diameter 1 a unit volume
        const double d = std::cbrt(bodies / (0.25 * 3.14159265358979 * std::sqrt(2.0)));
        return {fmt::format("parts[0].region.diameter={}", d), fmt::format("parts[0].region.height={}", d)};
    }
    const double fraction = bodies < 1000 ? 0.5 : 0.58;  // near walls less is possible, and denser comes to rest sooner
    const double edge = 1e-3 * std::cbrt(bodies * 3.14159265358979 / 6.0 * 1.02 / fraction);
    return {fmt::format("parts[0].region.size=[{0}, {0}, {0}]", edge),
            fmt::format("parts[0].solid_fraction={}", fraction)};
}

void spin_at_random(State& s)
{
    for (int i = 0; i < s.bodies.size(); ++i) {
        if (s.bodies.inverse_mass[i] == 0.0) continue;
        Vec3 w;
        for (int k = 0; k < 3; ++k)
            w[k] = largest_spin *
                   (2.0 * uniform_random(1, RandomPurpose::test, static_cast<std::uint32_t>(3 * i + k)) - 1.0);
        set_spin(s.bodies, i, w);
    }
}

template <class T>
double bytes(const Buffer<T>& array)
{
    return static_cast<double>(array.size()) * static_cast<double>(sizeof(T));
}

double memory_of(State& s)
{
    double sum = 0.0;
    const auto add = [&](const char*, const auto& array) { sum += bytes(array); };
    s.bodies.for_each_array(add);
    s.interfaces.for_each_array(add);
    s.points.for_each_array(add);
    s.histories.for_each_array(add);
    s.corners.for_each_array(add);
    s.parallels.for_each_array(add);
    s.sphere_bonds.for_each_array(add);
    s.pairs.for_each_array(add);
    s.contacts.for_each_array(add);
    return sum + bytes(s.slots.force) + bytes(s.slots.torque_a) + bytes(s.slots.torque_b) + bytes(s.slots.bond_acts) +
           bytes(s.incidence.begin) + bytes(s.incidence.entry);
}

/// Counted from the kernels, for bonds that are whole and contacts that are apart. Manifolds are left out: what they
/// read of a shape stays in the cache.
double traffic_of(const State& s)
{
    constexpr double kick = 292, drift = 232, stale = 52, gather = 64 + 8, per_body = 2 * kick + drift + stale + gather;
    constexpr double slot = 72 + 72 + 2 * 4;  // written, read once, two entries
    constexpr double interface = 12 + 96 + sizeof(FaceMoments) + 32 + 8 + 8 + 2 * 4 + 2 * 72 + 16 + 8 + slot;
    constexpr double sphere_bond = 16 + 24 + 4 + 8 + 16 + 2 * 48 + slot;  // their kinds stay in the cache
    constexpr double candidate = 8 + 8 + 8 + 4 + 3 * 4, touching = 8 + 2 * 104 + 2 * 150 + slot;
    double sum = per_body * s.bodies.size() + interface * s.interfaces.size() + sphere_bond * s.sphere_bonds.size() +
                 candidate * s.pairs.size();
    for (int i = 0; i < s.contacts.size(); ++i) sum += s.contacts.active[i] == 1 ? touching : 0.0;
    return sum;
}

double kinetic(const Loaded& l)
{
    return energy_ledger(l.built.model, l.built.state).kinetic;
}

void settle(Loaded& l)
{
    double most = 0.0;
    for (int round = 0; round < 200; ++round) {
        for (int i = 0; i < 500; ++i) step(l.built.model, l.built.state, l.dt);
        const double now = kinetic(l);
        most = std::max(most, now);
        if (now < settled_energy * most) return;
    }
}

Loaded make(Kind kind, int bodies)
{
    std::map<std::string, SourcePlace> places;
    const char* files[] = {"honeycomb", "prisms", "sphere_cylinder", "loose_spheres"};
    const Case c = read_case(fmt::format("{}/cases/{}.toml", GF_BENCH_FOLDER, files[static_cast<int>(kind)]),
                             size_of(kind, bodies), places);
    Loaded l{build(c, default_device())};
    Model& m = l.built.model;
    State& s = l.built.state;
    if (kind == Kind::prisms) spin_at_random(s);
    start(m, s);
    begin_stage(l.built.experiment.stages.front(), m, s);
    l.dt = c.control.time_step_safety * time_step_bound(m, s).with_damping;
    if (kind == Kind::prisms || kind == Kind::loose_spheres)
        settle(l);
    else
        for (int i = 0; i < loading_steps; ++i) step(m, s, l.dt);
    for (l.watched = 0; l.watched < watched_steps; ++l.watched) {
        const double before = s.travel;
        step(m, s, l.dt);
        if (s.travel < before) ++l.rebuilds;
    }
    for (int i = 0; i < s.bodies.size(); ++i) l.bodies += s.bodies.inverse_mass[i] > 0.0;
    s.for_each_bond_kind([&](const auto& bonds, int) {
        for (int i = 0; i < bonds.size(); ++i) l.bonds += !is_gone(bonds, i);
    });
    for (int i = 0; i < s.contacts.size(); ++i) l.touching += s.contacts.active[i] == 1;
    l.memory = memory_of(s);
    l.traffic = traffic_of(s);
    return l;
}

}  // namespace

Loaded& loaded(Kind kind, int bodies)
{
    static std::map<std::pair<int, int>, Loaded> made;
    const std::pair<int, int> key{static_cast<int>(kind), bodies};
    auto found = made.find(key);
    if (found == made.end()) found = made.emplace(key, make(kind, bodies)).first;
    return found->second;
}

}  // namespace grainfrac::bench
