// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/results.h"

#include "io/atomic_file.h"
#include "io/checkpoint.h"
#include "io/fragments.h"
#include "io/hdf5_results.h"
#include "io/history_csv.h"
#include "io/plots.h"
#include "io/pull_out_files.h"
#include "io/view_script.h"
#include "io/wall_history.h"
#ifdef GF_HAVE_VTK
#include "io/paraview.h"
#endif

#include <fmt/format.h>

#include <optional>
#include <system_error>

namespace grainfrac {

namespace fs = std::filesystem;

namespace {

constexpr const char* marker = "resolved.toml";  // what makes a folder a result folder

/// True if `folder` is `of` or lies above it.
bool holds(const fs::path& folder, const fs::path& of)
{
    std::error_code error;
    const fs::path inner = fs::canonical(of, error), outer = fs::canonical(folder, error);
    if (error) return true;
    for (fs::path p = inner;; p = p.parent_path()) {
        if (p == outer) return true;
        if (p == p.root_path()) return false;
    }
}

/// Removes an old result folder. Whatever else `folder` may be is refused and stays as it is.
void clear_way(const fs::path& folder, bool replace)
{
    std::error_code error;
    const fs::file_status status = fs::symlink_status(folder, error);
    if (!fs::exists(status)) return;
    const std::string name = fmt::format("\"{}\" ", folder.string());
    if (!replace)
        throw InputError("--out", name + "exists; choose another folder or allow it to be replaced with --force");
    if (!fs::is_directory(status)) throw InputError("--out", name + "is not a folder; it is not replaced");
    const bool empty = fs::is_empty(folder, error);
    if (!empty && !fs::is_regular_file(fs::symlink_status(folder / marker, error)))
        throw InputError("--out",
                         fmt::format("{}is not a result folder (it holds no {}); it is not replaced", name, marker));
    if (holds(folder, fs::current_path()))
        throw InputError("--out", name + "holds the working directory; it is not replaced");
    fs::remove_all(folder, error);
    if (error) throw InputError("--out", name + "cannot be replaced: " + error.message());
}

}  // namespace

struct ResultFolder::Impl {
    fs::path folder;
    RunFacts facts;
    std::optional<HistoryCsv> history;
    std::optional<WallHistory> walls;  // from its first row on
    std::optional<Hdf5Results> table;
    std::optional<PullOutFiles> pull_out;  // from its first row on
#ifdef GF_HAVE_VTK
    std::optional<ParaviewSeries> paraview;
#endif
};

ResultFolder::ResultFolder(const fs::path& folder, bool replace) : impl_(std::make_unique<Impl>())
{
    impl_->folder = folder;
    clear_way(folder, replace);
    std::error_code error;
    for (const char* part : {"paraview", "plots", "checkpoint"}) {
        fs::create_directories(folder / part, error);
        if (error) throw InputError("--out", fmt::format("cannot create \"{}\": {}", folder.string(), error.message()));
    }
}

ResultFolder::~ResultFolder() = default;

const fs::path& ResultFolder::path() const
{
    return impl_->folder;
}

void ResultFolder::begin(const RunFacts& facts, const std::string& input_text, const std::string& resolved_toml)
{
    impl_->facts = facts;
    // The marker first: a folder left by a run that failed here can be replaced.
    write_file(impl_->folder / marker, resolved_toml);
    write_file(impl_->folder / "input.toml", input_text);
    impl_->history.emplace(impl_->folder / "history.csv", facts);
    impl_->table.emplace(impl_->folder / "results.h5", facts);
#ifdef GF_HAVE_VTK
    impl_->paraview.emplace(impl_->folder / "paraview");
    write_file(impl_->folder / "paraview" / "view.py", view_script());
#endif
}

void ResultFolder::append_history(const HistoryRow& row)
{
    impl_->history.value().append(row);
    impl_->table.value().append_history(row);
}

void ResultFolder::append_walls(const Model& model, const State& state)
{
    if (!impl_->walls) impl_->walls.emplace(impl_->folder / "walls.csv", impl_->facts, model);
    impl_->walls->append(model, state);
}

void ResultFolder::write_snapshot(const Model& model, const State& state, const SnapshotFields& fields,
                                  [[maybe_unused]] bool contacts)
{
    const std::vector<CrackFace> cracks = collect_cracks(model, state);
#ifdef GF_HAVE_VTK
    impl_->paraview.value().write_frame(model, state, fields, cracks, contacts);
#endif
    impl_->table.value().append_snapshot(model, state, fields, cracks);
}

void ResultFolder::append_pull_out(const PullOutState& row, const FibreProfile& profile,
                                   const std::vector<double>& profiles_at)
{
    if (!impl_->pull_out) impl_->pull_out.emplace(impl_->folder, profiles_at);
    impl_->pull_out->append(row, profile);
}

void ResultFolder::write_checkpoint(const Model& model, const State& state)
{
    write_next_checkpoint(impl_->folder / "checkpoint", model, state, impl_->facts.version);
}

void ResultFolder::finish(const std::string& summary_json, const Model& model, const State& state,
                          const SnapshotFields& fields, bool plots)
{
    const std::vector<CrackFace> cracks = collect_cracks(model, state);
    impl_->table.value().finish(model, state, fields, cracks);
    impl_->table.value().close();
    impl_->history.value().close();
    if (impl_->pull_out) impl_->pull_out->finish();
    const std::vector<Cluster> clusters = collect_clusters(model, state, fields);
    const std::vector<Fragment> fragments = collect_fragments(model, state, fields);
    write_fragment_tables(impl_->folder, impl_->facts, fragments, clusters);
    write_file(impl_->folder / "summary.json", summary_json);
    if (!plots) return;
    try {
        if (impl_->pull_out) write_pull_out_plots(impl_->folder);
        write_plots(impl_->folder, model, state, cracks, fragments, clusters);
    } catch (const std::exception& e) {
        throw PlotError(e.what());
    }
}

}  // namespace grainfrac
