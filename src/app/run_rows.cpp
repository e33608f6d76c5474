// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/live_run.h"
#include "app/wall_clock.h"
#include "fracture/clusters.h"
#include "motion/servo.h"

#include <algorithm>
#include <set>

namespace grainfrac {

namespace {

void count_broken(LiveRun& run, HistoryRow& r)
{
    const InterfaceBonds& f = run.state.interfaces;
    for (int i = 0; i < f.size(); ++i) {
        if (f.failure_time[i] < 0.0) continue;
        (f.shear_share[i] < 0.5 * f.area[i] ? r.broken_bonds_tension : r.broken_bonds_shear) += 1;
    }
    const auto count = [&](const auto& bonds) {
        for (int i = 0; i < bonds.size(); ++i) {
            if (bonds.cause[i] == static_cast<int>(BondCause::tension)) ++r.broken_bonds_tension;
            if (bonds.cause[i] == static_cast<int>(BondCause::shear)) ++r.broken_bonds_shear;
        }
    };
    count(run.state.parallels);
    count(run.state.sphere_bonds);
    const std::int64_t broken = r.broken_bonds_tension + r.broken_bonds_shear;
    if (broken != run.now.broken || run.record.rows.empty()) {
        const std::vector<std::int32_t> cluster = bonded_clusters(run.state);
        run.now.fragments = static_cast<std::int64_t>(std::set<std::int32_t>(cluster.begin(), cluster.end()).size()) -
                            (std::find(cluster.begin(), cluster.end(), -1) != cluster.end() ? 1 : 0);
        run.now.broken = broken;
        run.record.cracks.look(run.model, run.state);
    }
    r.fragments = run.now.fragments;
}

/// How long the kinetic energy has been low, and the impulse of the floor since then.
void watch_rest(LiveRun& run, const Stage& s, const HistoryRow& r)
{
    if (!s.rest_energy || run.record.rows.empty() || r.energy.kinetic >= *s.rest_energy) {
        run.now.rest_start = r.time;
        run.now.rest_impulse = 0.0;
        return;
    }
    const HistoryRow& before = run.record.rows.back();
    run.now.rest_impulse += 0.5 * (before.load + r.load) * (r.time - before.time);
}

}  // namespace

double stage_load(const LiveRun& run, const Stage& stage)
{
    if (stage.loaded_wall < 0) return run.record.rows.empty() ? 0.0 : run.record.rows.back().load;
    return wall_push(run.model, run.state, stage.loaded_wall, stage.load_direction);
}

void record_row(LiveRun& run, const Stage& stage)
{
    const auto before = Clock::now();
    const Measurement m = measure(run.experiment, run.model, run.state);
    HistoryRow r;
    r.step = run.state.step;
    r.time = run.state.time;
    r.displacement = m.displacement;
    r.load = m.load;
    r.nominal_strain = m.strain;
    r.nominal_stress = m.stress;
    r.energy = energy_ledger(run.model, run.state);
    r.energy.negligible = run.now.energy_floor;
    r.unbalanced_force_ratio = unbalanced_force_ratio(run.state);
    r.platen_imbalance = m.platen_imbalance;
    count_broken(run, r);
    r.cracks = crack_sums(run.state);
    r.split_grains = run.record.splits;
    watch_rest(run, stage, r);
    run.folder.append_history(r);
    if (!run.model.walls.empty() && (run.experiment.kind == "custom" || run.experiment.kind == "drop"))
        run.folder.append_walls(run.model, run.state);
    if (run.experiment.pull_out) {
        run.experiment.pull_out->path.push_back(pull_out_state(*run.experiment.pull_out, run.state));
        run.folder.append_pull_out(run.experiment.pull_out->path.back(),
                                   fibre_profile(*run.experiment.pull_out, run.state), run.input.test.profiles_at);
    }
    run.record.rows.push_back(r);
    if (m.load > run.record.peak_load) {
        run.record.peak_load = m.load;
        run.record.peak_stress = m.stress;
        run.record.peak_time = r.time;
        run.record.peak_displacement = m.displacement;
        run.record.imbalance_at_peak = m.platen_imbalance;
    }
    run.now.stage_peak = std::max(run.now.stage_peak, stage_load(run, stage));
    run.now.stage_kinetic = std::max(run.now.stage_kinetic, r.energy.kinetic);
    run.now.next_history = run.state.time + run.now.history;
    run.record.phases.output += seconds_since(before);
}

}  // namespace grainfrac
