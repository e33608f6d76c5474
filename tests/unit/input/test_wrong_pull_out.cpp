// SPDX-License-Identifier: GPL-3.0-or-later
// The example of the fibre pull-out, spoilt: what is said of the keys of spheres, fibres and their interfaces.
#include "experiment/experiment.h"
#include "input_files.h"

#include <catch2/catch.hpp>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

std::string example()
{
    std::ifstream in(GF_SOURCE_DIR "/examples/fibre_pullout/fibre_pullout.toml");
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

}  // namespace

TEST_CASE("wrong keys of a pull-out are told with what is allowed", "[input]")
{
    const std::string good = example();
    REQUIRE(problems_of(good).empty());
    const auto report = [&](const char* from, const char* to) { return problems_of(replaced(good.c_str(), from, to)); };
    CHECK(report("matrix      = \"matrix\"", "matrix      = \"matrx\"") ==
          "error: FILE:55: test.matrix = \"matrx\": no such part; there are \"matrix\", \"fibre\"; did you mean "
          "\"matrix\"?\n");
    CHECK(report("fibre       = \"fibre\"", "fibre       = \"matrix\"") ==
          "error: FILE:54: test.fibre = \"matrix\": must be a part of spheres with generator = \"chain\" or \"taken\"\n"
          "error: FILE:55: test.matrix = \"matrix\": must be another part than test.fibre\n");
    CHECK(
        report("damage_step = 0.005", "control = \"displacement\"") ==
        "error: FILE:52: test.stop: the run would never end; required: at least one of load_drop, strain, time, slip, "
        "damage\n");
    CHECK(report("damage_step = 0.005", "damage_step = 0") ==
          "error: FILE:56: test.damage_step = 0: must be >= 1e-06 and <= 1\n");
    CHECK(report("damage_step = 0.005", "platen_speed = 1") ==
          "error: FILE:56: test.platen_speed = 1: has no meaning here; it goes with control = \"speed\"\n");
    CHECK(report("\"3 mm\"", "\"1 mm\"") ==
          "error: FILE:50: bonds[2].failure_slip = \"1 mm\": must be > 0.001 m, the yield_slip\n");
    CHECK(report("yield_slip      = \"1 mm\"\n", "") ==
          "error: FILE:45: bonds[2].yield_slip: missing; required with failure_slip\n");
    // not the message of grains, whose interfaces have strengths
    CHECK(report("shear_stiffness = \"1e9 Pa/m\"\n", "") ==
          "error: FILE:45: bonds[2].shear_stiffness: missing; required for the interface of a fibre, such as \"1e9 "
          "Pa/m\"\n");
    CHECK(report("\"3 mm\"", "\"3 mm\"\ncontraction = 0.1") ==
          "error: FILE:51: bonds[2].contraction = 0.1: has no meaning here; it goes with radial_pressure\n");
    CHECK(
        report("law     = \"parallel\"", "law     = \"point\"") ==
        "error: FILE:37: bonds[0].law = \"point\": \"point\" joins grains; spheres take \"parallel\" or \"spring\"\n");
    CHECK(report("[test]", "[control]\ngravity = [0, 0, 1]\n[test]") ==
          "error: FILE:53: control.gravity = [0, 0, 1]: has no place in a row of equilibria; use test.control = "
          "\"speed\"\n");
}

TEST_CASE("what breaks besides the interface is refused with damage control", "[input]")
{
    const std::string text = example();
    for (const char* name : {"matrix", "fibre"}) {
        const std::string entry =
            std::string("between = [\"") + name + "\", \"" + name + "\"]\nlaw     = \"parallel\"\n";
        const std::string weak =
            replaced(text, entry + "failure = \"unbreakable\"", entry + "tensile_strength = 1e6\ncohesion = 1e7");
        const std::string key = name == std::string("matrix") ? "FILE:35: bonds[0]" : "FILE:40: bonds[1]";
        CHECK(
            build_problems_of(weak) ==
            "error: " + key +
                ".failure: must be \"unbreakable\" with test.control = \"damage\", in which only the interface of the "
                "fibre breaks; or use \"displacement\" or \"speed\"\n");
    }
}

TEST_CASE("fibres whose spheres do not fit are told by their size", "[input]")
{
    std::string small = replaced(example(), "\"30 m\"", "\"5 m\"");
    small = replaced(replaced(small, "\"-15.2 m\"", "\"-2.7 m\""), "\"15.2 m\"", "\"2.7 m\"");
    CHECK(build_problems_of(small) == "");
    CHECK(build_problems_of(replaced(small, "\"0.8 m\"", "\"2.2 m\"")) ==
          "error: FILE:31: parts[1].diameter = \"2.2 m\": must be <= 1.633 m: so far are spheres 757 and 759 of "
          "\"fibre\" "
          "apart, which are no neighbours along it\n");
    const std::string wavy = "radius = \"0.4 m\", shape = \"wavy\", amplitude = \"0.3 m\", wavelength = \"4 m\"";
    CHECK(
        build_problems_of(replaced(small, "radius = \"1 m\"", wavy)) ==
        "error: FILE:31: parts[1].diameter = \"0.8 m\": must be <= 0.5568 m, or fibre.radius larger than 0.4 m: sphere "
        "776 of \"fibre\" lies in sphere 574 of \"matrix\"\n");
    const std::string gentle = replaced(replaced(wavy, "0.3 m", "0.2 m"), "4 m\"", "4 m\", sideways = [1, 0, 0]");
    CHECK(
        build_problems_of(replaced(replaced(small, "radius = \"1 m\"", gentle), "-2.7 m", "-2.2 m")) ==
        "error: FILE:31: parts[1].diameter = \"0.8 m\": must be <= 0.5575 m, or fibre.radius larger than 0.4 m: sphere "
        "775 of \"fibre\" lies in sphere 61 of \"matrix\"\n");  // which is of the supported face
}

TEST_CASE("copies of a chain that overlap may be set farther apart", "[input]")
{
    std::ifstream in(GF_SOURCE_DIR "/examples/damped_pair/damped_pair.toml");
    std::string text(std::istreambuf_iterator<char>(in), {});
    const std::size_t bonds = text.find("[[bonds]]");  // what is bonded may overlap
    text.erase(bonds, text.find("[[grips]]") - bonds);
    const auto copy_at = [&](const std::string& y) {
        return build_problems_of(
            replaced(text, "[2, 0, 0] }", "[2, 0, 0], radius = 0.5 }\ncopies = [[0, " + y + ", 0]]"));
    };
    CHECK(copy_at("2") == "");
    CHECK(copy_at("1.5") ==
          "error: FILE:21: parts[0].diameter = \"2 m\": must be <= 1.5 m, or set its copies farther apart: so far are "
          "spheres 0 and 2 of \"pair\" apart, which are of two copies\n");
}
