// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/live_run.h"
#include "app/signals.h"
#include "app/wall_clock.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace grainfrac {

namespace {

/// First move of the grip over the fibre's length where no slip is told [-].
constexpr double first_shift = 1e-5;

}  // namespace

void make_path(LiveRun& run)
{
    const PullOut& p = *run.experiment.pull_out;
    PathSettings s;
    double failure = 0.0;
    for (const BondSpec& b : run.input.bonds)
        failure = std::max({failure, b.yield_slip.value_or(0.0), b.failure_slip.value_or(0.0)});
    if (failure == 0.0) failure = first_shift * p.length;
    s.by_damage = run.input.test.control == "damage";
    s.damage_step = run.input.test.damage_step;
    s.shift = run.input.test.displacement_step.value_or(failure / 20.0);
    s.slide = run.input.test.slide_step.value_or(p.length / 60.0);
    s.slides = run.input.test.stop.slip.has_value();
    s.relax.tolerance = run.input.test.relaxed;
    run.path.emplace(p, s, run.model, run.state);
}

Ending run_path(LiveRun& run, const Stage& stage)
{
    if (!run.path) make_path(run);
    while (true) {
        const auto before = Clock::now();
        const std::optional<PullOutPath::Found> found =
            next_or_none(run.path, run.model, run.state, [] { return pending_signal() != 0; });
        run.record.phases.steps += seconds_since(before);
        if (!found) return stop_for_signal(run);
        if (*found == PullOutPath::Found::end) {
            return {exit_code::done, "the interface is broken"};
        }
        if (*found == PullOutPath::Found::not_at_rest) {
            return {exit_code::unstable,
                    fmt::format("unstable: no equilibrium after {} steps, the mean residual is {:.2g} of the mean "
                                "force of the bonds; raise test.relaxed, or hold what can move freely",
                                run.path->last().steps, run.path->last().residual)};
        }
        if (*found == PullOutPath::Found::not_softening) {
            return {exit_code::unstable,
                    "unstable: with friction no state was found where the interface softens; lower test.relaxed, or "
                    "use test.control = \"displacement\""};
        }
        record_row(run, stage);
        spdlog::debug("equilibrium {}: {} steps, residual {:.2g}", run.state.time, run.path->last().steps,
                      run.path->last().residual);
        if (run.state.time >= run.now.next_snapshot) write_snapshot_at_rest(run);
        if (!is_stable(run, run.record.rows.back().energy)) return stop_unstable(run);
        if (const std::string why = why_path_ended(run); !why.empty()) {
            return {exit_code::done, why};
        }
        run.progress.update(progress_of(run, stage));
        if (checkpoint_is_due(run)) checkpoint(run);
    }
}

}  // namespace grainfrac
