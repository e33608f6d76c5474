// SPDX-License-Identifier: GPL-3.0-or-later
// A run that was interrupted goes on from its newest checkpoint, to the bits that it would have reached without the
// interruption.
#include "app/prepare.h"
#include "app/run.h"
#include "app/signals.h"
#include "app/version.h"
#include "io/atomic_file.h"
#include "io/checkpoint.h"
#include "io/input.h"
#include "io/input_document.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <cstring>
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

/// `text` as one word of a shell.
std::string quoted(const std::string& text)
{
    const bool plain = !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char ch) {
        return std::isalnum(ch) != 0 || std::strchr("/._-+=:,@%", ch) != nullptr;
    });
    if (plain) return text;
    std::string word = "'";
    for (const char ch : text) word += ch == '\'' ? std::string("'\\''") : std::string(1, ch);
    return word + "'";
}

/// `origin`: nullptr if no checkpoint told it. Files that the input names lie beside the original one.
std::string anew(const fs::path& folder, const RunOrigin* origin)
{
    const std::string tail = fmt::format(" --out {} --force", quoted(folder.string()));
    if (origin == nullptr)
        return "; begin anew with grainfrac run FILE" + tail + ", with the input and --set of the run";
    std::string command = "; begin anew with grainfrac run " + quoted(origin->file);
    for (const std::string& o : origin->overrides) command += " --set " + quoted(o);
    return command + tail;
}

void list_changes(const std::vector<InputChange>& changed)
{
    for (const InputChange& c : changed) {
        const auto shown = [](const std::string& value) { return value.empty() ? "none" : value.c_str(); };
        std::string line = "  " + c.key;
        if (!c.before.empty() || !c.now.empty()) line += fmt::format(": {}, was {}", shown(c.now), shown(c.before));
        fmt::print(stderr, "{}{}\n", line, c.in_course ? "" : " (cannot change during a run)");
    }
}

/// Prints what differs; throws ReportedInputError unless the run may go on so.
void check_changes(const fs::path& folder, const std::vector<InputChange>& changed, bool allowed,
                   const RunOrigin& before)
{
    if (changed.empty()) return;
    fmt::print(stderr, "{}: {}: the input is not the one that the run began with:\n", allowed ? "warning" : "error",
               folder.string());
    list_changes(changed);
    const bool possible = std::all_of(changed.begin(), changed.end(), [](const InputChange& c) { return c.in_course; });
    if (allowed && possible) return;
    if (possible)
        fmt::print(stderr, "go on with the new values with --allow-changes, or undo the changes\n");
    else
        fmt::print(stderr, "undo these changes{}\n", anew(folder, &before));
    throw ReportedInputError{};
}

/// A newer checkpoint, or a resume that was killed before it wrote one, went on with an allowed change that `before`
/// does not know: it must not get lost unseen.
void check_lost_changes(const fs::path& folder, const RunOrigin& before, const RunOrigin& now, bool allowed)
{
    RunOrigin newest;
    std::vector<InputChange> lost;
    try {
        newest.resolved = read_file(folder / "resolved.toml");
        for (const InputChange& c : changes(before, newest)) lost.push_back(c);
        const std::vector<InputChange> given = changes(before, now);
        std::erase_if(lost, [&](const InputChange& l) {
            return std::any_of(given.begin(), given.end(), [&](const InputChange& g) { return g.key == l.key; });
        });
    } catch (const std::runtime_error&) {
        return;  // a record only: a damaged one tells nothing
    }
    if (lost.empty()) return;
    fmt::print(stderr, "{}: {}: the run went on with changes that the checkpoint to be used is older than:\n",
               allowed ? "warning" : "error", folder.string());
    list_changes(lost);
    if (allowed) return fmt::print(stderr, "it goes on without them\n");
    fmt::print(stderr, "give them again with --set and --allow-changes, or go on without them with --allow-changes\n");
    throw ReportedInputError{};
}

