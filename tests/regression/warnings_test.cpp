// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings where their user meets them: check, the start of a run, run.log, summary.json.
#include "support/workplace.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace grainfrac::test;
using Catch::Matchers::Contains;

TEST_CASE("check warns with file, line, key and value, and goes on")
{
    const Workplace w;
    REQUIRE(w.run("new uniaxial_tension -o bar.toml").code == 0);
    const std::string written = text_of(w.folder / "bar.toml"), density = "density = \"3100 kg/m^3\"";
    const auto at = written.find(density);
    REQUIRE(at != std::string::npos);
    std::ofstream(w.folder / "light.toml")
        << written.substr(0, at) << "density = \"3.1 kg/m^3\"" << written.substr(at + density.size());
    const auto line = 1 + std::count(written.begin(), written.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    const Outcome o = w.run("check light.toml --threads 1");
    CHECK(o.code == 0);
    CHECK_THAT(o.err, Contains("warning: light.toml:" + std::to_string(line) +
                               ": materials.sic.density = \"3.1 kg/m^3\": 3.1 kg/m^3 is not"));
    CHECK_THAT(o.err, Contains("was \"3.1 g/cm^3\" meant?"));
    CHECK_THAT(o.out, Contains("they imply E"));
    CHECK_THAT(o.out, Contains("K_Ic sqrt(E G_I)"));
    CHECK_THAT(o.out, Contains("passages of a wave"));
}

TEST_CASE("a run keeps its warnings")
{
    const Workplace w;
    REQUIRE(w.run("new uniaxial_tension -o bar.toml").code == 0);
    const Outcome o = w.run("run bar.toml --threads 1 --no-report --set test.platen_speed='\"0.5 m/s\"' --out fast");
    CHECK(o.code == 0);
    CHECK_THAT(o.err, Contains("warning: --set test.platen_speed = \"0.5 m/s\": each wall moves at 0.25 m/s"));
    CHECK_THAT(text_of(w.folder / "fast" / "run.log"), Contains("each wall moves at 0.25 m/s"));
    const nlohmann::json warnings = w.summary("fast")["warnings"];
    REQUIRE(warnings.size() >= 1);
    CHECK_THAT(warnings[0].get<std::string>(), Contains("test.platen_speed") && Contains("guide"));
    REQUIRE(w.run("run bar.toml --threads 1 --no-report -q --out slow").code == 0);
    CHECK(w.summary("slow")["warnings"].empty());
}

TEST_CASE("warnings of the set-up go where the others go")
{
    const Workplace w;
    REQUIRE(w.run("new pull_out -o pull.toml").code == 0);
    const std::string hooked =
        " pull.toml --threads 1 --set 'parts[1].fibre.shape=\"hooked\"'"
        " --set 'parts[1].fibre.hook_length=\"1 mm\"'";
    const auto says = Contains("its bends bear on nothing");
    const Outcome o = w.run("check" + hooked);
    CHECK(o.code == 0);
    CHECK_THAT(o.err, says);
    REQUIRE(w.run("run -q --no-report --set 'test.stop.time=\"1 us\"' --out pulled" + hooked).code == 0);
    CHECK_THAT(text_of(w.folder / "pulled" / "run.log"), says);
    const nlohmann::json warnings = w.summary("pulled")["warnings"];
    REQUIRE(warnings.size() >= 1);
    CHECK_THAT(warnings[0].get<std::string>(), says);
}
