// SPDX-License-Identifier: GPL-3.0-or-later
// Signals, full disks, changed inputs, damaged checkpoints, readers of a run that goes on.
#include "io/hdf5_file.h"
#include "support/scenes.h"

#include <chrono>
#include <random>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <thread>

using namespace program_test;
using grainfrac::Hdf5File;

namespace {

void wait_for_rows(Child& child, const fs::path& history, std::size_t rows)
{
    while (child.running() && history_rows(history).size() < rows)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

std::vector<fs::path> checkpoints(const fs::path& folder)
{
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder / "checkpoint")) {
        if (entry.path().extension() == ".h5") found.push_back(entry.path());
    }
    const auto step = [](const fs::path& p) { return std::stol(p.stem().string().substr(5)); };
    std::sort(found.begin(), found.end(), [&](const fs::path& a, const fs::path& b) { return step(a) > step(b); });
    return found;
}

/// Runs the scene into `out`, killed once it has so many rows.
void run_and_kill(const Workplace& w, const Scene& scene, const std::string& out, std::size_t rows)
{
    Child child(w, run_arguments(w, scene, out));
    wait_for_rows(child, w.folder / out / "history.csv", rows);
    REQUIRE(child.running());
    child.send(SIGKILL);
    child.wait();
}

int resume(const Workplace& w, const std::string& out, const std::vector<std::string>& more = {})
{
    std::vector<std::string> a = resume_arguments(out);
    a.insert(a.end(), more.begin(), more.end());
    return Child(w, a).wait();
}

std::string said(const Workplace& w)
{
    return text_of(w.folder / "err.txt");
}

/// A small disk of its own, if this user can have one.
class SmallDisk {
public:
    SmallDisk(const fs::path& place, int kilobytes) : place_(place)
    {
        fs::create_directories(place);
        there_ = ::mount("tmpfs", place.c_str(), "tmpfs", 0, size(kilobytes).c_str()) == 0;
    }
    ~SmallDisk()
    {
        if (there_) ::umount2(place_.c_str(), MNT_DETACH);
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;
    bool there() const { return there_; }
    void enlarge(int kilobytes) const
    {
        REQUIRE(::mount("tmpfs", place_.c_str(), "tmpfs", MS_REMOUNT, size(kilobytes).c_str()) == 0);
    }

    void forbid_writing() const
    {
        REQUIRE(::mount("tmpfs", place_.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr) == 0);
    }

private:
    static std::string size(int kilobytes) { return "size=" + std::to_string(kilobytes) + "k"; }
    fs::path place_;
    bool there_ = false;
};

/// Within a few steps of the grip the matrix tears off its far face, which is held in the mean.
Scene torn_matrix()
{
    return {"a pull-out in which the matrix tears",
            R"([materials.stiff]
density = 4443
young_modulus = "50 GPa"
poisson_ratio = 0.2
[materials.soft]
density = 4443
young_modulus = "5 GPa"
poisson_ratio = 0.2
[[parts]]
name = "matrix"
kind = "spheres"
material = "soft"
generator = "hcp"
diameter = "1 m"
lattice_origin = "channel"
region = { shape = "cylinder", diameter = "5 m", height = "4 m", axis = "z" }
[[parts]]
name = "fibre"
kind = "spheres"
material = "stiff"
generator = "chain"
diameter = "0.8 m"
inside = "matrix"
fibre = { from = [0, 0, "-1.2 m"], to = [0, 0, "2 m"], radius = "1 m" }
[[bonds]]
between = ["matrix", "matrix"]
law = "parallel"
failure = "point"
shear_ratio = 0.4
tensile_strength = "0.5 MPa"
cohesion = "5 MPa"
[[bonds]]
between = ["fibre", "fibre"]
law = "parallel"
failure = "unbreakable"
[[bonds]]
between = ["fibre", "matrix"]
law = "interface"
shear_stiffness = "1e9 Pa/m"
yield_slip = "1 mm"
failure_slip = "3 mm"
[test]
kind = "pull_out"
fibre = "fibre"
matrix = "matrix"
control = "displacement"
displacement_step = "0.1 mm"
support = "uniform"
stop = { load_drop = 0.5 }
[output]
every = 1.0
checkpoint_steps = 1000000
)",
            {}};
}

