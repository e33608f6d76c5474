// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/results.h"

#include "io/atomic_file.h"
#include "io/checkpoint.h"
#include "io/folder_mark.h"
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
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>

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

/// Holds a folder for this process until it ends, however it ends. Where the file system knows no locks, nothing does.
class FolderLock {
public:
    explicit FolderLock(const fs::path& folder) : fd_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))
    {
        if (fd_ < 0) throw std::runtime_error(folder.string() + ": cannot read: " + std::strerror(errno));
        if (::flock(fd_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
        ::close(fd_);
        throw std::runtime_error(folder.string() + ": another run is at work in this folder");
    }
    ~FolderLock() { ::close(fd_); }
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    int fd_;
};

/// Nothing in it but folders, and perhaps a marker half written: what a run leaves that was killed at once.
bool holds_no_file(const fs::path& folder)
{
    std::error_code error;
    const fs::recursive_directory_iterator entries(folder, error);
    return !error && std::all_of(fs::begin(entries), fs::end(entries), [&](const fs::directory_entry& e) {
        return (e.is_directory() && !e.is_symlink()) || e.path() == aside(folder / marker);
    });
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
    if (!holds_no_file(folder) && !fs::is_regular_file(fs::symlink_status(folder / marker, error)))
        throw InputError("--out",
                         fmt::format("{}is not a result folder (it holds no {}); it is not replaced", name, marker));
    if (holds(folder, fs::current_path()))
        throw InputError("--out", name + "holds the working directory; it is not replaced");
    const FolderLock lock(folder);
    // the marker last: without it the rest is no result folder
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        if (entry.path().filename() != marker) fs::remove_all(entry.path(), error);
    }
    fs::remove_all(folder, error);
    if (error) throw InputError("--out", name + "cannot be replaced: " + error.message());
}

}  // namespace

struct ResultFolder::Impl {
    fs::path folder;
    std::optional<FolderLock> lock;
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
    impl_->lock.emplace(folder);
}

ResultFolder::ResultFolder(const fs::path& folder, Existing) : impl_(std::make_unique<Impl>())
{
    impl_->folder = folder;
    if (!fs::is_directory(folder)) throw InputError("DIR", fmt::format("\"{}\" is no folder", folder.string()));
    if (!fs::is_regular_file(folder / marker))
        throw InputError("DIR", fmt::format("\"{}\" is not a result folder (it holds no {})", folder.string(), marker));
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        throw std::runtime_error(folder.string() + ": cannot write: " + std::strerror(errno));
    impl_->lock.emplace(folder);
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
    write_file(impl_->folder / "paraview" / "view.py", view_script(facts.fibre));
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

void ResultFolder::write_culprits([[maybe_unused]] const Model& model, [[maybe_unused]] const State& state,
                                  [[maybe_unused]] const std::vector<int>& bodies)
{
#ifdef GF_HAVE_VTK
    if (!bodies.empty()) grainfrac::write_culprits(impl_->folder / "unstable.vtu", model, state, bodies);
#endif
}

void ResultFolder::append_pull_out(const PullOutState& row, const FibreProfile& profile,
                                   const std::vector<double>& profiles_at)
{
    if (!impl_->pull_out) impl_->pull_out.emplace(impl_->folder, profiles_at);
    impl_->pull_out->append(row, profile);
}

void ResultFolder::write_checkpoint(std::int64_t step, const std::function<void(Archive&)>& content)
{
    write_next_checkpoint(impl_->folder / "checkpoint", step, impl_->facts.version, content);
}

FolderMark ResultFolder::mark()
{
    FolderMark m;
    m.history = impl_->history.value().mark();
    if (impl_->walls) m.walls = impl_->walls->mark();
    if (impl_->pull_out) m.pull_out = impl_->pull_out->mark();
    m.results = impl_->table.value().mark();
#ifdef GF_HAVE_VTK
    m.series = impl_->paraview.value().mark().entries;
    m.frame = impl_->paraview->mark().frame;
#endif
    return m;
}

void ResultFolder::go_on(const RunFacts& facts, const std::string& resolved_toml, const FolderMark& mark,
                         const std::vector<double>& profiles_at)
{
    impl_->facts = facts;
    const fs::path& folder = impl_->folder;
    for (const char* part : {"paraview", "plots", "checkpoint"}) fs::create_directories(folder / part);
    // nothing is changed before it is known that all can go on
    try {
        check_head(folder / "history.csv", mark.history);
        if (mark.walls) check_head(folder / "walls.csv", *mark.walls);
        if (mark.pull_out) check_heads(folder, *mark.pull_out);
        if (const std::string why = why_not_of(folder / "results.h5", mark.results.skeleton); !why.empty())
            throw std::runtime_error((folder / "results.h5").string() + ": " + why);
        impl_->table.emplace(folder / "results.h5", facts, mark.results);
    } catch (const std::runtime_error& e) {
        throw CheckpointError(e.what());  // the one before may know less of them, or they may be of another run
    }
    // written at an end that is none any more; the first of them tells that a run has ended
    for (const char* file : {"summary.json", "fragments.csv", "clusters.csv"}) fs::remove(folder / file);
    fs::remove_all(folder / "plots");
    fs::create_directory(folder / "plots");
    write_file(folder / marker, resolved_toml);
    impl_->history.emplace(folder / "history.csv", mark.history);
    if (mark.walls)
        impl_->walls.emplace(folder / "walls.csv", *mark.walls);
    else
        fs::remove(folder / "walls.csv");
    if (mark.pull_out)
        impl_->pull_out.emplace(folder, profiles_at, *mark.pull_out);
    else
        for (const char* file : {"pull_out.csv", "profiles.csv"}) fs::remove(folder / file);
#ifdef GF_HAVE_VTK
    impl_->paraview.emplace(folder / "paraview", ParaviewMark{mark.series, mark.frame});
    if (const std::vector<std::string> missing = missing_frames(folder / "paraview", impl_->paraview->mark());
        !missing.empty())
        spdlog::warn("{}: {} files of the series are missing, the first of them {}; they are not made anew",
                     (folder / "paraview").string(), missing.size(), missing.front());
    write_file(folder / "paraview" / "view.py", view_script(facts.fibre));
#endif
    for (const char* part : {"", "checkpoint", "paraview"}) {  // files of a killed run that never got whole
        for (const auto& entry : fs::directory_iterator(folder / part)) {
            if (entry.path().extension() == ".tmp") fs::remove(entry.path());
        }
    }
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
    std::string not_plotted;
    if (plots) {
        try {
            if (impl_->pull_out) write_pull_out_plots(impl_->folder);
            write_plots(impl_->folder, model, state, cracks, fragments, clusters);
        } catch (const std::exception& e) {
            not_plotted = e.what();
        }
    }
    write_file(impl_->folder / "summary.json", summary_json);  // last: it tells that the run has ended
    if (!not_plotted.empty()) throw PlotError(not_plotted);
}

}  // namespace grainfrac
