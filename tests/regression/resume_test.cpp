// SPDX-License-Identifier: GPL-3.0-or-later
// A run that is killed and resumed ends with the bits of one that was left alone.
#include "support/scenes.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <random>
#include <thread>

using namespace program_test;

namespace {

/// What a campaign of kills met.
struct Tally {
    int kills = 0, while_writing = 0, anew = 0, same = 0, runs = 0;
};

bool is_writing(const fs::path& folder)
{
    for (const char* part : {"checkpoint", "."}) {
        std::error_code absent;
        for (const auto& entry : fs::directory_iterator(folder / part, absent)) {
            if (entry.path().extension() == ".tmp") return true;
        }
    }
    return false;
}

/// `runs` runs, each killed `kills` times at moments that the seed chooses, resumed each time, compared at the end.
Tally kill_and_resume(const Scene& scene, int runs, int kills, unsigned seed)
{
    using namespace std::chrono;
    const Workplace w;
    Tally tally;
    const auto before = steady_clock::now();
    REQUIRE(Child(w, run_arguments(w, scene, "whole")).wait() == 0);
    const double lasted = duration<double>(steady_clock::now() - before).count();
    std::mt19937 random(seed);
    for (; tally.runs < runs; ++tally.runs) {
        bool there = false;  // a run that resume can take up
        for (int k = 0; k <= kills;) {
            Child child(w, there ? resume_arguments("killed") : run_arguments(w, scene, "killed"));
            if (k < kills) {
                const double moment = std::uniform_real_distribution<>(0.0, lasted / (there ? kills : 1))(random);
                const auto end = steady_clock::now() + duration<double>(moment);
                while (steady_clock::now() < end && child.running()) std::this_thread::sleep_for(milliseconds(1));
                if (child.running()) {
                    child.send(SIGKILL);
                    child.wait();
                    ++tally.kills;
                    ++k;
                    there = fs::exists(w.folder / "killed/resolved.toml");
                    if (is_writing(w.folder / "killed")) ++tally.while_writing;
                    continue;
                }
            }
            const int code = child.wait();
            const std::string said = text_of(w.folder / "err.txt");
            INFO(scene.name << ", run " << tally.runs << ", kill " << k << ": " << said);
            if (code != 0) {  // killed before its first checkpoint
                REQUIRE(code == 1);
                REQUIRE(said.find("holds no checkpoint") != said.npos);
                there = false;
                ++tally.anew;
                continue;
            }
            if (k == 0) {  // over before its moment came
                there = false;
                continue;
            }
            break;
        }
        const std::vector<std::string> found = differences(w.folder / "whole", w.folder / "killed");
        INFO(scene.name << ", run " << tally.runs << ": " << listed(found));
        CHECK(found.empty());
        if (found.empty()) ++tally.same;
        fs::remove_all(w.folder / "killed");
    }
    return tally;
}

}  // namespace

TEST_CASE("killed and resumed: a disc that cracks and splits ends with the same bits")
{
    const Tally t = kill_and_resume(cleaving_disc(), 1, 3, 7);
    CHECK(t.same == t.runs);
}

TEST_CASE("killed and resumed: stages, equilibria and spheres end with the same bits", "[slow]")
{
    for (const Scene& scene : {column_of_stages(), fibre(), spheres()}) {
        const Tally t = kill_and_resume(scene, 1, 3, 11);
        CHECK(t.same == t.runs);
    }
}

TEST_CASE("a row of equilibria that was told to stop in a relaxation ends with the same bits", "[slow]")
{
    const Workplace w;
    const Scene scene = fibre();
    REQUIRE(Child(w, run_arguments(w, scene, "whole")).wait() == 0);
    int code = 0, stops = 0;
    for (bool first = true; first || code == 143; first = false) {
        Child child(w, first ? run_arguments(w, scene, "out") : resume_arguments("out"));
        const std::size_t rows = history_rows(w.folder / "out/history.csv").size() + 5;
        while (stops < 4 && child.running() && history_rows(w.folder / "out/history.csv").size() < rows)
            std::this_thread::sleep_for(std::chrono::milliseconds(3));
        if (stops++ < 4) child.send(SIGTERM);
        code = child.wait();
        INFO(text_of(w.folder / "err.txt"));
        REQUIRE((code == 143 || code == 0));
    }
    CHECK(stops == 5);
    const std::vector<std::string> found = differences(w.folder / "whole", w.folder / "out");
    INFO(listed(found));
    CHECK(found.empty());
}

// tests/robustness/kill_test asks for this; GF_KILLS: number of kills of each scene; GF_SCENE: one of them, from 0.
TEST_CASE("killed and resumed many times", "[.kill]")
{
    const char* wanted = std::getenv("GF_KILLS");
    const int kills = wanted != nullptr ? std::atoi(wanted) : 50;
    const char* only = std::getenv("GF_SCENE");
    unsigned seed = 0;
    for (const Scene& scene : {cleaving_disc(200), column_of_stages(2000), fibre(1), spheres(100)}) {
        ++seed;
        if (only != nullptr && static_cast<unsigned>(std::atoi(only)) + 1 != seed) continue;
        const Tally t = kill_and_resume(scene, kills, 1, seed);
        std::printf(
            "%s: %d kills, %d of them with a file half written, %d before the first checkpoint; %d of %d runs "
            "with the same bits\n",
            scene.name, t.kills, t.while_writing, t.anew, t.same, t.runs);
        std::fflush(stdout);
        CHECK(t.same == t.runs);
        CHECK(t.kills == kills);
    }
}