/// What a run wrote before it failed can be read: whole rows, whole snapshots.
void check_readable(const fs::path& folder)
{
    const std::vector<std::string> rows = history_rows(folder / "history.csv");
    const Hdf5File file = Hdf5File::open(folder / "results.h5", Hdf5File::Access::live);
    const auto extents = file.extents("/history");
    CHECK(extents[0] + 1 >= rows.size());
    CHECK(extents[0] <= rows.size() + 1);
    CHECK(file.read<double>("/history").size() == extents[0] * extents[1]);
    for (const double t : file.read<double>("/snapshots/time")) CHECK(t >= 0.0);
}

/// On a disk of so many kilobytes the run fails with a reason; with room it goes on to the bits of `whole`.
/// @return what it failed at, "" if it did not
std::string run_on_small_disk(const Workplace& w, const Scene& scene, int kilobytes)
{
    const fs::path disk = w.folder / "disk";
    const SmallDisk small(disk, kilobytes);
    if (!small.there()) {
        WARN("no right to mount a small disk: left out");
        return "skipped";
    }
    const int code = Child(w, run_arguments(w, scene, "disk/out")).wait();
    const std::string message = said(w);
    if (code == 0) return "";
    INFO(kilobytes << " kB: " << message);
    CHECK(code == 1);
    CHECK(message.find("error: ") != message.npos);
    CHECK(message.find("disk/out") != message.npos);
    small.enlarge(64 * 1024);
    if (fs::exists(disk / "out/results.h5") && !checkpoints(disk / "out").empty()) {
        check_readable(disk / "out");
        CHECK(resume(w, "disk/out") == 0);
        const std::vector<std::string> found = differences(w.folder / "whole", disk / "out");
        INFO(listed(found) << said(w));
        CHECK(found.empty());
    }
    return message;
}

}  // namespace

TEST_CASE("SIGTERM and SIGINT stop with a checkpoint, SIGUSR1 makes one and the run goes on")
{
    const Workplace w;
    const Scene scene = spheres();
    REQUIRE(Child(w, run_arguments(w, scene, "whole")).wait() == 0);
    for (const int signal : {SIGTERM, SIGINT}) {
        fs::remove_all(w.folder / "out");
        {
            Child child(w, run_arguments(w, scene, "out"));
            wait_for_rows(child, w.folder / "out/history.csv", 20);
            child.send(signal);
            CHECK(child.wait() == 128 + signal);
        }
        const nlohmann::json s = nlohmann::json::parse(text_of(w.folder / "out/summary.json"));
        CHECK(s["exit"]["code"] == 128 + signal);
        const std::string newest = checkpoints(w.folder / "out").front().stem().string();
        CHECK(newest == "step_" + std::to_string(s["time_step"]["steps"].get<int>()));
        CHECK(resume(w, "out") == 0);
        const std::vector<std::string> found = differences(w.folder / "whole", w.folder / "out");
        INFO(listed(found) << said(w));
        CHECK(found.empty());
    }
    std::vector<std::string> a = run_arguments(w, scene, "out");
    a.insert(a.end(), {"--set", "output.checkpoint_steps=1000000"});
    fs::remove_all(w.folder / "out");
    Child child(w, a);
    wait_for_rows(child, w.folder / "out/history.csv", 10);
    CHECK(checkpoints(w.folder / "out").size() == 1);
    child.send(SIGUSR1);
    while (child.running() && checkpoints(w.folder / "out").size() < 2)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    CHECK(checkpoints(w.folder / "out").size() == 2);
    CHECK(child.wait() == 0);
}

