// SPDX-License-Identifier: GPL-3.0-or-later
// `grainfrac new` and `schema` as their user meets them.
#include "experiment/resources.h"
#include "io/input.h"
#include "support/workplace.h"

#include <catch2/catch.hpp>

using namespace grainfrac::test;
namespace fs = std::filesystem;

TEST_CASE("new writes a file that check takes, and never over another")
{
    const Workplace w;
    for (const std::string& kind : grainfrac::new_case_kinds()) {
        INFO(kind);
        REQUIRE(w.run("new " + kind).code == 0);
        const Outcome check = w.run("check " + kind + ".toml --threads 1");
        INFO(check.err);
        CHECK(check.code == 0);
        CHECK(check.err.empty());
    }
    const std::string written = text_of(w.folder / "dcb.toml");
    const Outcome again = w.run("new dcb");
    CHECK(again.code == 2);
    CHECK(again.err.find("exists") != std::string::npos);
    REQUIRE(w.run("new drop -o dcb.toml --force").code == 0);
    CHECK(text_of(w.folder / "dcb.toml") != written);
    CHECK(w.run("new brasilian").code == 2);
    CHECK(w.run("new drop -o no_folder/a.toml").code == 1);
}

TEST_CASE("every start file runs as it is written", "[slow]")
{
    const Workplace w;
    for (const std::string& kind : grainfrac::new_case_kinds()) {
        INFO(kind);
        REQUIRE(w.run("new " + kind).code == 0);
        const std::string command = kind == "calibrate" ? kind : "run";
        const Outcome run = w.run(command + " " + kind + ".toml --threads 1 --no-report --out " + kind);
        INFO(run.err);
        REQUIRE(run.code == 0);
        CHECK(run.err.find("warning") == std::string::npos);
        if (kind == "calibrate") continue;
        const nlohmann::json s = w.summary(kind);
        CHECK(s["energy"]["relative_error"].get<double>() < 1e-3);
        if (kind != "drop") {
            CHECK(s["test"]["peak_load_N"].get<double>() > 0.0);
            const nlohmann::json& cracks = s["cracks"];
            CHECK((cracks["area_m2"].get<double>() > 0.0 || kind == "pull_out"));
        }
    }
}

TEST_CASE("schema prints the schema")
{
    const Workplace w;
    const Outcome o = w.run("schema");
    CHECK(o.code == 0);
    CHECK(o.out == grainfrac::input_json_schema());
}

TEST_CASE("a model that memory does not hold ends with exit code 1 before it is made")
{
    if (grainfrac::available_memory() > 100e9) return;  // it does
    const Workplace w;
    REQUIRE(w.run("new brazilian").code == 0);
    const Outcome o = w.run("check brazilian.toml --set parts[0].region.diameter='\"3.5 m\"'");
    INFO(o.err);
    CHECK(o.code == 1);
    CHECK(o.err.find("GB of memory") != std::string::npos);
}
