// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of spheres: how they are read, and what is said about wrong ones.
#include "generate/packings.h"
#include "input_files.h"

#include <catch2/catch.hpp>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

const char* const sphere_input = R"([materials.rock]
density = 2000
young_modulus = "5 GPa"
poisson_ratio = 0.1

[[parts]]
name = "matrix"
kind = "spheres"
material = "rock"
generator = "hcp"
diameter = "0.5 m"
lattice_axis = "x"
region = { shape = "cylinder", diameter = "4 m", height = "6 m", axis = "x" }

[[parts]]
name = "fibre"
kind = "spheres"
material = "rock"
generator = "chain"
diameter = "0.4 m"
inside = "matrix"
fibre = { from = [-2, 0, 0], to = [2, 0, 0] }

[test]
kind = "drop"
drop_height = "1 m"
stop = { rest = 0.01 }
)";

const std::string chain_line = "fibre = { from = [-2, 0, 0], to = [2, 0, 0] }";

/// The report of reading and, if that is well, of generating.
std::string sphere_problems_of(const std::string& text)
{
    const std::string problems = problems_of(text);
    if (!problems.empty()) return problems;
    const TemporaryFile file(text);
    std::map<std::string, SourcePlace> places;
    const Case c = read_case(file.path(), {}, places);
    try {
        generate_spheres(c);
        return "";
    } catch (const InputError& e) {
        std::string out = render_problems(e.problems, c.places, c.file);
        const std::string folder = std::filesystem::path(file.path()).parent_path().string();
        for (std::size_t at; (at = out.find(file.path())) != out.npos;) out.replace(at, file.path().size(), "FILE");
        for (std::size_t at; (at = out.find(folder)) != out.npos;) out.replace(at, folder.size(), "FOLDER");
        return out;
    }
}

struct Wrong {
    std::string from, to, report;
};

const std::string hosts =
    "no other part of this name has kind = \"spheres\" and generator = \"hcp\", \"fcc\", "
    "\"random_dense\" or \"file\"; ";
const std::string hooked_line =
    "fibre = { shape = \"hooked\", from = [-1, 0, 0], to = [2, 0, 0], sideways = [0, 1, 0], hook_length = ";

