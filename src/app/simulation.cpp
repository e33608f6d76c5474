// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/simulation.h"

#include "app/live_run.h"
#include "app/signals.h"
#include "app/wall_clock.h"
#include "experiment/specimen.h"
#include "fracture/clusters.h"
#include "motion/step.h"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace grainfrac {

namespace {

/// The time step is checked against the present stiffness after this many steps: contacts come slowly compared to it.
constexpr int steps_between_checks = 500;
/// Steps between two looks at whether the run is still stable, where no row comes sooner.
constexpr int steps_between_looks = 200;
/// A residual below this share of E V (as m c_0^2) is round-off, whatever the other terms are: strains of 1e-9.
constexpr double negligible_energy = 1e-18;
/// Kinetic over elastic energy counts from this share of the peak load: at the very start both are nothing.
constexpr double monitored_load = 0.1;

void begin_run(LiveRun& run)
{
    start(run.model, run.state);
    choose_step(run);
    choose_history(run);
    choose_snapshots(run);
    for (int i = 0; i < run.state.bodies.size(); ++i)
        run.now.energy_floor +=
            negligible_energy * run.state.bodies.mass[i] * run.experiment.wave_speed * run.experiment.wave_speed;
    run.now.most_speed = speed_limit(run);
    run.record.first_momentum = total_momentum(run.model, run.state);
    run.record.cracks = CrackWatch(crack_scale(run.model, run.state));
    if (run.input.output.checkpoint > 0.0 || run.input.output.checkpoint_steps) checkpoint(run);
}

/// Load, displacement, strain and peak of the test count from here.
void begin_reference(LiveRun& run)
{
    take_reference(run.experiment, run.model, run.state);
    run.record.peak_load = run.record.peak_stress = run.record.peak_displacement = 0.0;
    run.record.peak_time = run.record.load_start = run.state.time;
}

void remember_begin(LiveRun& run, const Stage& stage)
{
    run.now.stage_start = run.state.time;
    run.now.stage_kinetic = 0.0;
    run.now.stage_body = -1;
    for (int i = 0; i < run.state.bodies.size() && run.now.stage_body < 0 && stage.loaded_wall >= 0; ++i) {
        if (run.state.bodies.wall[i] == stage.loaded_wall) run.now.stage_body = i;
    }
    if (run.now.stage_body >= 0) run.now.stage_origin = run.state.bodies.position[run.now.stage_body];
    run.now.stage_section =
        stage.stress ? section_across(specimen_extent(run.model, run.state).size(), stage.load_direction) : 0.0;
    run.now.stage_peak = run.now.stage_first_load = stage.unloads ? stage_load(run, stage) : 0.0;
}

void start_stage(LiveRun& run, const Stage& stage)
{
    begin_stage(stage, run.model, run.state);
    if (!stage.released.empty()) shorten_step_if_needed(run, time_step_bound(run.model, run.state));
    if (run.now.stage == run.experiment.reference_stage) begin_reference(run);
    remember_begin(run, stage);
    if (run.state.step == 0) record_row(run, stage);
    run.now.stage_begun = true;
}

Ending run_stage(LiveRun& run, const Stage& stage)
{
    while (true) {
        if (run.state.step % steps_between_checks == 0 && run.state.step > 0)
            shorten_step_if_needed(run, time_step_bound(run.model, run.state));
        const bool snapshot = run.state.time + 0.5 * run.now.dt >= run.now.next_snapshot;
        const bool cleave = !run.cleavage.empty() && stage.cleavage;
        const bool ask_gate = cleave && gate_is_due(run.state);
        const auto before = Clock::now();
        step(run.model, run.state, run.now.dt, snapshot || ask_gate);
        run.record.phases.steps += seconds_since(before);
        // a snapshot waits for the step after a split, when the stresses of the parts are known
        if (!(cleave && split_where_due(run, ask_gate)) && snapshot) write_snapshot(run);
        if (run.state.time + 0.5 * run.now.dt >= run.now.next_history || time_is_up(run, stage)) {
            record_row(run, stage);
            if (!is_stable(run, run.record.rows.back().energy)) return stop_unstable(run);
            if (const std::string why = why_ended(run, stage); !why.empty()) {
                spdlog::info("stage \"{}\" ended: {}", stage.name, why);
                return {exit_code::done, why};
            }
            run.progress.update(progress_of(run, stage));
        } else if (run.state.step % steps_between_looks == 0 && !is_stable(run, energy_now(run))) {
            record_row(run, stage);
            return stop_unstable(run);
        }
        if (pending_signal() != 0) return stop_for_signal(run);
        if (checkpoint_is_due(run)) checkpoint(run);
    }
}

Ending run_stages(LiveRun& run)
{
    Ending ending{exit_code::done, "all stages done"};
    const auto stages = static_cast<std::int64_t>(run.experiment.stages.size());
    run.progress.begin(progress_of(run, run.experiment.stages[static_cast<std::size_t>(run.now.stage)]));
    for (; run.now.stage < stages; ++run.now.stage, run.now.stage_begun = false) {
        const Stage& stage = run.experiment.stages[static_cast<std::size_t>(run.now.stage)];
        spdlog::info("stage \"{}\"{}", stage.name, run.now.stage_begun ? " goes on" : "");
        if (!run.now.stage_begun) start_stage(run, stage);
        if (run.experiment.pull_out && run.experiment.pull_out->quasi_static)
            ending = run_path(run, stage);
        else
            ending = stage.bonds ? bond_stage(run, stage) : run_stage(run, stage);
        if (ending.code != exit_code::done) break;
        if (run.input.test.stop.time && run.experiment.kind == "custom" && run.state.time >= *run.input.test.stop.time)
            break;
    }
    if (ending.code == exit_code::done) last_snapshot(run, run.experiment.stages.back());
    run.record.last_momentum = total_momentum(run.model, run.state);
    run.record.time_step = run.now.dt;
    run.progress.finish(progress_of(run, run.experiment.stages.back()));
    return ending;
}

/// From a tenth of the peak load to the peak.
void monitor_quasi_static(RunRecord& record)
{
    for (const HistoryRow& r : record.rows) {
        if (r.time > record.peak_time) break;
        if (r.time < record.load_start) continue;
        const double elastic = r.energy.elastic_bonds + r.energy.elastic_contacts;
        if (r.load < monitored_load * record.peak_load || elastic <= 0.0) continue;
        record.kinetic_over_elastic = std::max(record.kinetic_over_elastic, r.energy.kinetic / elastic);
    }
}

}  // namespace

