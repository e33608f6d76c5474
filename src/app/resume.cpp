// SPDX-License-Identifier: GPL-3.0-or-later
// A run that was interrupted goes on from its newest checkpoint, to the bits that it would have reached without the
// interruption.
#include "app/prepare.h"
#include "app/run.h"
#include "app/signals.h"
#include "app/version.h"
#include "io/checkpoint.h"
#include "io/input.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>

namespace grainfrac {

namespace {

namespace fs = std::filesystem;

/// How the run in the folder ended; nothing if it was broken off.
std::optional<Ending> end_of_run(const fs::path& folder)
{
    std::ifstream in(folder / "summary.json");
    if (!in) return {};
    const nlohmann::json summary = nlohmann::json::parse(in, nullptr, false);
    try {
        const Ending end{summary.at("exit").at("code"), summary.at("exit").at("reason")};
        const bool broken_off = end.code == exit_code::interrupted || end.code == exit_code::terminated;
        return broken_off ? std::nullopt : std::optional(end);
    } catch (const nlohmann::json::exception&) {
        return {};  // damaged; it is written again at the end
    }
}

std::string anew(const fs::path& folder)
{
    return fmt::format("; begin anew with grainfrac run {} --out {} --force", (folder / "input.toml").string(),
                       folder.string());
}

/// Prints what differs; throws ReportedInputError unless the run may go on so.
void check_changes(const fs::path& folder, const std::vector<InputChange>& changed, bool allowed)
{
    if (changed.empty()) return;
    fmt::print(stderr, "{}: {}: the input is not the one that the run began with:\n", allowed ? "warning" : "error",
               folder.string());
    bool possible = true;
    for (const InputChange& c : changed) {
        const auto shown = [](const std::string& value) { return value.empty() ? "none" : value.c_str(); };
        std::string line = "  " + c.key;
        if (!c.before.empty() || !c.now.empty()) line += fmt::format(": {}, was {}", shown(c.now), shown(c.before));
        fmt::print(stderr, "{}{}\n", line, c.in_course ? "" : " (cannot change during a run)");
        possible = possible && c.in_course;
    }
    if (allowed && possible) return;
    if (possible)
        fmt::print(stderr, "go on with the new values with --allow-changes, or undo the changes\n");
    else
        fmt::print(stderr, "undo these changes{}\n", anew(folder));
    throw ReportedInputError{};
}

int resume_from(Restart& restart, const Options& o, ResultFolder& folder, const std::optional<Ending>& ended)
{
    const auto start = std::chrono::steady_clock::now();
    RunOrigin before;
    read_checkpoint(restart.checkpoint, GRAINFRAC_VERSION, [&](Archive& archive) { archive("/origin", before); });

    Options input = o;
    input.file = (folder.path() / "input.toml").string();
    input.overrides = before.overrides;
    input.overrides.insert(input.overrides.end(), o.overrides.begin(), o.overrides.end());
    Case c = load_case(input);
    c.file = before.file;  // what it names lies beside that
    const Device device = parse_device(o.device);
    const RunOrigin now = origin_of(c, input.overrides, to_toml(c), device);
    const std::vector<InputChange> changed = changes(before, now);
    check_changes(folder.path(), changed, o.allow_changes);
    if (ended && changed.empty()) {
        fmt::print("{}: the run has ended: {}; there is nothing to go on with\n", folder.path().string(),
                   ended->reason);
        return ended->code;
    }
    if (now.device != before.device)
        fmt::print(stderr, "warning: the run was on {}, now it is on {}: results agree to round-off only\n",
                   before.device, now.device);
    const auto any = [&](const char* head) {
        return std::any_of(changed.begin(), changed.end(),
                           [&](const InputChange& x) { return x.key.starts_with(head); });
    };
    restart.input_changed = !changed.empty();
    restart.new_time_step = any("control.time_step");
    restart.new_intervals = any("output.");

    Built built = build_case(c, device);
    RunRecord record;
    record.phases.build = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return carry_out(c, o, run_facts(c, now.resolved, device), now, built, folder, record, &restart);
}

}  // namespace

int resume_command(const Options& o)
{
    survive_signals();
    ResultFolder folder(o.out, ResultFolder::Existing::go_on);
    const std::optional<Ending> ended = end_of_run(folder.path());
    Restart restart;
    for (const fs::path& checkpoint : list_checkpoints(folder.path() / "checkpoint")) {
        restart.checkpoint = checkpoint;
        try {
            return resume_from(restart, o, folder, ended);
        } catch (const CheckpointError& e) {
            fmt::print(stderr, "warning: {}; not used\n", e.what());
            restart.refused.push_back(checkpoint);
        }
    }
    throw std::runtime_error(
        fmt::format("{}: {}{}", folder.path().string(),
                    restart.refused.empty() ? "holds no checkpoint" : "holds no checkpoint that can be gone on from",
                    anew(folder.path())));
}

}  // namespace grainfrac
