// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/run.h"

#include "app/prepare.h"
#include "app/signals.h"
#include "app/simulation.h"
#include "app/summary.h"
#include "app/version.h"
#include "gpu/device.h"
#include "gpu/thread_pool.h"
#include "io/atomic_file.h"
#include "io/input.h"
#include "model/checksum.h"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

namespace grainfrac {

namespace {

void open_log(const std::filesystem::path& folder, const Options& o, bool anew)
{
    auto file = std::make_shared<spdlog::sinks::basic_file_sink_mt>((folder / "run.log").string(), anew);
    auto screen = std::make_shared<spdlog::sinks::stderr_sink_mt>();
    screen->set_level(o.quiet ? spdlog::level::err : (o.verbose ? spdlog::level::debug : spdlog::level::warn));
    screen->set_pattern("%l: %v");
    auto logger = std::make_shared<spdlog::logger>("run", spdlog::sinks_init_list{file, screen});
    logger->flush_on(spdlog::level::info);
    spdlog::set_default_logger(logger);
}

/// Said at once, in run.log and in summary.json.
template <class... Args>
void warn(RunRecord& record, fmt::format_string<Args...> text, Args&&... args)
{
    record.warnings.push_back(fmt::format(text, std::forward<Args>(args)...));
    spdlog::warn("{}", record.warnings.back());
}

void warn_about_outcome(const Built& b, RunRecord& record)
{
    const Experiment& test = b.experiment;
    const Ledger e = energy_ledger(b.model, b.state);
    const double scale = std::max({std::fabs(e.external), std::fabs(e.gravity), e.kinetic, e.initial});
    const double by_contacts = e.inserted - record.split_energy - record.bonding_energy;
    const bool by_events = test.pull_out && test.pull_out->quasi_static;  // they put in and take out what steps do not
    if (!by_events && std::fabs(by_contacts) > 1e-3 * scale) {
        warn(record,
             "contacts that took over from bonds, or were shared out when a grain split, stored {:.2g} of the largest "
             "energy "
             "more than what was there before",
             by_contacts / scale);
    }
    if (e.relative_error() > 1e-3) {
        warn(record, "the energy account is off by {:.2g} of its largest term; lower {}", e.relative_error(),
             by_events ? "test.damage_step or test.relaxed" : "control.time_step_safety");
    }
    if (test.quasi_static && test.pull_out && record.imbalance_at_peak > 1e-2) {
        warn(record,
             "at the peak the support bears {:.2g} more or less than the grip pulls with (quasi-static: < 0.01); load "
             "more slowly",
             record.imbalance_at_peak);
    }
    if (test.quasi_static && record.kinetic_over_elastic > 1e-2) {
        warn(record,
             "kinetic energy reached {:.2g} of the elastic energy before the peak (quasi-static: < 0.01); load more "
             "slowly",
             record.kinetic_over_elastic);
    }
}

void print_outcome(const RunFacts& facts, const Built& b, const RunRecord& record, const Ending& ending,
                   const std::filesystem::path& out)
{
    const Ledger e = energy_ledger(b.model, b.state);
    fmt::print("{}: {} ({} steps, {:.4g} s simulated, {:.1f} s run on {})\n", ending.code == 0 ? "done" : "stopped",
               ending.reason, b.state.step, b.state.time, record.phases.steps + record.phases.output, facts.device);
    if (record.peak_load > 0.0) {
        fmt::print("peak load {:.5g} N at {:.4g} m", record.peak_load, record.peak_displacement);
        if (record.peak_stress > 0.0) fmt::print(", nominal strength {:.4g} MPa", 1e-6 * record.peak_stress);
        fmt::print("\n");
    }
    const HistoryRow& last = record.rows.back();
    fmt::print("broken faces: {} in tension, {} in shear; {} fragments\n", last.broken_bonds_tension,
               last.broken_bonds_shear, last.fragments);
    fmt::print("energy account: off by {:.1e} of the largest term\n", e.relative_error());
    fmt::print("results: {}\n", out.string());
}

}  // namespace

RunFacts run_facts(const Case& c, const std::string& resolved, Device device)
{
    // two runs with the same hash of the resolved input simulate the same thing
    const std::string hash = fmt::format("{:016x}", checksum(resolved.data(), resolved.size()));
    const bool fibre = c.test.kind == "pull_out" ||
                       std::any_of(c.parts.begin(), c.parts.end(), [](const PartSpec& p) { return !p.inside.empty(); });
    return {GRAINFRAC_VERSION, hash, to_string(device), c.simulation.seed, threads(), c.test.kind, fibre};
}

int carry_out(const Case& c, const Options& o, const RunFacts& facts, const RunOrigin& origin, Built& built,
              ResultFolder& folder, RunRecord& record, const Restart* restart)
{
    open_log(folder.path(), o, restart == nullptr);
    spdlog::info(
        "grainfrac {}: {} bodies, {} interfaces with {} points, {} parallel bonds, {} bonds of spheres, device {}, {} "
        "threads",
        GRAINFRAC_VERSION, built.state.bodies.size(), built.state.interfaces.size(), built.state.points.size(),
        built.state.parallels.size(), built.state.sphere_bonds.size(), facts.device, threads());
    if (restart == nullptr) {  // else they are in the record
        for (const std::string& line : plausibility_warnings(c, built, choose_time_step(c, built.model, built.state)))
            warn(record, "{}", line);
    }
    watch_signals();
    SnapshotFields fields;
    const Ending ending = simulate(c, o, facts, origin, built, folder, record, fields, restart);
    if (ending.code == exit_code::unstable || ending.code == exit_code::wrong_input) spdlog::error("{}", ending.reason);
    warn_about_outcome(built, record);
    try {
        folder.finish(summary_json(facts, c, built, record, ending, fields), built.model, built.state, fields,
                      !o.no_report);
    } catch (const PlotError& e) {
        spdlog::warn("plots: {}", e.what());
    }
    spdlog::info("ended: {}", ending.reason);
    if (!o.quiet) print_outcome(facts, built, record, ending, folder.path());
    spdlog::shutdown();
    return ending.code;
}

int run_command(const Options& o)
{
    survive_signals();
    const Case c = load_case(o);
    const std::string input_text = read_file(o.file);
    const Device device = parse_device(o.device);
    const auto before = std::chrono::steady_clock::now();
    Built built = build_case(c, device);
    const std::filesystem::path out = o.out.empty() ? std::filesystem::path(o.file).stem().string() + ".out" : o.out;
    const std::string resolved = to_toml(c);
    start_check(c, built);

    RunRecord record;
    const RunFacts facts = run_facts(c, resolved, device);
    const RunOrigin origin = origin_of(c, o.overrides, resolved, device);
    ResultFolder folder(out, o.force);
    folder.begin(facts, input_text, resolved);
    record.phases.build = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    return carry_out(c, o, facts, origin, built, folder, record);
}

}  // namespace grainfrac
