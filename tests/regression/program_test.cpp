// SPDX-License-Identifier: GPL-3.0-or-later
// The program as its user meets it: commands, exit codes, files, the example in short.
#include "support/program.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

using namespace program_test;

namespace {

const std::string example = (source / "examples/brazilian/brazilian.toml").string();
/// Coarse grains, fast platens: two seconds instead of twenty.
const std::string shorter =
    " --set parts.disc.side='\"1.2 mm\"' --set test.platen_speed='\"200 mm/s\"' --set test.contact_half_width='\"1.3 "
    "mm\"' --set bonds[0].tensile_strength='\"60 MPa\"'"
    " --set bonds[0].cohesion='\"150 MPa\"'";

/// Of the last whole line of history.csv; 0 if it has none yet.
double last_value(const std::string& history, const std::string& column)
{
    std::istringstream lines(history.substr(0, history.rfind('\n') == history.npos ? 0 : history.rfind('\n')));
    std::string line, names, last;
    while (std::getline(lines, line)) {
        if (line.empty() || line[0] == '#') continue;
        (names.empty() ? names : last) = line;
    }
    std::istringstream n(names), v(last);
    std::string name, value;
    while (std::getline(n, name, ',') && std::getline(v, value, ',')) {
        if (name == column) return std::stod(value);
    }
    return 0.0;
}

}  // namespace

TEST_CASE(
    "the example in short: every file is there, the account closes, resolved input and threads give the same bits")
{
    const Workplace w;
    const Outcome first = w.run("run " + example + shorter + " --threads 2 --out a");
    INFO(first.err);
    REQUIRE(first.code == 0);
    std::vector<std::string> files = {"input.toml",
                                      "resolved.toml",
                                      "run.log",
                                      "summary.json",
                                      "history.csv",
                                      "results.h5",
                                      "paraview/grains.pvd",
                                      "paraview/bonds.pvd",
                                      "paraview/contacts.pvd",
                                      "paraview/cracks.pvd",
                                      "paraview/walls.pvd",
                                      "paraview/view.py",
                                      "plots/load_displacement.svg",
                                      "plots/load_displacement.png",
                                      "plots/energies.svg",
                                      "plots/crack_map.svg"};
#ifndef GF_HAVE_VTK
    std::erase_if(files, [](const std::string& f) { return f.rfind("paraview/", 0) == 0; });
#endif
    for (const std::string& file : files) {
        CHECK(fs::exists(w.folder / "a" / file));
    }
    const nlohmann::json s = w.summary("a");
    CHECK(s["exit"]["code"] == 0);
    CHECK(s["energy"]["relative_error"].get<double>() < 1e-3);
    CHECK(s["test"]["peak_load_N"].get<double>() > 1000);
    CHECK(s["fragments"]["number"].get<int>() >= 1);
    CHECK(text_of(w.folder / "a/input.toml") == text_of(example));

    REQUIRE(w.run("a/resolved.toml --threads 1 --out b -q").code == 0);
    CHECK(w.summary("b")["state_hash"] == s["state_hash"]);
    CHECK(w.summary("b")["input_hash"] == s["input_hash"]);

    const Outcome info = w.run("info a");
    CHECK(info.code == 0);
    CHECK(info.out.find("peak_load_N") != std::string::npos);
}

TEST_CASE("wrong use: exit 2, a message, nothing written")
{
    const Workplace w;
    const auto refused = [&](const std::string& arguments, const std::string& said) {
        const Outcome o = w.run(arguments);
        INFO(arguments << "\n" << o.err);
        CHECK(o.code == 2);
        CHECK(o.err.find(said) != std::string::npos);
        CHECK_FALSE(fs::exists(w.folder / "brazilian.out"));
    };
    refused("no_such.toml", "no_such.toml");
    refused("run", "FILE");
    refused(example + " --device gpu", "--device");
    refused(example + " --set parts.disc.side='\"-1 mm\"'", "parts[0].side");
    refused(example + " --set parts.disc.sides=1", "did you mean \"side\"");
    refused(example + " --set parts.disc.side='\"20 mm\"'", "parts[0]");  // no cell fits
    refused(example + " --set bonds[0].fracture_energy_I='\"1 J/m^2\"'",
            "tensile_strength^2/(2 k_n)");  // only building can tell
    refused(example + " --set control.time_step='\"1 ms\"'", "stability limit");
    refused("info no_such_folder", "no_such_folder");
    {  // a wall within the part
        std::ofstream(w.folder / "overlap.toml")
            << "[materials.sic]\ndensity = 3100\nyoung_modulus = 4e11\n"
               "poisson_ratio = 0.2\n[[parts]]\nname = \"bar\"\nmaterial = \"sic\"\n"
               "side = \"0.6 mm\"\nthickness = \"1 mm\"\nregion = { shape = \"box\", "
               "size = [\"4 mm\", \"4 mm\", \"1 mm\"] }\n[[walls]]\nname = \"top\"\n"
               "center = [0, \"0.5 mm\", 0]\nnormal = [0, -1, 0]\nsize = [\"9 mm\", "
               "\"9 mm\"]\n[[stages]]\nname = \"press\"\nduration = 1\n";
        refused("overlap.toml", "overlap.toml:11: walls[0]: grain");
        refused("check overlap.toml", "wall \"top\" overlap at the start");
    }
}