TEST_CASE("a pull-out that is stopped while its matrix tears goes on to the same bits")
{
    const Workplace w;
    const Scene scene = torn_matrix();
    using Clock = std::chrono::steady_clock;
    const auto seconds_to = [&](Child& child, const char* out, std::size_t rows, double most) {
        const auto start = Clock::now();
        const auto lasted = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
        while (child.running() && history_rows(w.folder / out / "history.csv").size() < rows && lasted() < most)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return lasted();
    };
    // the last row is that of the torn matrix: bonds break one after the other, each at rest, from the row before
    REQUIRE(Child(w, run_arguments(w, scene, "whole")).wait() == 0);
    const std::size_t torn = history_rows(w.folder / "whole/history.csv").size();
    REQUIRE(torn > 2);
    double tearing = 0.0;  // how long it takes [s]
    {
        Child child(w, run_arguments(w, scene, "out"));
        wait_for_rows(child, w.folder / "out/history.csv", torn - 1);
        tearing = seconds_to(child, "out", torn, 1e3);
    }
    for (const double share : {0.3, 0.6, 0.9}) {
        fs::remove_all(w.folder / "out");
        int code = 0;
        {
            Child child(w, run_arguments(w, scene, "out"));
            wait_for_rows(child, w.folder / "out/history.csv", torn - 1);
            seconds_to(child, "out", torn, share * tearing);
            child.send(SIGTERM);
            code = child.wait();
        }
        INFO(share << " of " << tearing << " s: exit code " << code);
        CHECK((code == 128 + SIGTERM || code == 0));  // 0: it was faster this time
        CHECK(resume(w, "out") == 0);
        const std::vector<std::string> found = differences(w.folder / "whole", w.folder / "out");
        INFO(listed(found) << said(w));
        CHECK(found.empty());
    }
}

TEST_CASE("a second SIGINT ends a run at once that cannot end by itself, and its checkpoint is there")
{
    const Workplace w;
    const Scene scene = spheres(100);
    REQUIRE(Child(w, run_arguments(w, scene, "whole")).wait() == 0);
    {
        Child child(w, run_arguments(w, scene, "out"));
        wait_for_rows(child, w.folder / "out/history.csv", 40);
        // the end of the run hangs at a pipe that nobody reads
        REQUIRE(::mkfifo((w.folder / "out/summary.json.tmp").c_str(), 0600) == 0);
        child.send(SIGINT);
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        child.send(SIGINT);  // the same wish, passed on twice
        std::this_thread::sleep_for(std::chrono::seconds(2));
        REQUIRE(child.running());
        child.send(SIGINT);
        CHECK(child.wait() == 130);
    }
    CHECK_FALSE(fs::exists(w.folder / "out/summary.json"));
    CHECK(resume(w, "out") == 0);
    const std::vector<std::string> found = differences(w.folder / "whole", w.folder / "out");
    INFO(listed(found) << said(w));
    CHECK(found.empty());
}

TEST_CASE("results.h5 that a power failure left in pieces is made whole from the checkpoint")
{
    const Workplace w;
    const Scene scene = spheres(100);
    REQUIRE(Child(w, run_arguments(w, scene, "whole")).wait() == 0);
    run_and_kill(w, scene, "out", 70);
    {
        std::fstream file(w.folder / "out/results.h5", std::ios::binary | std::ios::in | std::ios::out);
        file << std::string(4096, '\0');  // superblock and first headers
    }
    const fs::path frame = "paraview/spheres_000000.vtp";
    const bool with_frames = fs::remove(w.folder / "out" / frame);  // else built without VTK
    const Outcome o = w.run("resume out --no-report --threads 1");
    CHECK(o.code == 0);
    if (with_frames) {
        CHECK(o.err.find("1 files of the series are missing, the first of them spheres_0") != std::string::npos);
        fs::copy(w.folder / "whole" / frame, w.folder / "out" / frame);
    }
    const std::vector<std::string> found = differences(w.folder / "whole", w.folder / "out");
    INFO(listed(found) << said(w));
    CHECK(found.empty());
}

