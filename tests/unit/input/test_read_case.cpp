// SPDX-License-Identifier: GPL-3.0-or-later
#include "input_files.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

const std::string docs_file = std::string(GF_SOURCE_DIR) + "/docs/input.md";
const std::string begin_mark = "<!-- generated: begin -->\n", end_mark = "<!-- generated: end -->";

/// The n-th ```toml block of docs/input.md.
std::string example_of_docs(int n)
{
    const std::string docs = contents(docs_file), fence = "```toml\n";
    std::size_t at = 0;
    for (int k = 0; k <= n; ++k) at = docs.find(fence, at) + fence.size();
    return docs.substr(at, docs.find("```", at) - at);
}

}  // namespace

TEST_CASE("the example of docs/input.md is read as it stands", "[input]")
{
    const Case c = read_text(example_of_docs(0));
    CHECK(c.simulation.title == "Brazilian disc of hexagonal SiC grains");
    CHECK(c.simulation.seed == 1);
    REQUIRE(c.materials.size() == 1);
    CHECK(c.materials[0].name == "sic");
    CHECK(c.materials[0].density == 3100.0);
    CHECK(c.materials[0].young_modulus == 410e9);
    CHECK(c.materials[0].poisson_ratio == 0.16);
    REQUIRE(c.parts.size() == 1);
    const PartSpec& part = c.parts[0];
    CHECK(part.name == "disc");
    CHECK(part.material == "sic");
    CHECK(part.side == 0.6e-3);
    CHECK(part.thickness == 5e-3);
    CHECK(part.stacking == "columnar");
    CHECK(part.at_region_boundary == "cut");
    CHECK_FALSE(part.dilation_radius);
    CHECK(part.region.shape == "disc");
    CHECK(part.region.diameter == 15e-3);
    CHECK(part.region.height == 5e-3);
    REQUIRE(part.orientation.choices.size() == 3);
    CHECK(part.orientation.choices[1] == Approx(std::acos(0.5)).epsilon(1e-15));
    REQUIRE(c.bonds.size() == 1);
    CHECK(c.bonds[0].between[1] == "disc");
    CHECK(c.bonds[0].failure == "point");
    CHECK(c.bonds[0].tensile_strength == 100e6);
    CHECK(c.bonds[0].residual_friction == 0.4);
    CHECK(c.bonds[0].fracture_energy_II == 116.0);
    CHECK(c.bonds[0].weibull_modulus == 10.0);
    CHECK_FALSE(c.bonds[0].normal_stiffness);
    REQUIRE(c.contacts.size() == 2);
    CHECK(c.contacts[0].restitution == 0.5);
    CHECK(c.contacts[1].between[1] == "platen");
    CHECK(c.test.kind == "brazilian");
    CHECK(c.test.platen_speed == 20e-3);
    CHECK(c.test.stop.time == 1e-3);
    CHECK(c.output.every == 10e-6);
    CHECK(c.output.history == 0.1e-6);
    CHECK(c.output.checkpoint == 60.0);
}

TEST_CASE("a custom test: walls, stages, vectors of mixed spelling", "[input]")
{
    const std::string input = replaced(custom_input, "name = \"press\"", "name = \"approach\"");
    const Case c = read_text(input + example_of_docs(1).substr(example_of_docs(1).find("[[stages]]")));
    REQUIRE(c.walls.size() == 1);
    CHECK(c.walls[0].size[1] == 0.01);
    REQUIRE(c.stages.size() == 3);
    CHECK(c.stages[0].motions[0].wall == "top");
    CHECK(c.stages[0].motions[0].velocity == Vec3{0, -20e-3, 0});
    CHECK_FALSE(c.stages[1].fracture);
    CHECK(c.stages[1].unbalanced_force_ratio == 1e-3);
    CHECK(c.parts[0].region.size == Vec3{5e-3, 10e-3, 2e-3});
    CHECK(c.parts[0].orientation.choices == std::vector<double>{0.0});  // left out: aligned
}

TEST_CASE("places: file, line and text of every key", "[input]")
{
    const Case c = read_text(brazilian_input, {"parts.disc.side = '1 mm'"});
    CHECK(c.places.at("materials.sic.density").line == 6);
    CHECK(c.places.at("materials.sic.density").text == "\"3100 kg/m^3\"");
    CHECK(c.places.at("parts[0].region.diameter").line == 15);
    CHECK(c.places.at("parts[0].region.diameter").text == "\"15 mm\"");
    CHECK(c.places.at("parts[0].region").text == R"({ shape = "disc", diameter = "15 mm", height = "5 mm" })");
    CHECK(c.places.at("parts[0]").line == 10);
    CHECK(c.places.at("parts[0].side").file == "--set");
    CHECK(c.places.at("parts[0].side").line == 0);
    CHECK(c.places.at("parts[0].side").text == "'1 mm'");
    CHECK(c.places.at("bonds[0].fracture_energy_I").text == "29");
}

