// SPDX-License-Identifier: GPL-3.0-or-later
// A run at work: what its parts share, and what each of them does. The loop that calls them is in simulation.cpp.
#pragma once

#include "app/progress.h"
#include "app/run_state.h"
#include "app/simulation.h"
#include "app/wall_clock.h"
#include "experiment/pull_out_path.h"
#include "experiment/stability.h"
#include "io/folder_mark.h"
#include "motion/time_step.h"

#include <cstdint>
#include <optional>
#include <string>

namespace grainfrac {

struct LiveRun {
    LiveRun(const Case& c, const Options& o, const RunOrigin& from, Built& built, ResultFolder& into, RunRecord& found,
            SnapshotFields& last_fields)
        : input(c),
          origin(from),
          model(built.model),
          state(built.state),
          experiment(built.experiment),
          cleavage(built.cleavage),
          folder(into),
          record(found),
          fields(last_fields),
          progress(o.quiet)
    {
    }

    const Case& input;
    RunOrigin origin;
    Model& model;
    State& state;
    Experiment& experiment;
    const std::vector<CleavageRules>& cleavage;
    ResultFolder& folder;
    RunRecord& record;
    SnapshotFields& fields;
    Progress progress;
    RunState now;
    Instability instability;          ///< what the last look found
    std::optional<PullOutPath> path;  ///< of a stage that is a row of equilibria
    FolderMark mark;                  ///< of the checkpoint that is being written or was read
    std::int64_t last_checkpoint_step = 0;
    Clock::time_point last_checkpoint;
};

ProgressState progress_of(const LiveRun& run, const Stage& s);

// run_time_step.cpp
void choose_step(LiveRun& run);
/// A step of the user's own stays; the next look ends the run.
void shorten_step_if_needed(LiveRun& run, const TimeStepBound& bound);

// run_rows.cpp
/// Push of the first wall that the stage moves; of ready-made tests and stages that move none, the test's load [N].
double stage_load(const LiveRun& run, const Stage& stage);
/// A row of history.csv and of all that grows with it.
void record_row(LiveRun& run, const Stage& stage);

// run_snapshots.cpp
void choose_history(LiveRun& run);
void choose_snapshots(LiveRun& run);
/// An interval that did not change stays: chosen anew from the present, shorter step it would move rows, and with
/// them where stages end. A new one counts from the last row or snapshot.
void change_intervals(LiveRun& run, const Restart& restart);
void write_snapshot(LiveRun& run);
/// Stresses come with the forces: they are found once more, without a step.
void write_snapshot_at_rest(LiveRun& run);
/// The state in which the run ended is always shown: one more step, which also gathers stresses.
void last_snapshot(LiveRun& run, const Stage& stage);

// run_splits.cpp
/// True if a grain was split.
bool split_where_due(LiveRun& run, bool ask_gate);

// run_stability.cpp
/// Nothing that is whole moves faster [m/s]; 0: not known.
double speed_limit(const LiveRun& run);
Ledger energy_now(const LiveRun& run);
/// A look at what shows that a run has gone wrong; run.instability says what it is.
bool is_stable(LiveRun& run, const Ledger& energy);
/// Says where it shows, in words and in a file; the checkpoint before it stays.
Ending stop_unstable(LiveRun& run);

// run_checkpoint.cpp
bool checkpoint_is_due(const LiveRun& run);
/// A state that is not possible is never written over a good one.
void checkpoint(LiveRun& run);
Ending stop_for_signal(LiveRun& run);
/// From a checkpoint, instead of a beginning.
void restore(LiveRun& run, const RunFacts& facts, const Restart& restart);

// stage_end.cpp
bool time_is_up(const LiveRun& run, const Stage& s);
/// "" while the stage goes on.
std::string why_ended(const LiveRun& run, const Stage& s);
std::string why_path_ended(const LiveRun& run);

// run_path.cpp
void make_path(LiveRun& run);
/// A stage that is a row of equilibria instead of time steps.
Ending run_path(LiveRun& run, const Stage& stage);

// run_bonds.cpp
/// A stage that makes bonds between what faces each other now; takes no time.
Ending bond_stage(LiveRun& run, const Stage& stage);

}  // namespace grainfrac