const Wrong wrong_parts[] = {
    // kind and generator
    {"generator = \"hcp\"\n", "",
     "error: FILE:6: parts[0].generator: missing; required with kind = \"spheres\": one of \"hexagonal_prisms\", "
     "\"file\", \"hcp\", \"fcc\", \"random_dense\", \"chain\", \"taken\"\n"},
    {"generator = \"hcp\"", "generator = \"hexagonal_prisms\"",
     "error: FILE:10: parts[0].generator = \"hexagonal_prisms\": must be one of \"hcp\", \"fcc\", \"random_dense\", "
     "\"chain\", \"taken\", \"file\" with kind = \"spheres\"\n"},
    {"kind = \"spheres\"\nmaterial = \"rock\"\ngenerator = \"chain\"",
     "kind = \"grains\"\nmaterial = \"rock\"\ngenerator = \"chain\"",
     "error: FILE:19: parts[1].generator = \"chain\": must be one of \"hexagonal_prisms\", \"file\" with kind = "
     "\"grains\"\n"},
    {"generator = \"hcp\"", "generator = \"fcc\"",
     "error: FILE:12: parts[0].lattice_axis = \"x\": has no meaning here; it goes with generator = \"hcp\"\n"},
    {"diameter = \"0.5 m\"\n", "",
     "error: FILE:6: parts[0].diameter: missing; required with generator = \"hcp\", \"fcc\", \"random_dense\" or "
     "\"chain\": a quantity > 0 m such as \"1 m\"\n"},
    {"lattice_axis = \"x\"", "solid_fraction = 0.5",
     "error: FILE:12: parts[0].solid_fraction = 0.5: has no meaning here; it goes with generator = "
     "\"random_dense\"\n"},
    {"lattice_axis = \"x\"", "dilation_radius = 0.1",
     "error: FILE:12: parts[0].dilation_radius = 0.1: has no meaning here; it goes with kind = \"grains\"\n"},
    {"lattice_axis = \"x\"", "orientation = { random = \"uniform\" }",
     "error: FILE:12: parts[0].orientation = { random = \"uniform\" }: has no meaning here; it goes with kind = "
     "\"grains\"\n"},
    {"lattice_axis = \"x\"", "side = 1",
     "error: FILE:12: parts[0].side = 1: has no meaning here; it goes with generator = \"hexagonal_prisms\"\n"},
    {"generator = \"hcp\"\ndiameter = \"0.5 m\"\nlattice_axis = \"x\"",
     "generator = \"random_dense\"\ndiameter = \"0.5 m\"\nsolid_fraction = 0.7",
     "error: FILE:12: parts[0].solid_fraction = 0.7: must be <= 0.634, random close packing at size_ratio = 1; less "
     "beside walls\n"},
    {"generator = \"hcp\"\ndiameter = \"0.5 m\"\nlattice_axis = \"x\"", "generator = \"file\"\nfile = \"no_such.csv\"",
     "error: FILE:11: parts[0].file = \"no_such.csv\": cannot read \"FOLDER/no_such.csv\"\n"},
    {"lattice_axis = \"x\"", "file = \"s.csv\"",
     "error: FILE:12: parts[0].file = \"s.csv\": has no meaning here; it goes with generator = \"file\"\n"},
    {"generator = \"hcp\"\ndiameter = \"0.5 m\"\nlattice_axis = \"x\"",
     "generator = \"random_dense\"\ndiameter = \"0.5 m\"\nsolid_fraction = 0.63",
     "error: FILE:12: parts[0].solid_fraction = 0.63: cannot be reached in this region: overlaps of 0.05 of the "
     "diameter are left; about 0.57 is possible, less than far from walls\n"},
    {"generator = \"hcp\"\ndiameter = \"0.5 m\"\nlattice_axis = \"x\"",
     "generator = \"random_dense\"\ndiameter = \"0.5 m\"\nsize_ratio = 40",
     "error: FILE:12: parts[0].size_ratio = 40: must be >= 1 and <= 10\n"},
    {"generator = \"hcp\"\ndiameter = \"0.5 m\"\nlattice_axis = \"x\"",
     "generator = \"random_dense\"\ndiameter = \"3 m\"\nsize_ratio = 3",
     "error: FILE:11: parts[0].diameter = \"3 m\": no sphere fits: the largest are 4.5 m wide, the region is 4 m at "
     "its "
     "smallest\n"},
    // regions
    {"region = ", "#",
     "error: FILE:6: parts[0].region: missing; required with generator = \"hexagonal_prisms\", "
     "\"hcp\", \"fcc\", \"random_dense\" or \"taken\": a table\n"},
    {"shape = \"cylinder\", diameter = \"4 m\", height = \"6 m\", axis = \"x\"",
     "shape = \"sphere\", diameter = 4, height = 2",
     "error: FILE:13: parts[0].region.height = 2: has no meaning here; it goes with shape = \"cylinder\" or "
     "\"disc\"\n"},
    {"diameter = \"0.4 m\"", "diameter = \"0.4 m\"\nregion = { shape = \"sphere\", diameter = 1 }",
     "error: FILE:21: parts[1].region = { shape = \"sphere\", diameter = 1 }: has no meaning here; it goes with "
     "any generator but \"chain\"\n"},
    {"height = \"6 m\"", "height = \"0.1 m\"",
     "error: FILE:11: parts[0].diameter = \"0.5 m\": no sphere fits: 0.5 m against 0.1 m, the smallest length of the "
     "region\n"},
    {"diameter = \"0.5 m\"", "diameter = \"0.5 mm\"",
     "error: FILE:11: parts[0].diameter = \"0.5 mm\": makes 8.5e+11 spheres; at most 2e+07 are possible\n"},
    // inside
    {"inside = \"matrix\"", "inside = \"matrx\"",
     "error: FILE:21: parts[1].inside = \"matrx\": " + hosts + "there are \"matrix\"; did you mean \"matrix\"?\n"},
    {"inside = \"matrix\"", "inside = \"fibre\"",
     "error: FILE:21: parts[1].inside = \"fibre\": " + hosts + "there are \"matrix\"\n"},
    {"generator = \"chain\"\ndiameter = \"0.4 m\"\ninside = \"matrix\"\n" + chain_line,
     "generator = \"taken\"\nregion = { shape = \"sphere\", diameter = 1 }",
     "error: FILE:15: parts[1].inside: missing; required with generator = \"taken\": a text\n"},
    {"diameter = \"0.4 m\"\ninside = \"matrix\"\n" + chain_line,
     "inside = \"matrix\"\nregion = { shape = \"sphere\", diameter = 1, center = [9, 0, 0] }",
     "error: FILE:15: parts[1].diameter: missing; required with generator = \"hcp\", \"fcc\", \"random_dense\" or "
     "\"chain\": a quantity > 0 m such as \"1 m\"\n"
     "error: FILE:15: parts[1].fibre: missing; required with generator = \"chain\": a table\n"
     "error: FILE:21: parts[1].region = { shape = \"sphere\", diameter = 1, center = [9, 0, 0] }: has no meaning "
     "here; it goes with any generator but \"chain\"\n"},
    {"generator = \"chain\"\ndiameter = \"0.4 m\"\ninside = \"matrix\"\n" + chain_line,
     "generator = \"taken\"\ninside = \"matrix\"\nregion = { shape = \"sphere\", diameter = 1, center = [9, 0, 0] }",
     "error: FILE:21: parts[1].region = { shape = \"sphere\", diameter = 1, center = [9, 0, 0] }: no sphere of "
     "\"matrix\" has its centre in it\n"},
    {"generator = \"chain\"\ndiameter = \"0.4 m\"\ninside = \"matrix\"\n" + chain_line,
     "generator = \"taken\"\ninside = \"matrix\"\nregion = { shape = \"sphere\", diameter = 20 }",
     "error: FILE:21: parts[1].region = { shape = \"sphere\", diameter = 20 }: takes all spheres of \"matrix\"\n"},
    {"generator = \"chain\"\ndiameter = \"0.4 m\"\ninside = \"matrix\"\n" + chain_line,
     "generator = \"taken\"\ninside = \"matrix\"\nregion = { shape = \"cylinder\", diameter = 4, height = 1, axis = "
     "\"x\" }",
     "error: FILE:21: parts[1].region.diameter = 4: 4 m; must be smaller than the 4 m of \"matrix\"\n"},
    // the fibre
    {chain_line, "", "error: FILE:15: parts[1].fibre: missing; required with generator = \"chain\": a table\n"},
    {chain_line, "fibre = { from = [-2, 0, 0] }",
     "error: FILE:22: parts[1].fibre.to: missing; required with shape = \"straight\", \"wavy\" or \"hooked\": an array "
     "of 3 such as [\"1 m\", \"1 m\", \"1 m\"]\n"},
    {"to = [2, 0, 0]", "to = [-2, 0, 0]",
     "error: FILE:22: parts[1].fibre.to = [-2, 0, 0]: must not be the same point as from\n"},
    {"to = [2, 0, 0]", "to = [2, 0, 0], sideways = [0, 1, 0]",
     "error: FILE:22: parts[1].fibre.sideways = [0, 1, 0]: has no meaning here; it goes with shape = \"wavy\" or "
     "\"hooked\"\n"},
    {"to = [2, 0, 0]", "to = [2, 0, 0], shape = \"wavy\", amplitude = 0.1",
     "error: FILE:22: parts[1].fibre.wavelength: missing; required with shape = \"wavy\": a quantity > 0 m such as \"1 "
     "m\"\n"},
    {"to = [2, 0, 0]", "to = [2, 0, 0], shape = \"wavy\", amplitude = 0.1, wavelength = 2",
     "error: FILE:22: parts[1].fibre = { from = [-2, 0, 0], to = [2, 0, 0], shape = \"wavy\", amplitude = 0.1, "
     "wavelength...: "
     "sideways: must not be zero or along the fibre\n"},
    {"to = [2, 0, 0]", "to = [2, 0, 0], shape = \"wavy\", amplitude = 0.1, wavelength = 1, sideways = [1, 0, 0]",
     "error: FILE:22: parts[1].fibre.sideways = [1, 0, 0]: must not be zero or along the fibre\n"},
    {"to = [2, 0, 0]", "to = [2, 0, 0], shape = \"wavy\", amplitude = 0.1, wavelength = 1, sideways = [0, 1, 0]",
     "error: FILE:22: parts[1].fibre.wavelength = 1: must be >= 1.6 m, four times the spacing of the spheres\n"},
    {"to = [2, 0, 0]", "to = [2, 0, 0], shape = \"wavy\", amplitude = 1.5, wavelength = 1.6, sideways = [0, 1, 0]",
     "error: FILE:22: parts[1].fibre.amplitude = 1.5: bends too sharply for the spacing of the spheres: two that are "
     "0.404851 m apart along the fibre are 0.272362 m apart\n"},
    {chain_line, hooked_line + "0.3 }",
     "error: FILE:22: parts[1].fibre.hook_length = 0.3: must be >= 0.4 m, the spacing of the spheres\n"},
    {chain_line, hooked_line + "0.5, hook_angle = \"100 deg\" }",
     "error: FILE:22: parts[1].fibre.hook_angle = \"100 deg\": must be > 0 rad and <= 1.5707963267948966 rad\n"},
    {chain_line, hooked_line + "0.6, hook_angle = \"90 deg\" }",
     "error: FILE:22: parts[1].fibre.hook_angle = \"90 deg\": bends too sharply for the spacing of the spheres: two "
     "that are 0.381818 m apart along the fibre are 0.272727 m apart\n"},
    {chain_line, "fibre = { shape = \"points\", points = [[0, 0, 0]] }",
     "error: FILE:22: parts[1].fibre.points = [[0, 0, 0]]: has 1 points; must have at least 2\n"},
    {chain_line, "fibre = { shape = \"points\", points = [[0, 0, 0], [1, 0, 0], [1, 0, 0]] }",
     "error: FILE:22: parts[1].fibre.points[2] = [1, 0, 0]: is the same point as the one before\n"},
    {chain_line, "fibre = { shape = \"points\", points = [[0, 0, 0], [1, 0, 0], [0.1, 0.1, 0]] }",
     "error: FILE:22: parts[1].fibre.points = [[0, 0, 0], [1, 0, 0], [0.1, 0.1, 0]]: bends too sharply for the spacing "
     "of the spheres: two that are 0.381108 m apart along the fibre are 0.0966429 m apart\n"},
    {chain_line, "fibre = { shape = \"points\", points = [1, 0, 0] }",
     "error: FILE:22: parts[1].fibre.points[0] = 1: is an integer; must be an array of 3 such as [\"1 m\", \"1 m\", "
     "\"1 m\"]\n"
     "error: FILE:22: parts[1].fibre.points[1] = 0: is an integer; must be an array of 3 such as [\"1 m\", \"1 m\", "
     "\"1 m\"]\n"
     "error: FILE:22: parts[1].fibre.points[2] = 0: is an integer; must be an array of 3 such as [\"1 m\", \"1 m\", "
     "\"1 m\"]\n"},
    {"to = [2, 0, 0]", "to = [2, 0, 0], spacing = 9",
     "error: FILE:22: parts[1].fibre.spacing = 9: makes a chain of one sphere: must be < 8 m, twice the length of the "
     "fibre\n"},
    {"to = [2, 0, 0]", "to = [2, 0, 0], radius = 5",
     "error: FILE:22: parts[1].fibre.radius = 5: the fibre takes the place of all spheres of \"matrix\"\n"},
    {"from = [-2, 0, 0], to = [2, 0, 0]", "from = [-2, 9, 0], to = [2, 9, 0]",
     "error: FILE:22: parts[1].fibre = { from = [-2, 9, 0], to = [2, 9, 0] }: this fibre is outside of \"matrix\", "
     "whose spheres lie between (-3.10774, -2.25, -2.12639) and (3.10774, 2.25, 1.98205) m\n"},
    {"inside = \"matrix\"", "inside = \"matrix\"\ncopies = [[0, 1, 0], [0, 9, 0]]",
     "error: FILE:22: parts[1].copies[1] = [0, 9, 0]: this fibre is outside of \"matrix\", whose spheres lie between "
     "(-3.10774, -2.25, -2.12639) and (3.10774, 2.25, 1.98205) m\n"},
    {"inside = \"matrix\"", "inside = \"matrix\"\ncopies = [[0, 0, 0]]",
     "error: FILE:22: parts[1].copies[0] = [0, 0, 0]: must not be zero: that is the chain itself\n"},
    {"inside = \"matrix\"", "inside = \"matrix\"\ncopies = [[0, 1, 0], [0, \"1 m\", 0]]",
     "error: FILE:22: parts[1].copies[1] = [0, \"1 m\", 0]: is listed already\n"},
    {"inside = \"matrix\"", "inside = \"matrix\"\ncopies = 3",
     "error: FILE:22: parts[1].copies = 3: is an integer; must be an array of points such as [[\"1 m\", \"1 m\", \"1 "
     "m\"]]\n"},
};

}  // namespace