TEST_CASE("history.csv and results.h5 are read while the run goes on")
{
    const Workplace w;
    const Scene scene = spheres();
    Child child(w, run_arguments(w, scene, "out"));
    const fs::path folder = w.folder / "out";
    int looks = 0, grew = 0;
    std::vector<std::string> before;
    hsize_t rows_before = 0;
    std::vector<double> seen;
    while (child.running()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        const std::vector<std::string> rows = history_rows(folder / "history.csv");
        if (rows.size() < 2) continue;
        // the same process opens it again and again, as a watcher would
        const Hdf5File file = Hdf5File::open(folder / "results.h5", Hdf5File::Access::live);
        const auto extents = file.extents("/history");
        seen = file.read<double>("/history");
        REQUIRE(extents[0] >= rows_before);
        REQUIRE(std::equal(before.begin(), before.end(), rows.begin()));
        // rows of the file are those of the text, one may be on its way
        REQUIRE(extents[0] + 1 >= rows.size());
        for (std::size_t i = 0; i + 1 < std::min<std::size_t>(rows.size(), extents[0]); ++i)
            REQUIRE(std::stod(rows[i]) == seen[i * extents[1]]);
        const std::size_t snapshots = file.read<double>("/snapshots/time").size();
        if (snapshots > 0) REQUIRE(file.extents("/snapshots/position")[0] >= snapshots);
        if (rows.size() > before.size()) ++grew;
        ++looks;
        before = rows;
        rows_before = extents[0];
    }
    CHECK(child.wait() == 0);
    INFO(looks << " looks");
    CHECK(grew >= 3);
    const std::vector<std::string> rows = history_rows(folder / "history.csv");
    CHECK(rows.size() >= before.size());
    CHECK(std::equal(before.begin(), before.end(), rows.begin()));
}

TEST_CASE("a changed input is listed and refused; what can change in a run is allowed when told so")
{
    const Workplace w;
    const Scene scene = spheres();
    run_and_kill(w, scene, "out", 20);
    const auto refused = [&](const std::vector<std::string>& more, const std::string& why) {
        CHECK(resume(w, "out", more) == 2);
        INFO(said(w));
        CHECK(said(w).find(why) != std::string::npos);
    };
    refused({"--set", "stages[0].max_displacement='0.1 mm'"}, "stages[0].max_displacement: 0.0001, was 0.00012\n");
    refused({"--set", "bonds[0].tensile_strength='9 MPa'"},
            "bonds[0].tensile_strength: 9000000.0, was 2000000.0 (cannot");
    refused({"--set", "bonds[0].tensile_strength='9 MPa'", "--allow-changes"},
            "undo these changes; begin anew with grainfrac run " + (w.folder / "scene.toml").string() +
                " --out out --force");
    refused({"--set", "bonds[0].strength='9 MPa'"}, "unknown key");
    const std::string input = text_of(w.folder / "out/input.toml");
    std::string edited = input;
    edited.replace(edited.find("friction = 0.4"), 14, "friction = 0.5");
    std::ofstream(w.folder / "out/input.toml") << edited;
    refused({}, "contacts[0].friction: 0.5, was 0.4");
    std::ofstream(w.folder / "out/input.toml") << input;
    CHECK(resume(w, "out", {"--set", "stages[0].max_displacement='0.1 mm'", "--allow-changes"}) == 0);
    INFO(said(w));
    const nlohmann::json s = nlohmann::json::parse(text_of(w.folder / "out/summary.json"));
    CHECK(s["exit"]["reason"].get<std::string>().find("displacement 0.0001") == 0);
    // ended: said so; with another end there is something to do
    CHECK(resume(w, "out") == 0);
    CHECK(text_of(w.folder / "out.txt").find("the run has ended: displacement 0.0001") != std::string::npos);
    const std::string summary = text_of(w.folder / "out/summary.json");
    const auto left_alone = [&](const std::vector<std::string>& more) {
        refused(more, "the run has ended: displacement 0.0001");
        CHECK(text_of(w.folder / "out/summary.json") == summary);
    };
    left_alone({"--set", "output.checkpoint_steps=77", "--allow-changes"});
    left_alone({"--set", "stages[0].max_displacement='0.09 mm'", "--allow-changes"});
    left_alone({"--set", "control.time_step_safety=0.1", "--allow-changes"});
    refused({"--set", "stages[0].max_displacement='0.11 mm'"}, "go on with the new values with --allow-changes");
    CHECK(text_of(w.folder / "out/summary.json") == summary);
    std::ofstream(w.folder / "out/plots/energies.svg") << "of the earlier end";
    CHECK(resume(w, "out", {"--set", "stages[0].max_displacement='0.11 mm'", "--allow-changes"}) == 0);
    CHECK(said(w).find("is made anew") != std::string::npos);
    CHECK(!fs::exists(w.folder / "out/plots/energies.svg"));
    CHECK(history_rows(w.folder / "out/history.csv").size() > 50);
    CHECK(resume(w, "nowhere") == 2);
    CHECK(said(w).find("\"nowhere\" is no folder") != std::string::npos);
}

