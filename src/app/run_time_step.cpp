// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/live_run.h"

#include <spdlog/spdlog.h>

namespace grainfrac {

namespace {

/// Shorter time steps are logged from this share on.
constexpr double logged_change = 0.01;

}  // namespace

void choose_step(LiveRun& run)
{
    const ChosenStep s = choose_time_step(run.input, run.model, run.state);
    run.now.dt = s.dt;
    run.now.step_limit = 0.0;
    run.record.critical_step = s.critical;
    run.record.limiter = s.limiter;
    spdlog::info("time step {:.4g} s, stability limit {:.4g} s ({})", run.now.dt, s.critical, s.limiter);
}

void shorten_step_if_needed(LiveRun& run, const TimeStepBound& bound)
{
    if (bound.body < 0) return;
    if (run.input.control.time_step) {  // the user's stays what it is; the next look ends the run
        if (run.now.dt <= bound.with_damping) return;
        run.now.step_limit = bound.with_damping;
        run.record.critical_step = bound.with_damping;
        run.record.limiter = bound.limiter;
        return;
    }
    const double allowed = run.input.control.time_step_safety * bound.with_damping;
    if (allowed >= run.now.dt) return;
    const bool worth_a_line = allowed < (1.0 - logged_change) * run.now.dt;
    if (worth_a_line)
        spdlog::info("step {}: time step {:.4g} -> {:.4g} s ({})", run.state.step, run.now.dt, allowed, bound.limiter);
    run.now.dt = allowed;
    run.record.critical_step = bound.with_damping;
    run.record.limiter = bound.limiter;
}

}  // namespace grainfrac