TEST_CASE("parts of spheres are read", "[input][packings]")
{
    std::string text = sphere_input;
    text = replaced(text, chain_line,
                    "fibre = { shape = \"points\", points = [[0, 0, 0], [\"1 m\", 0, 0]], radius = \"30 cm\" }\ncopies "
                    "= [[0, \"1 m\", 0]]");
    const Case c = read_text(text);
    REQUIRE(c.parts.size() == 2);
    CHECK(c.parts[0].kind == "spheres");
    CHECK(c.parts[0].generator == "hcp");
    CHECK(c.parts[0].diameter == 0.5);
    CHECK(c.parts[0].lattice_axis == "x");
    CHECK(c.parts[0].orientation.choices.empty());
    CHECK(c.parts[1].fibre.points == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}});
    CHECK(c.parts[1].fibre.radius == 0.3);
    CHECK_FALSE(c.parts[1].fibre.spacing);
    CHECK(c.parts[1].copies == std::vector<Vec3>{{0, 1, 0}});
}

TEST_CASE("the spheres of docs/input.md are made as they stand", "[input][packings]")
{
    const std::string docs = contents(std::string(GF_SOURCE_DIR) + "/docs/input.md");
    const auto begin = docs.find("[[parts]]\nname           = \"matrix\"");
    REQUIRE(begin != docs.npos);
    const std::string materials = "density = 2000\nyoung_modulus = \"5 GPa\"\npoisson_ratio = 0.1\n",
                      test = "[test]\nkind = \"drop\"\ndrop_height = 1\nstop = { time = 1 }\n";
    const Case c = read_text("[materials.mortar]\n" + materials + "[materials.steel]\n" + materials + test +
                             docs.substr(begin, docs.find("```", begin) - begin));
    const std::vector<SphereSpec> spheres = generate_spheres(c);
    CHECK(spheres.size() > 2000);
    CHECK(spheres.back().position == Vec3{0, 0, 0.02});
    CHECK(spheres.back().chain == 0);
}