TEST_CASE("an interval that the input leaves open stays when something else is changed in the course of a run")
{
    const Workplace w;
    Scene scene = spheres(200);
    const std::size_t line = scene.input.find("history = ");
    scene.input.erase(line, scene.input.find('\n', line) + 1 - line);  // 100 steps
    REQUIRE(Child(w, run_arguments(w, scene, "whole")).wait() == 0);
    const auto rows_of = [&](const char* out) { return history_rows(w.folder / out / "history.csv"); };
    run_and_kill(w, scene, "out", 5);
    CHECK(resume(w, "out", {"--set", "output.checkpoint_steps=300", "--allow-changes"}) == 0);
    CHECK(rows_of("out") == rows_of("whole"));
    fs::remove_all(w.folder / "out");
    run_and_kill(w, scene, "out", 5);
    CHECK(resume(w, "out",
                 {"--set", "control.time_step_safety=0.1", "--set", "output.checkpoint_steps=300",
                  "--allow-changes"}) == 0);
    INFO(said(w));
    // between two rows near the end, to one step
    const auto interval = [&](const char* out) {
        const std::vector<std::string> rows = rows_of(out);
        const auto time = [&](std::size_t back) {
            const std::string& row = rows.at(rows.size() - back);
            return std::stod(row.substr(row.find(',') + 1));
        };
        return time(3) - time(4);
    };
    CHECK(interval("out") == Approx(interval("whole")).epsilon(0.02));
}

TEST_CASE("an allowed change that only a damaged checkpoint knows is not lost unseen")
{
    const Workplace w;
    const Scene scene = spheres(200);
    run_and_kill(w, scene, "out", 30);
    const std::vector<std::string> change{"--set", "stages[0].max_displacement='0.1 mm'", "--allow-changes"};
    {
        std::vector<std::string> a = resume_arguments("out");
        a.insert(a.end(), change.begin(), change.end());
        a.insert(a.end(), {"--set", "output.checkpoint_steps=1000000"});
        const std::size_t rows = history_rows(w.folder / "out/history.csv").size();
        const fs::path newest = checkpoints(w.folder / "out").front();
        const auto written = fs::last_write_time(newest);
        Child child(w, a);
        while (child.running() &&
               (checkpoints(w.folder / "out").front() == newest && fs::last_write_time(newest) == written))
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        wait_for_rows(child, w.folder / "out/history.csv", rows + 1);
        REQUIRE(child.running());
        child.send(SIGKILL);
        child.wait();
    }
    const fs::path newest = checkpoints(w.folder / "out").front();
    fs::resize_file(newest, 5000);
    CHECK(resume(w, "out") == 2);
    INFO(said(w));
    CHECK(said(w).find("stages[0].max_displacement: 0.0001, was 0.00012\n") != std::string::npos);
    CHECK(said(w).find("give them again with --set") != std::string::npos);
    CHECK(fs::exists(newest));
    CHECK(resume(w, "out",
                 {"--set", "stages[0].max_displacement='0.1 mm'", "--set", "output.checkpoint_steps=1000000",
                  "--allow-changes"}) == 0);
    CHECK(text_of(w.folder / "out/summary.json").find("displacement 0.0001") != std::string::npos);
}

