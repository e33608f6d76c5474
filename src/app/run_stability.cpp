// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/live_run.h"

#include <algorithm>
#include <cmath>

namespace grainfrac {

namespace {

/// Nothing moves faster than so many times the waves, or what was told or set free to move.
constexpr double fastest = 10.0;

}  // namespace

double speed_limit(const LiveRun& run)
{
    if (!(run.experiment.wave_speed > 0.0)) return 0.0;
    double scale = std::max(run.experiment.wave_speed, fastest_speed(run.model, run.state));
    for (const Group& g : run.model.groups) {
        if (g.material < 0) continue;  // a wall
        const Material& m = run.model.materials[static_cast<std::size_t>(g.material)];
        scale = std::max(scale, std::sqrt(m.young_modulus / m.density));
    }
    for (const Stage& s : run.experiment.stages) {
        for (const Vec3& v : s.wall_velocity) scale = std::max(scale, norm(v));
    }
    Vec3 low, high;
    for (int i = 0; i < run.state.bodies.size(); ++i) {
        const Vec3 x = run.state.bodies.position[i];
        for (int k = 0; k < 3; ++k) {
            low[k] = i == 0 ? x[k] : std::min(low[k], x[k]);
            high[k] = i == 0 ? x[k] : std::max(high[k], x[k]);
        }
    }
    return fastest * std::max(scale, std::sqrt(2.0 * norm(run.model.gravity) * norm(high - low)));
}

Ledger energy_now(const LiveRun& run)
{
    Ledger e = energy_ledger(run.model, run.state);
    e.negligible = run.now.energy_floor;
    return e;
}

bool is_stable(LiveRun& run, const Ledger& energy)
{
    StabilityLimits limits;
    const bool too_long = run.now.step_limit > 0.0;
    const TimeStepBound bound = too_long ? time_step_bound(run.model, run.state) : TimeStepBound{};
    if (too_long) limits.bound = &bound;
    limits.time_step = run.now.dt;
    limits.fixed_step = run.input.control.time_step.has_value();
    limits.speed = run.now.most_speed;
    limits.error_before = run.now.error_before;
    if (run.path) limits.remedy = "lower test.damage_step, test.displacement_step or test.relaxed";
    run.instability = find_instability(run.model, run.state, energy, limits);
    run.now.error_before = account_is_off(energy) ? std::fabs(energy.residual()) : 0.0;
    return !run.instability;
}

Ending stop_unstable(LiveRun& run)
{
    run.folder.write_culprits(run.model, run.state, run.instability.bodies);
    return {exit_code::unstable, "unstable: " + run.instability.reason};
}

}  // namespace grainfrac
