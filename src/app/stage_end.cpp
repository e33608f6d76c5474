// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/live_run.h"
#include "motion/servo.h"

#include <fmt/format.h>

#include <cmath>

namespace grainfrac {

namespace {

/// At rest the floor bears the weight within this share of it.
constexpr double balanced = 0.1;

/// A load drop counts only once something failed: waves make the load of a platen dip at first touch.
bool broken_or_damaged(const LiveRun& run)
{
    return run.now.broken > 0;
}

/// Of a ready-made test: closing of both platens; else how far the stage's first moving wall went [m].
double stage_displacement(const LiveRun& run)
{
    if (run.experiment.kind != "custom") return run.record.rows.back().displacement;
    return run.now.stage_body < 0 ? 0.0 : norm(run.state.bodies.position[run.now.stage_body] - run.now.stage_origin);
}

std::string why_pull_out_ended(const LiveRun& run)
{
    const PullOutState& s = run.experiment.pull_out->path.back();
    const StopSpec& stop = run.input.test.stop;
    if (stop.damage && s.mean_damage >= *stop.damage) return fmt::format("mean damage {:.4g} reached", s.mean_damage);
    if (stop.slip && s.exit_slip >= *stop.slip) return fmt::format("slip {:.4g} m reached", s.exit_slip);
    return {};
}

}  // namespace

bool time_is_up(const LiveRun& run, const Stage& s)
{
    const bool test_over =
        run.experiment.kind == "custom" && run.input.test.stop.time && run.state.time >= *run.input.test.stop.time;
    return test_over || (s.duration && run.state.time - run.now.stage_start >= *s.duration);
}

std::string why_ended(const LiveRun& run, const Stage& s)
{
    const HistoryRow& r = run.record.rows.back();
    if (s.duration && run.state.time - run.now.stage_start >= *s.duration)
        return fmt::format("time {:.4g} s reached", run.state.time);
    if (s.displacement && stage_displacement(run) >= *s.displacement) {
        return fmt::format("displacement {:.4g} m reached", stage_displacement(run));
    }
    if (run.experiment.pull_out && !run.experiment.pull_out->path.empty()) {
        if (const std::string why = why_pull_out_ended(run); !why.empty()) return why;
    }
    const double load = stage_load(run, s);
    const auto reached = [&](double wanted) { return s.unloads ? load <= wanted : load >= wanted; };
    if (s.load && reached(*s.load)) return fmt::format("load {:.5g} N reached", load);
    if (s.stress && reached(*s.stress * run.now.stage_section))
        return fmt::format("stress {:.5g} Pa reached", load / run.now.stage_section);
    if (s.load_drop && s.unloads && load <= (1.0 - *s.load_drop) * run.now.stage_first_load)
        return fmt::format("load went back from {:.5g} to {:.5g} N", run.now.stage_first_load, load);
    if (s.load_drop && !s.unloads && broken_or_damaged(run) && load < (1.0 - *s.load_drop) * run.now.stage_peak) {
        return fmt::format("load dropped by {:.0f} % from its peak {:.5g} N", 100.0 * *s.load_drop, run.now.stage_peak);
    }
    // what a moving wall has not reached yet is not at rest
    const bool settled = run.state.time > run.now.stage_start + s.ramp && (s.loaded_wall < 0 || load > 0.0) &&
                         (s.servos.empty() || servos_hold(run.model, run.state));
    if (s.unbalanced_force_ratio && settled && r.unbalanced_force_ratio < *s.unbalanced_force_ratio)
        return fmt::format("unbalanced force ratio below {:.2g}", *s.unbalanced_force_ratio);
    const bool still = r.energy.kinetic <= run.now.energy_floor;  // nothing moved, or round-off does
    if (s.rest && settled &&
        (still || (r.energy.kinetic < *s.rest * run.now.stage_kinetic && r.unbalanced_force_ratio < balanced)))
        return fmt::format("at rest, kinetic energy {:.2g} J", r.energy.kinetic);
    const double lasted = run.state.time - run.now.rest_start;
    if (s.rest_energy && lasted >= s.rest_time &&
        std::fabs(run.now.rest_impulse - s.weight * lasted) < balanced * s.weight * lasted)
        return fmt::format("at rest, kinetic energy {:.2g} J", r.energy.kinetic);
    if (run.input.test.stop.time && run.experiment.kind == "custom" && run.state.time >= *run.input.test.stop.time)
        return "stop.time reached";
    return {};
}

std::string why_path_ended(const LiveRun& run)
{
    if (const std::string why = why_pull_out_ended(run); !why.empty()) return why;
    const PullOutState& s = run.experiment.pull_out->path.back();
    const StopSpec& stop = run.input.test.stop;
    if (stop.strain && s.end_displacement >= *stop.strain * run.experiment.pull_out->length)
        return fmt::format("displacement {:.4g} m reached", s.end_displacement);
    if (stop.time && run.state.time >= *stop.time) return fmt::format("{:.0f} equilibria", run.state.time);
    if (stop.load_drop && broken_or_damaged(run) &&
        run.record.rows.back().load < (1.0 - *stop.load_drop) * run.record.peak_load)
        return fmt::format("load dropped by {:.0f} % from its peak {:.5g} N", 100.0 * *stop.load_drop,
                           run.record.peak_load);
    return {};
}

}  // namespace grainfrac