TEST_CASE("a folder at work is left alone, and so is a history that is not the run's", "[slow]")
{
    const Workplace w;
    const Scene scene = spheres(100);
    {
        Child child(w, run_arguments(w, scene, "out"));
        wait_for_rows(child, w.folder / "out/history.csv", 30);
        const Outcome o = w.run("resume out");
        CHECK(o.code == 1);
        CHECK(o.err.find("another run is at work in this folder") != std::string::npos);
        child.send(SIGKILL);
        child.wait();
    }
    const fs::path history = w.folder / "out/history.csv";
    const std::string text = text_of(history);
    std::ofstream(history) << text.substr(0, 1500);
    CHECK(resume(w, "out") == 1);
    CHECK(said(w).find("history.csv: is shorter than at the checkpoint") != std::string::npos);
    std::string other = text;
    other[1200] = other[1200] == '1' ? '2' : '1';
    std::ofstream(history) << other;
    CHECK(resume(w, "out") == 1);
    CHECK(said(w).find("history.csv: was altered since the checkpoint") != std::string::npos);
    std::ofstream(history) << text;
    CHECK(resume(w, "out") == 0);
    for (const fs::path& checkpoint : checkpoints(w.folder / "out")) fs::remove(checkpoint);
    fs::remove(w.folder / "out/summary.json");
    CHECK(resume(w, "out") == 1);
    CHECK(said(w).find("holds no checkpoint; begin anew") != std::string::npos);
}

TEST_CASE("a file that the input names is found from anywhere, and missed when it is gone or another one", "[slow]")
{
    const Workplace w;
    fs::create_directory(w.folder / "inputs");
    const fs::path disc = source / "examples/brazilian/brazilian.toml";
    REQUIRE(w.run("generate '" + disc.string() + "' --set parts.disc.side='\"1.2 mm\"' --out inputs/disc.json").code ==
            0);
    std::string text = text_of(disc);
    const auto replace = [&](const char* from, const char* to, const std::string& by) {
        const std::size_t begin = text.find(from);
        REQUIRE(begin != text.npos);
        text.replace(begin, text.find(to, begin) - begin, by);
    };
    replace("generator =", "region ", "generator = \"file\"\nfile = \"disc.json\"\n");
    replace("at_region_boundary", "\n", "");
    std::ofstream(w.folder / "inputs/taken.toml") << text;
    const Scene scene{"a disc from a file",
                      "inputs/taken.toml",  // relative to where it is run
                      {"--set", "test.platen_speed='200 mm/s'", "--set", "bonds[0].cohesion='150 MPa'", "--set",
                       "output.checkpoint_steps=1000", "--set", "output.history='0.2 us'"}};
    REQUIRE(Child(w, run_arguments(w, scene, "whole")).wait() == 0);
    run_and_kill(w, scene, "out", 30);
    const fs::path block = w.folder / "inputs/disc.json";
    fs::rename(block, w.folder / "elsewhere.json");
    CHECK(resume(w, "out") == 1);
    CHECK(said(w).find(block.string() + ": cannot read: No such file or directory, which parts[0].file names") !=
          std::string::npos);
    const std::string grains = text_of(w.folder / "elsewhere.json");
    std::ofstream(block) << grains << "\n";
    CHECK(resume(w, "out", {"--allow-changes"}) == 2);
    CHECK(said(w).find("contents of " + block.string() + " (cannot change during a run)") != std::string::npos);
    std::ofstream(block) << grains;
    REQUIRE(std::system(
                ("cd / && '" + program + "' resume '" + (w.folder / "out").string() + "' -q --no-report --threads 1")
                    .c_str()) == 0);
    const std::vector<std::string> found = differences(w.folder / "whole", w.folder / "out");
    INFO(listed(found));
    CHECK(found.empty());
}