TEST_CASE("resolved.toml of parts of spheres reads back as the same case", "[input][packings]")
{
    const std::string fibre = sphere_input;
    const std::string random = replaced(fibre, "generator = \"hcp\"\ndiameter = \"0.5 m\"\nlattice_axis = \"x\"",
                                        "generator = \"random_dense\"\ndiameter = \"0.5 m\"\nsize_ratio = 2");
    for (const std::string& input :
         {fibre, random,
          replaced(fibre, "shape = \"cylinder\", diameter = \"4 m\", height = \"6 m\", axis = \"x\"",
                   "shape = \"sphere\", diameter = 4"),
          replaced(fibre,
                   "generator = \"hcp\"\ndiameter = \"0.5 m\"\nlattice_axis = \"x\"\nregion = { shape = "
                   "\"cylinder\", diameter = \"4 m\", height = \"6 m\", axis = \"x\" }",
                   "generator = \"file\"\nfile = \"s.csv\""),
          replaced(fibre, chain_line, hooked_line + "0.6 }\ncopies = [[0, 0, 1]]"),
          replaced(fibre, chain_line, "fibre = { shape = \"points\", points = [[0, 0, 0], [1, 0, 0]] }"),
          replaced(fibre, "generator = \"chain\"\ndiameter = \"0.4 m\"\ninside = \"matrix\"\n" + chain_line,
                   "generator = \"taken\"\ninside = \"matrix\"\nregion = { shape = \"sphere\", diameter = 1 }")}) {
        INFO(input);
        const std::string resolved = to_toml(read_text(input));
        INFO(resolved);
        REQUIRE(problems_of(resolved) == "");
        CHECK(to_toml(read_text(resolved)) == resolved);
    }
}

TEST_CASE("wrong parts of spheres are refused with file, line, key, value and what is allowed", "[input][packings]")
{
    REQUIRE(sphere_problems_of(sphere_input) == "");
    for (const Wrong& wrong : wrong_parts) {
        INFO(wrong.from << " -> " << wrong.to);
        CHECK(sphere_problems_of(replaced(sphere_input, wrong.from, wrong.to)) == wrong.report);
    }
}
