// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of a run: stages, steps, what is recorded when, and why it ended.
#pragma once

#include "app/options.h"
#include "app/origin.h"
#include "app/prepare.h"
#include "experiment/experiment.h"
#include "io/crack_start.h"
#include "io/results.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace grainfrac {

/// Why a run stopped.
struct Ending {
    int code = 0;        ///< exit code
    std::string reason;  ///< "load dropped by 50 %", "unstable: ...", "SIGINT"
};

/// Wall time by phase [s].
struct PhaseTimes {
    double build = 0.0, steps = 0.0, output = 0.0, looks = 0.0, splitting = 0.0;
};

/// What the run found out beyond its files. All of it goes into a checkpoint.
struct RunRecord {
    std::vector<HistoryRow> rows;
    std::vector<std::string> warnings;  ///< of input and outcome
    double peak_load = 0.0;             ///< [N]
    double peak_stress = 0.0;           ///< [Pa]
    double peak_time = 0.0;             ///< [s]
    double load_start = 0.0;            ///< where load and displacement count from [s]
    double peak_displacement = 0.0;     ///< [m]
    double kinetic_over_elastic = 0.0;  ///< largest from 10 % of the peak load to the peak [-]
    double imbalance_at_peak = 0.0;     ///< [-]
    double time_step = 0.0;             ///< last one used [s]
    double critical_step = 0.0;         ///< [s]
    std::string limiter;
    double history_interval = 0.0, snapshot_interval = 0.0;  ///< [s]
    PhaseTimes phases;
    Momentum first_momentum, last_momentum;
    CrackWatch cracks;
    std::int64_t splits = 0;
    double split_area = 0.0;                             ///< of all planes that split a grain [m^2]
    double split_energy = 0.0;                           ///< that new surfaces held at the start [J]
    double bonding_energy = 0.0;                         ///< put in, negative, where stages made bonds [J]
    std::map<std::string, std::int64_t> refused_splits;  ///< by reason

    template <class Visit>
    void for_each_member(Visit&& visit)
    {
        auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w] = *this;  // every one of them
        visit("rows", a);
        visit("warnings", b);
        visit("peak_load", c);
        visit("peak_stress", d);
        visit("peak_time", e);
        visit("load_start", f);
        visit("peak_displacement", g);
        visit("kinetic_over_elastic", h);
        visit("imbalance_at_peak", i);
        visit("time_step", j);
        visit("critical_step", k);
        visit("limiter", l);
        visit("history_interval", m);
        visit("snapshot_interval", n);
        visit("phases", o);
        visit("first_momentum", p);
        visit("last_momentum", q);
        visit("cracks", r);
        visit("splits", s);
        visit("split_area", t);
        visit("split_energy", u);
        visit("bonding_energy", v);
        visit("refused_splits", w);
    }
};

/// Where a run that goes on begins.
struct Restart {
    std::filesystem::path checkpoint;
    std::vector<std::filesystem::path> refused;  ///< newer ones, to be set aside
    bool input_changed = false;
    bool new_time_step = false;  ///< to be chosen anew
    bool new_history = false;    ///< its interval
    bool new_snapshots = false;  ///< theirs
};

/// Step through all stages of `built`, writing into `folder`. The state is left at the end of the run. With `restart`
/// what `built` holds is replaced from the checkpoint, and the files of the folder are cut back to it; throws
/// CheckpointError, with the folder as it was, if nothing can go on from it.
Ending simulate(const Case& c, const Options& options, const RunFacts& facts, const RunOrigin& origin, Built& built,
                ResultFolder& folder, RunRecord& record, SnapshotFields& last_fields, const Restart* restart = nullptr);

}  // namespace grainfrac