/// Whether a run that has ended can go on with the new value: the end of its last stage is put off, or the step of an
/// unstable one is another.
bool puts_off_end(const InputChange& change, const Ending& ended, const Case& c)
{
    if (ended.code != exit_code::done) return change.key.starts_with("control.time_step");
    bool unloads = false;
    if (!change.key.starts_with("test.stop.")) {
        if (c.stages.empty() || !change.key.starts_with(fmt::format("stages[{}].", c.stages.size() - 1))) return false;
        unloads = c.stages.back().kind == "unload";
    }
    if (change.before.empty()) return false;  // one more way to end
    if (change.now.empty()) return true;
    const std::string name = change.key.substr(change.key.rfind('.') + 1);
    const bool from_above =
        name == "rest" || name == "unbalanced_force_ratio" || (unloads && (name == "load" || name == "stress"));
    const double before = std::strtod(change.before.c_str(), nullptr), now = std::strtod(change.now.c_str(), nullptr);
    return from_above ? now < before : now > before;
}

/// Throws ReportedInputError if the changes give a run that has ended nothing to go on with.
void check_end(const fs::path& folder, const std::vector<InputChange>& changed, const Ending& ended, const Case& c)
{
    if (std::any_of(changed.begin(), changed.end(), [&](const InputChange& x) { return puts_off_end(x, ended, c); }))
        return;
    fmt::print(stderr, "error: {}: the run has ended: {}; with these changes there is nothing to go on with:\n",
               folder.string(), ended.reason);
    list_changes(changed);
    throw ReportedInputError{};
}

int nothing_to_do(const fs::path& folder, const Ending& ended)
{
    fmt::print("{}: the run has ended: {}; there is nothing to go on with\n", folder.string(), ended.reason);
    return ended.code;
}

int resume_from(Restart& restart, const Options& o, ResultFolder& folder, const std::optional<Ending>& ended,
                std::optional<RunOrigin>& known)
{
    const auto start = std::chrono::steady_clock::now();
    RunOrigin before;
    double time = 0.0;
    read_checkpoint(restart.checkpoint, GRAINFRAC_VERSION, [&](Archive& archive) {
        archive("/origin", before);
        archive("/state/time", time);
        if (before.files.size() != before.checksums.size()) archive.fail("/origin does not fit together");
        (void)parse_document(before.resolved, "resolved.toml");
    });
    known = before;

    Options input = o;
    input.file = (folder.path() / "input.toml").string();
    input.overrides = before.overrides;
    input.overrides.insert(input.overrides.end(), o.overrides.begin(), o.overrides.end());
    Case c = load_case(input);
    c.file = before.file;  // what it names lies beside that
    const Device device = parse_device(o.device);
    const RunOrigin now = origin_of(c, input.overrides, to_toml(c), device);
    const std::vector<InputChange> changed = changes(before, now);
    if (ended && changed.empty()) return nothing_to_do(folder.path(), *ended);
    if (ended) {
        check_end(folder.path(), changed, *ended, c);
        fmt::print(stderr, "warning: {}: the run has ended: {}; what came after {}, t = {:.4g} s, {} made anew\n",
                   folder.path().string(), ended->reason, restart.checkpoint.filename().string(), time,
                   o.allow_changes ? "is" : "would be");
    }
    check_lost_changes(folder.path(), before, now, o.allow_changes);
    check_changes(folder.path(), changed, o.allow_changes, before);
    if (now.device != before.device)
        fmt::print(stderr, "warning: the run was on {}, now it is on {}: results agree to round-off only\n",
                   before.device, now.device);
    const auto any = [&](const char* head) {
        return std::any_of(changed.begin(), changed.end(),
                           [&](const InputChange& x) { return x.key.starts_with(head); });
    };
    restart.input_changed = !changed.empty();
    restart.new_time_step = any("control.time_step");
    restart.new_history = any("output.history");
    restart.new_snapshots = any("output.every") || any("output.snapshots");

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
    std::optional<RunOrigin> known;
    for (const fs::path& checkpoint : list_checkpoints(folder.path() / "checkpoint")) {
        restart.checkpoint = checkpoint;
        try {
            return resume_from(restart, o, folder, ended, known);
        } catch (const CheckpointError& e) {
            fmt::print(stderr, "warning: {}; not used\n", e.what());
            restart.refused.push_back(checkpoint);
        }
    }
    if (ended && o.overrides.empty()) return nothing_to_do(folder.path(), *ended);
    throw std::runtime_error(
        fmt::format("{}: {}{}", folder.path().string(),
                    restart.refused.empty() ? "holds no checkpoint" : "holds no checkpoint that can be gone on from",
                    anew(folder.path(), known ? &*known : nullptr)));
}

}  // namespace grainfrac