TEST_CASE("a damaged checkpoint is told, the one before is used, and the bits are the same")
{
    const Workplace w;
    const Scene scene = spheres(200);
    REQUIRE(Child(w, run_arguments(w, scene, "whole")).wait() == 0);
    run_and_kill(w, scene, "out", 60);
    const std::vector<fs::path> two = checkpoints(w.folder / "out");
    REQUIRE(two.size() == 2);
    std::string bytes = text_of(two[0]);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
    std::ofstream(two[0], std::ios::binary) << bytes;
    CHECK(resume(w, "out") == 0);
    CHECK(said(w).find(two[0].filename().string() + ": is damaged (checksum); not used") != std::string::npos);
    CHECK(fs::exists(two[0].string() + ".refused"));
    const std::vector<std::string> found = differences(w.folder / "whole", w.folder / "out");
    INFO(listed(found));
    CHECK(found.empty());
    for (const fs::path& checkpoint : checkpoints(w.folder / "out")) fs::resize_file(checkpoint, 5000);
    fs::remove(w.folder / "out/summary.json");
    CHECK(resume(w, "out") == 1);
    CHECK(said(w).find("is cut short") != std::string::npos);
    CHECK(said(w).find("holds no checkpoint that can be gone on from") != std::string::npos);
}

TEST_CASE("a checkpoint that does not fit the files of its folder is told, and the one before is used")
{
    const Workplace w;
    const Scene scene = spheres(100);
    REQUIRE(Child(w, run_arguments(w, scene, "whole")).wait() == 0);
    run_and_kill(w, scene, "out", 70);
    const std::vector<fs::path> there = checkpoints(w.folder / "out");
    const auto step = [](const fs::path& p) { return std::stol(p.stem().string().substr(5)); };
    const fs::path history = w.folder / "out/history.csv";
    std::string text = text_of(history);
    bool altered = false;
    for (const std::string& row : history_rows(history)) {  // one that only the newer of them knows
        const long at = std::stol(row);
        if (altered || at <= step(there.at(1)) || at > step(there.at(0))) continue;
        char& last = text[text.find(row) + row.size() - 1];
        last = last == '1' ? '2' : '1';
        altered = true;
    }
    REQUIRE(altered);
    std::ofstream(history) << text;
    CHECK(resume(w, "out") == 0);
    CHECK(said(w).find(there.at(0).filename().string() + ": does not fit the folder: out/history.csv: was altered") !=
          std::string::npos);
    const std::vector<std::string> found = differences(w.folder / "whole", w.folder / "out");
    INFO(listed(found) << said(w));
    CHECK(found.empty());
    // a run that has ended says so, also without any checkpoint
    for (const fs::path& checkpoint : checkpoints(w.folder / "out")) fs::remove(checkpoint);
    const Outcome ended = w.run("resume out");
    CHECK(ended.code == 0);
    CHECK(ended.out.find("the run has ended") != std::string::npos);
}