TEST_CASE("an existing result folder is refused and left alone, --force replaces it")
{
    const Workplace w;
    fs::create_directory(w.folder / "brazilian.out");
    std::ofstream(w.folder / "brazilian.out/thesis.txt") << "three years of work";
    const Outcome o = w.run(example + shorter);
    CHECK(o.code == 2);
    CHECK(o.err.find("brazilian.out") != std::string::npos);
    CHECK(w.run(example + shorter + " --force").code == 2);  // no result folder of ours
    CHECK(text_of(w.folder / "brazilian.out/thesis.txt") == "three years of work");
    fs::remove_all(w.folder / "brazilian.out");
    const std::string quick = " --set test.stop.time='\"2 us\"' -q";
    CHECK(w.run(example + shorter + quick).code == 0);
    CHECK(w.run(example + shorter + quick).code == 2);
    CHECK(w.run(example + shorter + quick + " --force").code == 0);
}

TEST_CASE("an unwritable place is refused")
{
    const Workplace w;
    std::ofstream(w.folder / "file") << "";
    CHECK(w.run(example + shorter + " --out file/results").code == 2);
    CHECK(w.run(example + shorter + " --out /proc/results").code == 2);
}

TEST_CASE("a device that is not there is an error, never a fall-back")
{
    const Workplace w;
    const Outcome info = w.run("info");
    CHECK(info.code == 0);
    if (info.out.find("device(s)") != std::string::npos) return;  // this machine has one
    const Outcome o = w.run(example + shorter + " --device cuda");
    CHECK(o.code == 1);
    CHECK(o.err.find("device cuda") != std::string::npos);
    CHECK_FALSE(fs::exists(w.folder / "brazilian.out"));
}

TEST_CASE("generate writes a microstructure that generator = \"file\" reads back to the same result")
{
    const Workplace w;
    REQUIRE(w.run("generate " + example + shorter + " --out disc.json").code == 0);
    CHECK(w.run("generate " + example + shorter + " --out disc.json").code == 2);
    std::ifstream in(example);
    std::ofstream out(w.folder / "from_file.toml");
    for (std::string line; std::getline(in, line);) {
        if (line.rfind("generator", 0) == 0)
            out << "generator = \"file\"\nfile = \"disc.json\"\n";
        else if (line.rfind("side", 0) != 0 && line.rfind("thickness", 0) != 0 && line.rfind("at_region", 0) != 0)
            out << line << "\n";
    }
    out.close();
    std::string no_side = shorter;
    no_side.erase(0, no_side.find("--set test"));
    const Outcome o = w.run("from_file.toml " + no_side + " --set test.stop.time='\"20 us\"' -q --no-report");
    INFO(o.err);
    REQUIRE(o.code == 0);
    REQUIRE(w.run(example + shorter + " --set test.stop.time='\"20 us\"' -q --no-report").code == 0);
    CHECK(w.summary("from_file.out")["counts"] == w.summary("brazilian.out")["counts"]);
    // positions pass through decimal text and frames: equal to round-off
    CHECK(w.summary("from_file.out")["test"]["peak_load_N"].get<double>() ==
          Approx(w.summary("brazilian.out")["test"]["peak_load_N"].get<double>()).epsilon(1e-9));
}

