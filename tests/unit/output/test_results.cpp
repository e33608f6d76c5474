// SPDX-License-Identifier: GPL-3.0-or-later
// The result folder as a whole, history.csv, plots, and what happens when a disk is full.
#include "io/atomic_file.h"
#include "io/bond_faces.h"
#include "io/figure.h"
#include "io/hdf5_results.h"
#include "io/history_csv.h"
#include "io/plots.h"
#include "io/results.h"
#include "io/view_script.h"
#include "sample.h"

#include <catch2/catch.hpp>

#include <csignal>
#include <cstring>
#include <fstream>
#include <sys/resource.h>

using namespace grainfrac;
namespace fs = std::filesystem;

namespace {

/// No file may grow beyond `bytes`: what a full disk looks like to a program.
class SmallDisk {
public:
    explicit SmallDisk(rlim_t bytes)
    {
        old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &old_);
        rlimit limit = old_;
        limit.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~SmallDisk()
    {
        ::setrlimit(RLIMIT_FSIZE, &old_);
        std::signal(SIGXFSZ, old_handler_);
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

private:
    rlimit old_{};
    void (*old_handler_)(int) = nullptr;
};

bool is_png(const std::string& bytes)
{
    return bytes.starts_with("\x89PNG\r\n\x1a\n") && bytes.find("IEND") != std::string::npos;
}

void check_plot(const fs::path& stem)
{
    INFO(stem);
    const std::string svg = read_file(stem.string() + ".svg"), png = read_file(stem.string() + ".png");
    CHECK(svg.find("<svg") != std::string::npos);
    CHECK(svg.find("</svg>") != std::string::npos);
    CHECK(is_png(png));
    CHECK(png.size() > 3000);  // an empty page has about 2 kB
    CHECK_FALSE(fs::exists(stem.string() + ".png.tmp"));
}

}  // namespace

TEST_CASE("a whole run leaves a whole folder", "[output][results]")
{
    sample::World w = sample::make_world();
    const sample::TemporaryFolder folder;
    const fs::path out = folder / "run.out";
    ResultFolder results(out, false);
    CHECK(results.path() == out);
    results.begin(sample::facts(), "seed = 42\n", "[simulation]\nseed = 42\n");
    CHECK(read_file(out / "input.toml") == "seed = 42\n");
    for (int k = 0; k < 50; ++k) {
        results.append_history(sample::history_row(k));
        // On disk at once, for whoever watches.
        CHECK(read_history_csv(out / "history.csv").rows() == static_cast<std::size_t>(k + 1));
        if (k % 20 == 0) results.write_snapshot(w.model, w.state, w.fields, true);
    }
    results.write_checkpoint(300, [](Archive&) {});
    results.finish("{\"exit_reason\": \"done\"}\n", w.model, w.state, w.fields);
    CHECK(read_file(out / "summary.json") == "{\"exit_reason\": \"done\"}\n");
    CHECK(fs::exists(out / "resolved.toml"));
    CHECK(fs::exists(out / "results.h5"));
    CHECK(fs::exists(out / "checkpoint" / "step_300.h5"));
#ifdef GF_HAVE_VTK
    CHECK(fs::exists(out / "paraview" / "grains_000002.vtu"));
    CHECK(fs::exists(out / "paraview" / "view.py"));
#endif
    for (const char* name :
         {"load_displacement", "energies", "crack_map", "crack_orientation", "fragment_sizes", "transgranular_share"})
        check_plot(out / "plots" / name);
    for (const auto& entry : fs::recursive_directory_iterator(out)) CHECK(entry.path().extension() != ".tmp");
}

TEST_CASE("plots that cannot be made cost nothing else", "[output][results]")
{
    const sample::World w = sample::make_world();
    const sample::TemporaryFolder folder;
    ResultFolder results(folder / "out", false);
    results.begin(sample::facts(), "", "");
    results.append_history(sample::history_row(1));
    fs::remove(folder / "out" / "plots");
    CHECK_THROWS_AS(results.finish("{}", w.model, w.state, w.fields), PlotError);
    CHECK(read_file(folder / "out" / "summary.json") == "{}");
}

TEST_CASE("history.csv gives every number back", "[output][history]")
{
    const sample::TemporaryFolder folder;
    HistoryCsv csv(folder / "history.csv", sample::facts());
    for (int k = 0; k < 4; ++k) csv.append(sample::history_row(k));
    csv.close();
    const std::string text = read_file(folder / "history.csv");
    CHECK(text.find("# grainfrac 0.1.0") == 0);
    CHECK(text.find("# seed: 42") != std::string::npos);
    CHECK(text.find("positive") != std::string::npos);
    CHECK(text.find("cpu") == std::string::npos);  // equal runs give equal files
    CHECK(text.find("\nstep,time_s,displacement_m,load_N,") != std::string::npos);
    CHECK(text.find("\n3000000,3e-07,") != std::string::npos);  // integers stay integers

    const HistoryTable table = read_history_csv(folder / "history.csv");
    REQUIRE(table.rows() == 4);
    for (int k = 0; k < 4; ++k) {
        std::size_t c = 0;
        sample::history_row(k).for_each_column([&](const char* name, auto value) {
            INFO(name);
            CHECK(table.names[c] == name);
            const double read = table.columns[c][static_cast<std::size_t>(k)];
            CHECK((read == static_cast<double>(value) || (std::isnan(read) && std::isnan(static_cast<double>(value)))));
            ++c;
        });
    }
    CHECK_THROWS_WITH(table.column("nonsense"), Catch::Contains("nonsense"));
}

TEST_CASE("the half-written last line of a killed run is left out", "[output][history]")
{
    const sample::TemporaryFolder folder;
    {
        HistoryCsv csv(folder / "history.csv", sample::facts());
        csv.append(sample::history_row(1));
    }
    std::ofstream(folder / "history.csv", std::ios::app) << "200,1e-0";
    CHECK(read_history_csv(folder / "history.csv").rows() == 1);
}

TEST_CASE("what may be replaced", "[output][results]")
{
    const sample::TemporaryFolder folder;
    const fs::path out = folder / "out";
    const auto refused = [](const fs::path& path, bool replace, const char* why) {
        try {
            ResultFolder results(path, replace);
            FAIL("not refused");
        } catch (const InputError& error) {
            CHECK(error.problems.at(0).key == "--out");
            CHECK_THAT(error.problems.at(0).message, Catch::Contains(why));
        }
    };
    {
        ResultFolder results(out, false);
        results.begin(sample::facts(), "", "");
    }
    refused(out, false, "exists");
    std::ofstream(out / "old.txt") << "x";
    ResultFolder again(out, true);
    CHECK_FALSE(fs::exists(out / "old.txt"));

    // Somebody's folder and somebody's file stay.
    fs::create_directory(folder / "thesis");
    std::ofstream(folder / "thesis" / "chapter.tex") << "x";
    refused(folder / "thesis", true, "not a result folder");
    CHECK(fs::exists(folder / "thesis" / "chapter.tex"));
    std::ofstream(folder / "file") << "x";
    refused(folder / "file", true, "not a folder");
    CHECK(fs::exists(folder / "file"));
    // A link to a result folder is not followed.
    again.begin(sample::facts(), "", "");
    fs::create_directory_symlink(out, folder / "link");
    refused(folder / "link", true, "not a folder");
    CHECK(fs::exists(out / "resolved.toml"));
    // Nor is the ground cut from under one's feet.
    const fs::path before = fs::current_path();
    fs::current_path(out / "plots");
    refused(out, true, "working directory");
    fs::current_path(before);
    CHECK(fs::exists(out / "resolved.toml"));
    // A folder with nothing in it holds nothing to lose.
    fs::create_directory(folder / "empty");
    refused(folder / "empty", false, "exists");
    CHECK_NOTHROW(ResultFolder(folder / "empty", true));
    refused("/proc/nowhere/out", false, "cannot create");
}

TEST_CASE("a full disk is an error that names the file", "[output][results]")
{
    const sample::World w = sample::make_world();
    const sample::TemporaryFolder folder;
    write_file(folder / "a.txt", "old");
    HistoryCsv csv(folder / "history.csv", sample::facts());
    ResultFolder results(folder / "out", false);
    results.begin(sample::facts(), "", "");
    Hdf5Results table(folder / "table.h5", sample::facts());
    {
        const SmallDisk disk(100);
        CHECK_THROWS_WITH(table.append_history(sample::history_row(1)), Catch::Contains("table.h5"));
        CHECK_THROWS_WITH(write_file(folder / "a.txt", std::string(1000, 'x')), Catch::Contains("a.txt"));
        CHECK_THROWS_WITH(csv.append(sample::history_row(1)), Catch::Contains("history.csv"));
        CHECK_THROWS_WITH(results.write_checkpoint(300, [](Archive&) {}), Catch::Contains("step_300.h5"));
        CHECK_THROWS_WITH(plot_curves(folder / "plot", "t", "x", "y", {{"a", {0, 1}, {0, 1}}}),
                          Catch::Contains("plot.svg"));
#ifdef GF_HAVE_VTK
        CHECK_THROWS_WITH(results.write_snapshot(w.model, w.state, w.fields, true),
                          Catch::Contains("grains_000000.vtu"));
#endif
    }
    CHECK(read_file(folder / "a.txt") == "old");
    CHECK_FALSE(fs::exists(folder / "a.txt.tmp"));
    CHECK(fs::is_empty(folder / "out" / "checkpoint"));
    CHECK_FALSE(fs::exists(folder / "plot.svg"));
    // Room again: the same folder goes on.
    results.write_checkpoint(300, [](Archive&) {});
    results.write_snapshot(w.model, w.state, w.fields, true);
    results.append_history(sample::history_row(1));
    CHECK_THROWS_WITH(write_file("/proc/nowhere", "x"), Catch::Contains("/proc/nowhere"));
}

TEST_CASE("why bonds broke", "[output][cracks]")
{
    sample::World w = sample::make_world();
    InterfaceBonds& bonds = w.state.interfaces;
    const std::pair<double, CrackCause> cases[] = {{0.0, CrackCause::tension}, {0.33, CrackCause::tension},
                                                   {0.34, CrackCause::mixed},  {0.66, CrackCause::mixed},
                                                   {0.67, CrackCause::shear},  {1.0, CrackCause::shear}};
    for (const auto& [share, cause] : cases) {
        bonds.shear_share.host()[0] = share * bonds.area[0];
        CHECK(bond_facts(w.state, 0).cause == cause);
        CHECK(collect_cracks(w.model, w.state).at(0).cause == static_cast<int>(cause));
    }
    CHECK(bond_facts(w.state, 1).cause == CrackCause::none);
    bonds.retired.host()[0] = 1;
    CHECK(bond_facts(w.state, 0).stage == BondStage::retired);
    CHECK(collect_cracks(w.model, w.state).size() == 1);
    const CrackFace crack = collect_cracks(w.model, w.state)[0];
    CHECK(crack.first_damage_time == 1e-6);
    CHECK(crack.opening == Approx(sample::crack_opening).epsilon(1e-9));
    CHECK(dot(area_vector(crack.polygon), crack.normal) == Approx(crack.area).epsilon(1e-12));

    sample::add_parallel_bond(w.state);
    const CrackFace disc = collect_cracks(w.model, w.state).at(1);
    CHECK(disc.polygon.size() == 16);
    CHECK(disc.cause == 1);
    CHECK(disc.time == 2.5e-6);
    // A 16-gon in the circle has 97.4 % of its area.
    CHECK(dot(area_vector(disc.polygon), disc.normal) == Approx(0.974 * disc.area).epsilon(1e-3));
}

TEST_CASE("prefixes make readable axes", "[output][plots]")
{
    const std::pair<double, const char*> cases[] = {{0.0, ""},     {1.0, ""},          {999.0, ""},
                                                    {1000.0, "k"}, {2.5e-4, "\u00b5"}, {0.015, "m"},
                                                    {3.1e11, "G"}, {1e-20, "p"},       {0.9999999999999999e3, "k"}};
    for (const auto& [value, name] : cases) {
        INFO(value);
        CHECK(prefix_for(value).name == name);
    }
    CHECK(scaled_label("Load [N]", 2e4).label == "Load [kN]");
    CHECK(scaled_label("Load [N]", 2e4).factor == 1e-3);
    CHECK(scaled_label("Strain [-]", 2e4).label == "Strain [-]");
    CHECK(scaled_label("Area [m^2]", 2e4).factor == 1.0);
}

TEST_CASE("plots of nothing, of one point and of gaps", "[output][plots]")
{
    const sample::TemporaryFolder folder;
    const double nan = std::nan("");
    plot_curves(folder / "none", "None", "x [m]", "y [N]", {});
    plot_curves(folder / "point", "Point #1", "x [m]", "y [N]", {{"a", {1.0}, {2.0}}});
    plot_curves(folder / "gaps", "Gaps", "x [m]", "y [N]",
                {{"a", {0, 1, 2, 3}, {0, nan, 2, 3}}, {"b", {0, 3}, {1, INFINITY}}});
    plot_wall_forces(folder / "no_walls", {{"time_s"}, {{0.0, 1.0}}});
    CHECK_FALSE(fs::exists(folder / "no_walls.svg"));
    const HistoryTable walls{{"time_s", "lid_force_x_N", "lid_force_y_N", "lid_contacts"},
                             {{0.0, 1.0}, {0.0, 5.0}, {0.0, 0.01}, {1.0, 2.0}}};
    plot_wall_forces(folder / "walls", walls);
    CHECK(fs::exists(folder / "walls.svg"));
    plot_crack_map(folder / "map", {}, {}, {});
    plot_crack_orientation(folder / "rose", {});
    plot_fragment_sizes(folder / "sizes", {}, {});
    for (const char* name : {"none", "point", "gaps", "map", "rose", "sizes"}) check_plot(folder / name);
    CHECK_THROWS_WITH(plot_curves("/proc/nowhere/plot", "t", "x", "y", {}), Catch::Contains("/proc/nowhere/plot"));
}

TEST_CASE("view.py is Python", "[output][paraview]")
{
    if (std::system("python3 -c pass > /dev/null 2>&1") != 0) return;
    const sample::TemporaryFolder folder;
    for (const bool fibre : {false, true}) {
        write_file(folder / "view.py", view_script(fibre));
        CHECK(std::system(("python3 -m py_compile '" + (folder / "view.py").string() + "'").c_str()) == 0);
    }
}

TEST_CASE("view.py cuts open what is around a fibre, nothing else", "[output][paraview]")
{
    CHECK(view_script(true).find("\nHAS_FIBRE = True\n") != std::string::npos);
    CHECK(view_script(false).find("\nHAS_FIBRE = False\n") != std::string::npos);
}