TEST_CASE("a full disk: a reason, what was written is readable, and with room the run goes on", "[slow]")
{
    const Workplace w;
    const Scene scene = spheres(100);
    REQUIRE(Child(w, run_arguments(w, scene, "whole")).wait() == 0);
    std::uintmax_t bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(w.folder / "whole"))
        if (entry.is_regular_file()) bytes += entry.file_size();
    for (const double share : {0.01, 0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}) {
        const std::string why =
            run_on_small_disk(w, scene, static_cast<int>(share * static_cast<double>(bytes) / 1024));
        if (why == "skipped") break;
        CHECK(why != "");
    }
    {
        const SmallDisk disk(w.folder / "disk", 16 * 1024);
        if (!disk.there()) return;
        run_and_kill(w, scene, "disk/out", 30);
        disk.forbid_writing();
        CHECK(resume(w, "disk/out") == 1);
        CHECK(said(w).find("disk/out: cannot write: Read-only file system") != std::string::npos);
    }
    // while rows are written: the disk fills up in the middle of the run
    const SmallDisk disk(w.folder / "disk", 16 * 1024);
    if (!disk.there()) return;
    Child child(w, run_arguments(w, scene, "disk/out"));
    wait_for_rows(child, w.folder / "disk/out/history.csv", 50);
    {
        std::ofstream ballast(w.folder / "disk/ballast", std::ios::binary);
        const std::string block(4096, 'x');
        while (ballast << block << std::flush) {
        }
    }
    CHECK(child.wait() == 1);
    CHECK(said(w).find("disk/out") != std::string::npos);
    check_readable(w.folder / "disk/out");
    fs::remove(w.folder / "disk/ballast");
    CHECK(resume(w, "disk/out") == 0);
    const std::vector<std::string> found = differences(w.folder / "whole", w.folder / "disk/out");
    INFO(listed(found) << said(w));
    CHECK(found.empty());
}

TEST_CASE("a limit on the size of files is told as such, not a signal")
{
    const Workplace w;
    rlimit old{};
    getrlimit(RLIMIT_FSIZE, &old);
    const rlimit tight{600 * 1024, old.rlim_max};  // results.h5 and checkpoints grow beyond it
    setrlimit(RLIMIT_FSIZE, &tight);
    const int code = Child(w, run_arguments(w, spheres(), "out")).wait();
    setrlimit(RLIMIT_FSIZE, &old);
    INFO(said(w));
    CHECK(code == 1);
    CHECK(said(w).find("File too large") != std::string::npos);
}

// 200 places of a checkpoint altered or cut: tests/robustness/kill_test asks for this.
TEST_CASE("checkpoints altered and cut at many places", "[.kill]")
{
    const Workplace w;
    const Scene scene = spheres(100);
    REQUIRE(Child(w, run_arguments(w, scene, "whole")).wait() == 0);
    run_and_kill(w, scene, "killed", 70);
    std::mt19937_64 random(5);
    int older = 0, same = 0;
    const std::string bytes = text_of(checkpoints(w.folder / "killed").front());
    for (int k = 0; k < 200; ++k) {
        fs::remove_all(w.folder / "out");
        fs::copy(w.folder / "killed", w.folder / "out", fs::copy_options::recursive);
        const fs::path newest = checkpoints(w.folder / "out").front();
        const std::size_t place = bytes.size() * static_cast<std::size_t>(k) / 200 + random() % (bytes.size() / 200);
        if (k % 4 == 3) {
            fs::resize_file(newest, place);
        } else {
            std::string altered = bytes;
            altered[place] = static_cast<char>(altered[place] ^ (1 + random() % 255));
            std::ofstream(newest, std::ios::binary) << altered;
        }
        const int code = resume(w, "out");
        INFO("sample " << k << " at byte " << place << " of " << bytes.size() << ": " << said(w));
        CHECK(code == 0);
        if (fs::exists(newest.string() + ".refused")) ++older;
        const std::vector<std::string> found = differences(w.folder / "whole", w.folder / "out");
        INFO(listed(found));
        CHECK(found.empty());
        if (found.empty()) ++same;
    }
    std::printf("200 altered or cut checkpoints: refused %d times, the one before used, same bits %d times\n", older,
                same);
    CHECK(older == 200);
}
