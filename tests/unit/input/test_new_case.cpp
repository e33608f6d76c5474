// SPDX-License-Identifier: GPL-3.0-or-later
// The start files of `grainfrac new`.
#include "experiment/experiment.h"
#include "input_files.h"
#include "io/input_schema.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <sstream>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

/// Words of test.kind.
struct Kinds {
    std::vector<std::string> found;
    template <class T>
    void operator()(const char* key, T&, const Facts& facts)
    {
        if (std::string(key) != "kind") return;
        for (const Word& word : words_of(facts)) found.push_back(word.typed);
    }
    template <class S>
    void table(const char*, S&, const Facts&)
    {
    }
};

}  // namespace

TEST_CASE("there is a start file for every kind of test", "[input]")
{
    Kinds kinds;
    TestSpec spec;
    describe(kinds, spec);
    REQUIRE(kinds.found.size() >= 10);
    const std::vector<std::string> starts = new_case_kinds();
    for (const std::string& kind : kinds.found) {
        INFO(kind);
        CHECK(std::find(starts.begin(), starts.end(), kind) != starts.end());
    }
    CHECK_THROWS_AS(new_case("brasilian"), std::invalid_argument);
}

TEST_CASE("every start file reads, is of its kind, and can be built", "[input]")
{
    for (const std::string& kind : new_case_kinds()) {
        const std::string text = new_case(kind);
        INFO(text);
        REQUIRE(problems_of(text) == "");
        const Case c = read_text(text);
        if (kind == "calibrate") {
            CHECK(c.calibration.size() == 1);
            continue;
        }
        CHECK(c.test.kind == kind);
        CHECK_NOTHROW(build(c, Device::cpu));
    }
}

TEST_CASE("start files tell the keys that they leave out, with defaults, and no line is too long", "[input]")
{
    const std::string text = new_case("brazilian");
    for (const char* line : {"#damping = 0.05  # zeta", "density = \"3100 kg/m^3\"  # mass per volume; > 0 kg/m^3\n",
                             "\n#[control]\n#time_step_safety = 0.8", "#seed", "#platen = \"flat\""}) {
        INFO(line);
        CHECK((text.find(line) != text.npos) != (std::string(line) == "#seed"));
    }
    CHECK(text.find("lattice_axis") == text.npos);  // of spheres
    CHECK(text.find("outer_span") == text.npos);    // of bending
    for (const std::string& kind : new_case_kinds()) {
        std::istringstream lines(new_case(kind));
        for (std::string line; std::getline(lines, line);) {
            INFO(line);
            CHECK(line.size() <= 120);
        }
    }
}

TEST_CASE("a key of a start file that is taken out of its comment reads", "[input]")
{
    for (const std::string& kind : new_case_kinds()) {
        const std::string text = new_case(kind);
        const auto end = [&](std::size_t i) { return std::min(text.find('\n', i), text.size()); };
        for (std::size_t i = 0; i < text.size(); i = end(i) + 1) {
            const std::string line = text.substr(i, end(i) - i);
            const bool shown = line.size() > 1 && line[0] == '#' && line[1] != ' ' && line.find(" = ") != line.npos;
            if (!shown || line.find("...") != line.npos) continue;
            std::string changed = text;
            changed.erase(i, 1);
            const auto header = std::max(text.rfind("\n#[", i) + 1, text.rfind("\n[", i) + 1);  // 0: npos + 1
            if (text[header] == '#') changed.erase(header, 1);
            const std::string problems = problems_of(changed);
            INFO(kind << ": " << line << '\n' << problems);
            // of a default only what it means to give it may be wrong: that something else is needed, or left out
            CHECK((problems.empty() || problems.find("unknown key") == problems.npos));
            CHECK(problems.find("not TOML") == problems.npos);
        }
    }
}
