// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/live_run.h"
#include "app/signals.h"
#include "app/wall_clock.h"
#include "io/checkpoint.h"
#include "model/validate.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace grainfrac {

namespace {

/// All that the run needs to go on, for both directions. Members that are not here hold nothing from one step to
/// the next.
void transfer(LiveRun& run, Archive& archive)
{
    archive("/origin", run.origin);
    grainfrac::transfer(archive, "/model", run.model);
    grainfrac::transfer(archive, "/state", run.state);
    archive("/run", run.now);
    archive("/record", run.record);
    archive("/fields", run.fields);
    archive("/specimen", run.experiment.specimen);
    if (run.experiment.pull_out) archive("/equilibria", run.experiment.pull_out->path);
    bool on_path = run.path.has_value();
    archive("/on_path", on_path);
    if (archive.loading()) {
        if (const std::string why = why_not_valid(run.model, run.state); !why.empty()) archive.fail(why);
        if (run.now.stage < 0 || run.now.stage >= static_cast<std::int64_t>(run.experiment.stages.size()) ||
            static_cast<int>(run.model.grain_shapes.size()) != run.state.bodies.size() ||
            (on_path && !run.experiment.pull_out))
            archive.fail("was made from another input");
        run.path.reset();
        if (on_path) make_path(run);
    }
    if (on_path) archive("/path", *run.path);
    archive("/folder", run.mark);
}

}  // namespace

void restore(LiveRun& run, const RunFacts& facts, const Restart& restart)
{
    const double build = run.record.phases.build;
    const RunOrigin now = run.origin;
    read_checkpoint(restart.checkpoint, facts.version, [&](Archive& archive) { transfer(run, archive); });
    run.origin = now;
    run.record.phases.build += build;
    if (restart.new_time_step) choose_step(run);
    change_intervals(run, restart);
    try {
        run.folder.go_on(facts, run.origin.resolved, run.mark, run.input.test.profiles_at);
    } catch (const CheckpointError& e) {
        throw CheckpointError(fmt::format("{}: does not fit the folder: {}", restart.checkpoint.string(), e.what()));
    }
    for (const auto& newer : restart.refused) {
        spdlog::warn("{} is damaged or of another version: set aside as {}.refused", newer.string(),
                     newer.filename().string());
        set_aside(newer);
    }
    spdlog::info("goes on from {}, step {}, t = {:.6g} s{}", restart.checkpoint.string(), run.state.step,
                 run.state.time, restart.input_changed ? ", with a changed input" : "");
    if (restart.input_changed) checkpoint(run);  // older ones know nothing of the change
    run.last_checkpoint = Clock::now();
    run.last_checkpoint_step = run.state.step;
}

bool checkpoint_is_due(const LiveRun& run)
{
    const OutputSpec& o = run.input.output;
    const bool asked = checkpoint_asked_for();  // one that is due anyway fulfils the wish
    return asked || (o.checkpoint > 0.0 && seconds_since(run.last_checkpoint) > o.checkpoint) ||
           (o.checkpoint_steps && run.state.step - run.last_checkpoint_step >= *o.checkpoint_steps);
}

void checkpoint(LiveRun& run)
{
    std::string why = why_not_valid(run.model, run.state);
    if (why.empty() && account_is_off(energy_now(run))) why = "the energy account is off by more than 10 %";
    if (!why.empty()) {
        spdlog::warn("no checkpoint: {}", why);  // the last good one stays
    } else {
        run.mark = run.folder.mark();
        run.folder.write_checkpoint(run.state.step, [&](Archive& archive) { transfer(run, archive); });
    }
    run.last_checkpoint = Clock::now();
    run.last_checkpoint_step = run.state.step;
}

Ending stop_for_signal(LiveRun& run)
{
    const int signal = pending_signal();
    checkpoint(run);
    return {128 + signal, signal == 2 ? "interrupted by SIGINT" : "terminated by SIGTERM"};
}

}  // namespace grainfrac