TEST_CASE("generate writes grains and spheres into two files, and spheres that come back the same")
{
    const Workplace w;
    const std::string rock = "[materials.rock]\ndensity = 2000\nyoung_modulus = 1e9\npoisson_ratio = 0.1\n";
    const std::string block =
        "[[parts]]\nname = \"block\"\nmaterial = \"rock\"\nside = 0.3\nthickness = 1\nregion = { "
        "shape = \"box\", size = [1, 1, 1], center = [0, 0, 5] }\n";
    const std::string balls = "[[parts]]\nname = \"balls\"\nkind = \"spheres\"\nmaterial = \"rock\"\n";
    const std::string packed =
        "generator = \"random_dense\"\ndiameter = 0.2\nsolid_fraction = 0.5\nregion = { shape = "
        "\"sphere\", diameter = 2 }\n";
    const std::string test = "[test]\nkind = \"drop\"\ndrop_height = 1\nstop = { time = 1 }\n";
    std::ofstream(w.folder / "both.toml") << rock + block + balls + packed + test;
    const Outcome both = w.run("generate both.toml --out all");
    REQUIRE(both.code == 0);
    CHECK(both.out.find("grains -> all.json\n500 spheres -> all.csv\nballs: 500 spheres, solid fraction 0.5000\n") !=
          std::string::npos);
    CHECK(w.run("generate both.toml --out all").code == 2);
    std::ofstream(w.folder / "again.toml") << rock + balls + "generator = \"file\"\nfile = \"all.csv\"\n" + test;
    REQUIRE(w.run("generate again.toml").code == 0);
    CHECK(text_of(w.folder / "again.spheres.csv") == text_of(w.folder / "all.csv"));
    const Outcome other = w.run("generate again.toml --out again.h5");
    CHECK(other.code == 2);
    CHECK(other.err.find("--out: \"again.h5\": give a name with the ending .csv") != std::string::npos);
    CHECK(w.run("generate both.toml --out more.vtk").code == 2);
    CHECK_FALSE(fs::exists(w.folder / "again.h5"));
    std::ofstream(w.folder / "ratio.toml")
        << rock + balls +
               "generator = \"file\"\nfile = \"all.csv\"\n[[bonds]]\nbetween = "
               "[\"balls\", \"balls\"]\nfailure = \"unbreakable\"\nlaw = \"spring\"\nnormal_stiffness = 1e9\n" +
               test;
    CHECK(w.run("check ratio.toml").err.find("bonds[0].shear_ratio: \"auto\" needs the region") != std::string::npos);
}

TEST_CASE("check reports without running")
{
    const Workplace w;
    const Outcome o = w.run("check " + example);
    CHECK(o.code == 0);
    for (const char* said : {"grains 187", "time step", "memory", "run time", "[materials.sic]"})
        CHECK(o.out.find(said) != std::string::npos);
    CHECK_FALSE(fs::exists(w.folder / "brazilian.out"));
}