TEST_CASE("words with two spellings, and auto", "[input]")
{
    CHECK(read_text(replaced(brazilian_input, "side =", "stacking = \"AB\"\nside =")).parts[0].stacking == "hollow");
    CHECK(read_text(replaced(brazilian_input, "side =", "stacking = \"AA\"\nside =")).parts[0].stacking == "columnar");
    const Case c = read_text(
        replaced(brazilian_input, "friction = 0.3",
                 "friction = 0.3\nnormal_stiffness = \"auto\"\nshear_ratio = 0.4\nresidual_friction = \"auto\""));
    CHECK_FALSE(c.bonds[0].normal_stiffness);
    CHECK(c.bonds[0].shear_ratio == 0.4);
    CHECK_FALSE(c.bonds[0].residual_friction);
}

TEST_CASE("values of the command line", "[input]")
{
    const Case c =
        read_text(brazilian_input, {"parts[0].side=\"0.5 mm\"", "parts.disc.thickness = 0.002", "simulation.seed=9",
                                    "simulation.seed=11", "control.gravity=[0,0,\"-9.81 m/s^2\"]",
                                    "test.stop.time=\"1 ms\"", "parts.disc.orientation.random='uniform'",
                                    "materials.glass={density=2500,young_modulus='70 GPa',poisson_ratio=0.2}",
                                    "contacts[1].between=['disc','platen']"});
    CHECK(c.parts[0].side == 0.5e-3);
    CHECK(c.parts[0].thickness == 0.002);
    CHECK(c.simulation.seed == 11);  // the last one wins
    CHECK(c.control.gravity == Vec3{0, 0, -9.81});
    CHECK(c.test.stop.time == 1e-3);
    CHECK(c.parts[0].orientation.random == "uniform");
    CHECK(c.materials.size() == 2);
    REQUIRE(c.contacts.size() == 2);
    CHECK(c.contacts[1].between[1] == "platen");
}

TEST_CASE("resolved.toml reads back as the same case, bit for bit", "[input]")
{
    const std::string rod =
        "[[walls]]\nname = \"rod\"\nshape = \"cylinder\"\nradius = \"1 mm\"\nlength = \"5 mm\"\n"
        "[[walls]]\nname = \"ball\"\nshape = \"sphere\"\nradius = \"1 in\"\n";
    const std::string odd =
        "[simulation]\ntitle = \"a \\\"quoted\\\" \\\\ title,\\nµ\"\n"
        "[[bonds]]\nfailure = \"unbreakable\"\nnormal_stiffness = 0.1234567890123456789e15\n";
    std::vector<std::string> inputs = {example_of_docs(0), custom_input, custom_input + rod + odd, brazilian_input};
    const std::string strengths = "tensile_strength = 1e8\ncohesion = 2e8\n";
    inputs.push_back(custom_input + std::string("\n[[bonds]]\nlaw = \"parallel\"\n") + strengths);
    inputs.push_back(custom_input + std::string("\n[[bonds]]\nlaw = \"point\"\nsoftening = \"brittle\"\n") + strengths);
    inputs.push_back(replaced(custom_input,
                              "side = \"0.6 mm\"\nthickness = \"1.3 mm\"\nregion = { shape = \"box\", size = [\"5 "
                              "mm\", \"10 mm\", \"2 mm\"] }",
                              "generator = \"file\"\nfile = \"grains.h5\"\norientation = { file = \"q.txt\" }"));
    for (const std::string& input : inputs) {
        const Case c = read_text(input);
        const std::string resolved = to_toml(c);
        INFO(resolved);
        REQUIRE(problems_of(resolved) == "");
        const Case again = read_text(resolved);
        CHECK(to_toml(again) == resolved);
        CHECK(again.parts[0].orientation.choices == c.parts[0].orientation.choices);
        CHECK(again.parts[0].region.diameter == c.parts[0].region.diameter);
    }
    Case c = read_text(brazilian_input);
    for (const double x : {0.1, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, 123456789012345678.0, 1e16, 1e22}) {
        c.materials[0].density = x;
        CHECK(read_text(to_toml(c)).materials[0].density == x);
    }
}

TEST_CASE("docs/input.md holds the generated tables", "[input]")
{
    const std::string docs = contents(docs_file);
    const auto begin = docs.find(begin_mark), end = docs.find(end_mark);
    REQUIRE(begin != docs.npos);
    REQUIRE(end != docs.npos);
    INFO("write it anew with: test_input \"[.write-docs]\"");
    CHECK(docs.substr(begin + begin_mark.size(), end - begin - begin_mark.size()) == input_reference_markdown());
}

TEST_CASE("write the tables of docs/input.md", "[.write-docs]")
{
    std::string docs = contents(docs_file);
    const auto begin = docs.find(begin_mark) + begin_mark.size();
    docs.replace(begin, docs.find(end_mark) - begin, input_reference_markdown());
    std::ofstream(docs_file, std::ios::binary) << docs;
}
