// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/live_run.h"
#include "app/wall_clock.h"
#include "fracture/clusters.h"
#include "fracture/grain_stress.h"
#include "motion/step.h"

#include <algorithm>

namespace grainfrac {

namespace {

/// History rows of a run whose interval the user left open.
constexpr double automatic_rows = 2000.0;
/// Snapshots of a run whose number the user left open.
constexpr double automatic_snapshots = 20.0;

}  // namespace

void choose_history(LiveRun& run)
{
    const double expected = run.experiment.expected_duration;
    run.now.history = run.input.output.history.value_or(expected > 0.0 ? std::max(expected / automatic_rows, run.now.dt)
                                                                       : 100.0 * run.now.dt);
    run.record.history_interval = run.now.history;
}

void choose_snapshots(LiveRun& run)
{
    const double expected = run.experiment.expected_duration;
    const double count =
        run.input.output.snapshots ? static_cast<double>(*run.input.output.snapshots) : automatic_snapshots;
    run.now.every = run.input.output.every.value_or(expected > 0.0 ? expected / count : 5000.0 * run.now.dt);
    run.record.snapshot_interval = run.now.every;
}

void change_intervals(LiveRun& run, const Restart& restart)
{
    const double history = run.now.history, every = run.now.every;
    if (restart.new_history) choose_history(run);
    if (restart.new_snapshots) choose_snapshots(run);
    if (!run.record.rows.empty()) run.now.next_history += run.now.history - history;
    if (run.now.next_snapshot > 0.0) run.now.next_snapshot += run.now.every - every;
}

void write_snapshot(LiveRun& run)
{
    const auto before = Clock::now();
    run.fields.stress = grain_stress(run.model, run.state);
    run.fields.cleavage = find_cleavage(run.model, run.state, run.fields.stress, run.cleavage);
    run.fields.cluster = bonded_clusters(run.state);
    run.folder.write_snapshot(run.model, run.state, run.fields, run.input.output.contacts);
    run.now.next_snapshot = run.state.time + run.now.every;
    run.record.phases.output += seconds_since(before);
}

void write_snapshot_at_rest(LiveRun& run)
{
    Model at_rest = run.model;
    at_rest.fracture_active = false;
    step(at_rest, run.state, 0.0, true);
    write_snapshot(run);
}

void last_snapshot(LiveRun& run, const Stage& stage)
{
    if (run.experiment.pull_out && run.experiment.pull_out->quasi_static) return write_snapshot_at_rest(run);
    step(run.model, run.state, run.now.dt, true);
    record_row(run, stage);
    write_snapshot(run);
}

}  // namespace grainfrac