TEST_CASE("SIGTERM and SIGINT stop the run after a checkpoint")
{
    for (const int signal : {SIGTERM, SIGINT}) {
        // one of them after grains were split: the last snapshot then knows less bodies than there are
        const bool splits = signal == SIGINT;
        const std::string file =
            splits ? (source / "examples/brazilian_cleavage/brazilian_cleavage.toml").string() : example;
        const Workplace w;
        std::fflush(stdout);  // or the child prints it again
        const pid_t child = fork();
        if (child == 0) {
            if (chdir(w.folder.c_str()) != 0) _exit(99);
            std::freopen("out.txt", "w", stdout);
            std::freopen("err.txt", "w", stderr);
            const char* set = splits ? "materials.sic.cleavage.toughness='0.2 MPa m^0.5'" : "simulation.seed=1";
            execl(program.c_str(), program.c_str(), file.c_str(), "--out", "result", "--threads", "1", "--set", set,
                  static_cast<char*>(nullptr));
            _exit(98);
        }
        const auto ready = [&] {
            const std::string history = text_of(w.folder / "result/history.csv");
            return splits ? last_value(history, "split_grains") > 1.0 : !history.empty();
        };
        for (int i = 0; i < 600 && !ready(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        REQUIRE(kill(child, signal) == 0);
        int status = 0;
        REQUIRE(waitpid(child, &status, 0) == child);
        REQUIRE(WIFEXITED(status));
        CHECK(WEXITSTATUS(status) == 128 + signal);
        CHECK_FALSE(fs::is_empty(w.folder / "result/checkpoint"));
        CHECK(w.summary("result")["exit"]["code"] == 128 + signal);
        if (splits) CHECK(w.summary("result")["splits"]["number"] > 0);
    }
}

TEST_CASE("halving the platen speed changes the peak load of the example by less than 2 %", "[slow]")
{
    const Workplace w;
    REQUIRE(w.run(example + " --out fast -q --no-report --threads 2").code == 0);
    REQUIRE(w.run(example + " --out slow -q --no-report --threads 2 --set test.platen_speed='\"16 mm/s\"'").code == 0);
    const double fast = w.summary("fast")["test"]["peak_load_N"], slow = w.summary("slow")["test"]["peak_load_N"];
    WARN("peak load " << fast << " N at 32 mm/s, " << slow << " N at 16 mm/s: " << 100 * (fast / slow - 1) << " %");
    CHECK(fast == Approx(slow).epsilon(0.02));
    CHECK(w.summary("fast")["quasi_static"]["kinetic_over_elastic_to_peak"].get<double>() < 1e-2);
    CHECK(w.summary("fast")["energy"]["largest_relative_error"].get<double>() < 1e-3);
}

TEST_CASE("a programme of stages: compacted, bonded, pressed to a stress, unloaded to nothing")
{
    const Workplace w;
    std::ofstream(w.folder / "column.toml") << staged_column;
    const Outcome o = w.run("column.toml --no-report --out a");
    INFO(o.err << text_of(w.folder / "a/run.log"));
    REQUIRE(o.code == 0);
    const std::string log = text_of(w.folder / "a/run.log");
    for (const char* said : {"stage \"settle\" ended: at rest", "stage \"again\" ended: load 20",
                             "stage \"compact\" ended: unbalanced force ratio below 0.01", "3 bonds of ", "momentum (",
                             "stage \"press\" ended: stress ", "stage \"back\" ended: load went back from "}) {
        INFO(said);
        CHECK(log.find(said) != std::string::npos);
    }
    const nlohmann::json s = w.summary("a");
    CHECK(s["counts"]["interfaces"] == 3);
    CHECK(s["fragments"]["number"] == 1);
    CHECK(s["energy"]["relative_error"].get<double>() < 1e-3);
    // counted from where the bonded column begins to be pressed: 3 faces of E/h, two contacts of 4e14 Pa/m on the cores
    const double closing = s["test"]["displacement_at_peak_m"].get<double>(),
                 force = s["test"]["peak_load_N"].get<double>(), side = 0.6e-3 - 1e-6 / std::sqrt(3.0),
                 core = side - 2 / std::sqrt(3.0) * 0.04 * 0.4995e-3,
                 hexagon = 1.5 * std::sqrt(3.0);  // over the squared side
    const double compliance = 3 * 0.999e-3 / (410e9 * hexagon * side * side) + 2 / (4e14 * hexagon * core * core);
    CHECK(force * compliance / closing == Approx(1.0).epsilon(0.005));
    REQUIRE(w.run("a/resolved.toml --no-report --out b -q").code == 0);
    CHECK(w.summary("b")["state_hash"] == s["state_hash"]);
}

TEST_CASE("stages that cannot do their work: exit 2 with the reason, and an old result is left alone")
{
    const Workplace w;
    const std::string text = staged_column;
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string t = text;
        t.replace(t.find(from), from.size(), to);
        std::ofstream(w.folder / "column.toml") << t;
    };
    fs::create_directory(w.folder / "column.out");
    std::ofstream(w.folder / "column.out/thesis.txt") << "three years of work";
    const auto refused = [&](const std::string& said) {
        const Outcome o = w.run("column.toml --force");
        INFO(o.err);
        CHECK(o.code == 2);
        CHECK(o.err.find(said) != std::string::npos);
        CHECK(text_of(w.folder / "column.out/thesis.txt") == "three years of work");
        CHECK_FALSE(fs::exists(w.folder / "column.out/summary.json"));
    };
    changed("made_in = \"bonds_on\"\n", "");
    refused("stages[2]: makes no bonds; required: [[bonds]] with made_in = \"bonds_on\"");
    changed("servo = { stress = \"1 MPa\", max_speed", "servo = { max_speed");
    refused("stages[1].move[0].servo = { max_speed = \"0.2 m/s\" }: has none of force, stress");
    changed("wall = \"top\", velocity", "wall = \"tpo\", velocity");
    refused("no such wall; there are \"top\", \"bottom\"; did you mean \"top\"?");
    changed("name = \"bottom\"\ncenter", "name = \"bottom\"\nshape = \"stl\"\nfile = \"b.stl\"\nfile_unit = 1\ncenter");
    refused("walls[1].normal");
    // only the run can find out that nothing lies near enough
    changed("bond_distance = \"0.1 um\"", "bond_distance = \"1e-15 m\"");
    const Outcome o = w.run("column.toml --no-report --out far");
    CHECK(o.code == 2);
    CHECK(o.err.find("stages[2]: no faces of grains lie against each other within bond_distance") != std::string::npos);
}

TEST_CASE("the example of staged compression up to its first load", "[slow]")
{
    const Workplace w;
    const Outcome o = w.run("run " + (source / "examples/staged_compression/staged_compression.toml").string() +
                            " --set stages[3].max_displacement='\"10 um\"' --no-report --out a");
    INFO(o.err);
    REQUIRE(o.code == 0);
    const nlohmann::json s = w.summary("a");
    CHECK(s["counts"]["interfaces"].get<int>() > 95);
    CHECK(s["fragments"]["number"] == 1);
    CHECK(s["energy"]["relative_error"].get<double>() < 1e-3);
    CHECK(s["test"]["peak_load_N"].get<double>() > 50);
}