ProgressState progress_of(const LiveRun& run, const Stage& s)
{
    ProgressState p;
    p.stage = s.name;
    p.step = run.state.step;
    p.time = run.state.time;
    if (run.experiment.expected_duration > 0.0)
        p.done = std::min(0.99, run.state.time / run.experiment.expected_duration);
    if (!run.record.rows.empty()) {
        p.load = run.record.rows.back().load;
        p.fragments = run.record.rows.back().fragments;
    }
    p.broken = run.now.broken;
    return p;
}

Ending simulate(const Case& c, const Options& o, const RunFacts& facts, const RunOrigin& origin, Built& built,
                ResultFolder& folder, RunRecord& record, SnapshotFields& last_fields, const Restart* restart)
{
    LiveRun run(c, o, origin, built, folder, record, last_fields);
    if (restart != nullptr)
        restore(run, facts, *restart);
    else
        begin_run(run);
    const Ending ending = run_stages(run);
    const auto bodies = static_cast<std::size_t>(built.state.bodies.size());
    if (ending.code != exit_code::done) last_fields.cluster = bonded_clusters(built.state);
    if (last_fields.stress.size() != bodies) {  // stopped before its first snapshot, or after a split since its last
        last_fields.stress.assign(bodies, {});
        last_fields.cleavage.assign(bodies, {});
    }
    record.cracks.look(built.model, built.state);
    monitor_quasi_static(record);
    return ending;
}

}  // namespace grainfrac
