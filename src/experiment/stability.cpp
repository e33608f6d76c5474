// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/stability.h"

#include "contact/find_contacts.h"
#include "model/validate.h"
#include "motion/time_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

/// A run whose energy account is off by this share has gone wrong: a stable one stays below 1e-3.
constexpr double most_energy_error = 0.1;
/// Bodies that are named and kept for a look.
constexpr std::size_t most_culprits = 10;

bool finite(const Vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string name_of(const Model& model, const State& state, int body)
{
    const std::int32_t wall = state.bodies.wall[body], group = state.bodies.group[body];
    if (wall >= 0) return fmt::format("wall \"{}\"", model.walls.at(static_cast<std::size_t>(wall)));
    return fmt::format("body {} of \"{}\"", state.bodies.id[body],
                       model.groups.at(static_cast<std::size_t>(group)).name);
}

/// Bodies that move by themselves, the worst by `measure` first; what is not a number is the worst.
template <class Measure>
std::vector<int> worst_bodies(const State& state, Measure&& measure)
{
    std::vector<std::pair<double, int>> found;
    for (int i = 0; i < state.bodies.size(); ++i) {
        if (state.bodies.inverse_mass[i] == 0.0) continue;
        const double m = measure(i);
        found.emplace_back(std::isfinite(m) ? m : INFINITY, i);
    }
    const std::size_t n = std::min(found.size(), most_culprits);
    std::partial_sort(
        found.begin(), found.begin() + static_cast<std::ptrdiff_t>(n), found.end(),
        [](const auto& x, const auto& y) { return x.first != y.first ? x.first > y.first : x.second < y.second; });
    std::vector<int> bodies;
    for (std::size_t k = 0; k < n; ++k) bodies.push_back(found[k].second);
    return bodies;
}

double kinetic_energy(const State& state, int i)
{
    const Bodies& b = state.bodies;
    return 0.5 * (b.mass[i] * norm2(b.velocity[i]) +
                  dot(rotate(b.orientation[i], b.angular_momentum[i]), b.angular_velocity[i]));
}

/// Its interaction with the largest force.
std::string strongest_interaction(const Model& model, const State& state, int body)
{
    double most = 0.0;
    std::string text;
    const auto look = [&](const auto& pairs, int first, const char* kind) {
        for (int i = 0; i < pairs.size(); ++i) {
            if (pairs.a[i] != body && pairs.b[i] != body) continue;
            const double f = norm(state.slots.force[first + i]);
            if (std::isfinite(f) && f <= most) continue;
            most = std::isfinite(f) ? f : INFINITY;
            text = fmt::format("{} with {}, {:.3g} N", kind,
                               name_of(model, state, pairs.a[i] == body ? pairs.b[i] : pairs.a[i]), f);
        }
    };
    state.for_each_bond_kind([&](const auto& bonds, int first) { look(bonds, first, "bond"); });
    look(state.contacts, state.bond_slots(), "contact");
    return text;
}

/// Where it shows.
std::string whereabouts(const Model& model, const State& state, int body)
{
    const std::string pull = strongest_interaction(model, state, body);
    return fmt::format("{} moves fastest, {:.3g} m/s{}{}", name_of(model, state, body),
                       norm(state.bodies.velocity[body]), pull.empty() ? "" : "; its strongest interaction: ", pull);
}

/// What the time step has to do with it, and what to change.
std::string step_advice(const Model& model, const State& state, const StabilityLimits& limits)
{
    const TimeStepBound bound = time_step_bound(model, state);
    const std::string now = fmt::format("time step {:.4g} s, stability limit {:.4g} s ({})", limits.time_step,
                                        bound.with_damping, bound.limiter);
    if (bound.body < 0 || !std::isfinite(bound.with_damping)) return "lower control.time_step_safety";
    if (limits.fixed_step) return fmt::format("{}: leave control.time_step out or shorten it", now);
    return fmt::format("{}: lower control.time_step_safety", now);
}

}  // namespace

bool account_is_off(const Ledger& energy)
{
    return !(energy.relative_error() <= most_energy_error);
}

Instability find_instability(const Model& model, const State& state, const Ledger& energy,
                             const StabilityLimits& limits)
{
    if (limits.bound != nullptr && limits.fixed_step && limits.bound->body >= 0 &&
        limits.time_step > limits.bound->with_damping) {
        return {
            fmt::format("control.time_step = {:.4g} s is above the present stability limit {:.4g} s ({}): leave it out "
                        "or shorten it",
                        limits.time_step, limits.bound->with_damping, limits.bound->limiter),
            {limits.bound->body}};
    }
    if (const int pair = penetrating_pair(model, state); pair >= 0) {
        const int a = state.pairs.a[pair], b = state.pairs.b[pair];
        return {fmt::format("the cores of {} and {} penetrate; the contact is too soft or something moves too fast: "
                            "raise contacts.normal_stiffness or lower the speed",
                            name_of(model, state, a), name_of(model, state, b)),
                {a, b}};
    }
    if (!std::isfinite(energy.kinetic) || !std::isfinite(energy.residual())) {
        const std::vector<int> bodies = worst_bodies(state, [&](int i) {
            const Bodies& b = state.bodies;
            return finite(b.position[i]) && finite(b.velocity[i]) && finite(b.force[i]) ? norm2(b.velocity[i]) : NAN;
        });
        const std::string what = why_not_valid(model, state);
        return {fmt::format("{}{}; {}", what.empty() ? "an energy is not finite" : what,
                            bodies.empty() ? "" : ", first at " + name_of(model, state, bodies.front()),
                            step_advice(model, state, limits)),
                bodies};
    }
    // not for one look only: a collision that has just begun is off by the half step of its dashpot
    const bool lost = account_is_off(energy) && limits.error_before > 0.0 &&
                      std::fabs(energy.residual()) >= 0.5 * limits.error_before;
    const bool too_fast = limits.speed > 0.0 && fastest_speed(model, state) > limits.speed;
    if (!lost && !too_fast) return {};
    const std::vector<int> bodies = worst_bodies(
        state, [&](int i) { return too_fast ? norm(state.bodies.velocity[i]) : kinetic_energy(state, i); });
    const std::string cause =
        too_fast ? fmt::format(
                       "something moves faster than {:.4g} m/s, the waves in the material and all that was "
                       "told to move",
                       limits.speed)
                 : fmt::format("the energy account is off by {:.0f} %", 100.0 * energy.relative_error());
    return {fmt::format("{}; {}; {}", cause, bodies.empty() ? "" : whereabouts(model, state, bodies.front()),
                        limits.remedy != nullptr ? limits.remedy : step_advice(model, state, limits)),
            bodies};
}

}  // namespace grainfrac
