// SPDX-License-Identifier: GPL-3.0-or-later
// What is wrong is said with file, line, key, value as written, and what is allowed.
#include "experiment/experiment.h"
#include "input_files.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

/// A good file, what is changed in it, and all that is then reported.
struct Wrong {
    const char* base;
    const char* from;
    const char* to;
    const char* report;
};

const char* const B = brazilian_input;
const char* const C = custom_input;

/// A bar without bonds, and the test of `lines`, which begin in line 15.
std::string bar(const std::string& lines)
{
    const std::string custom = custom_input;
    return custom.substr(0, custom.find("[[walls]]")) + "\n[test]\n" + lines;
}
const std::string uniaxial_input =
    bar("kind = \"uniaxial_compression\"\nplaten_speed = 1\nwall_friction = 0.1\nstop = { strain = 0.01 }\n");
const std::string four_point_input =
    bar("kind = \"four_point_bending\"\nplaten_speed = 1\nouter_span = \"16 mm\"\ninner_span = \"8 mm\"\nstop = { time "
        "= 1 }\n");
const std::string drop_input = bar("kind = \"drop\"\ndrop_height = \"5 mm\"\nstop = { rest = 0.01 }\n");
const char* const U = uniaxial_input.c_str();
const char* const F = four_point_input.c_str();
const char* const D = drop_input.c_str();

const Wrong wrong_values[] = {
    // ranges, units, types of a quantity
    {B, "\"3100 kg/m^3\"", "\"-3100 kg/m^3\"",
     "error: FILE:6: materials.sic.density = \"-3100 kg/m^3\": must be > 0 kg/m^3\n"},
    {B, "\"3100 kg/m^3\"", "0", "error: FILE:6: materials.sic.density = 0: must be > 0 kg/m^3\n"},
    {B, "\"3100 kg/m^3\"", "nan",
     "error: FILE:6: materials.sic.density = nan: is not a finite number; must be a quantity > 0 kg/m^3 such as \"1 "
     "kg/m^3\"\n"},
    {B, "\"3100 kg/m^3\"", "+inf  # much",
     "error: FILE:6: materials.sic.density = +inf: is not a finite number; must be a quantity > 0 kg/m^3 such as \"1 "
     "kg/m^3\"\n"},
    {B, "\"3100 kg/m^3\"", "true",
     "error: FILE:6: materials.sic.density = true: is a boolean; must be a quantity > 0 kg/m^3 such as \"1 kg/m^3\"\n"},
    {B, "\"3100 kg/m^3\"", "[1]",
     "error: FILE:6: materials.sic.density = [1]: is an array; must be a quantity > 0 kg/m^3 such as \"1 kg/m^3\"\n"},
    {B, "\"3100 kg/m^3\"", "1979-05-27",
     "error: FILE:6: materials.sic.density = 1979-05-27: is a date or time; must be a quantity > 0 kg/m^3 such as \"1 "
     "kg/m^3\"\n"},
    // cleavage
    {B, "poisson_ratio = 0.16",
     "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"{10-11\"]\ntoughness = \"2 MPa m^0.5\"\nflaw_size = "
     "\"30 um\"",
     "error: FILE:10: materials.sic.cleavage.planes[0] = \"{10-11\": \"{10-11\" is no crystal plane: it stands neither "
     "in {} nor in (); expected Miller-Bravais indices, e.g. \"{10-10}\" or \"(0001)\"\n"},
    {B, "poisson_ratio = 0.16",
     "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"{10-10}\"]\ntoughness = \"2 MPa\"\nflaw_size = \"30 "
     "um\"",
     "error: FILE:11: materials.sic.cleavage.toughness = \"2 MPa\": is a stress; expected a stress intensity, e.g. \"1 "
     "Pa m^0.5\"\n"},
    {B, "poisson_ratio = 0.16",
     "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"{10-10}\"]\ntoughness = \"2 MPa m^0.5\"\nflaw_size = "
     "\"30 um\"\ncriterion = \"elipse\"",
     "error: FILE:13: materials.sic.cleavage.criterion = \"elipse\": must be one of \"ellipse\", \"shetty\", "
     "\"energy\"; did you mean \"ellipse\"?\n"},
    {B, "poisson_ratio = 0.16",
     "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"{10-10}\"]\ntoughness = \"2 MPa m^0.5\"\nflaw_size = "
     "\"30 um\"\nhydrostatic_threshold = 1",
     "error: FILE:13: materials.sic.cleavage.hydrostatic_threshold = 1: has no meaning here; it goes with gate = "
     "\"hydrostatic\"\n"},
    {B, "poisson_ratio = 0.16",
     "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"{10-10}\"]\ntoughness = \"2 MPa m^0.5\"\nflaw_size = "
     "\"30 um\"\nmax_generation = -1",
     "error: FILE:13: materials.sic.cleavage.max_generation = -1: must be >= 0 and <= 20\n"},
    {B, "poisson_ratio = 0.16",
     "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"{10-10}\"]\ntoughness = [\"2 MPa m^0.5\", \"3 MPa "
     "m^0.5\"]\nflaw_size = \"30 um\"",
     "error: FILE:11: materials.sic.cleavage.toughness = [\"2 MPa m^0.5\", \"3 MPa m^0.5\"]: has 2 values; must have "
     "one for all planes, or 1 as `planes`\n"},
    {B, "\"0.6 mm\"", "\"0.6 kg\"",
     "error: FILE:13: parts[0].side = \"0.6 kg\": is a mass; expected a length, e.g. \"1 m\"\n"},
    {B, "\"0.6 mm\"", "\"0.6\"",
     "error: FILE:13: parts[0].side = \"0.6\": has no unit; expected a length, e.g. \"1 m\"\n"},
    {B, "\"0.6 mm\"", "\"0,6 mm\"",
     "error: FILE:13: parts[0].side = \"0,6 mm\": has a comma; the decimal separator is a point; expected a length, "
     "e.g. \"1 m\"\n"},
    {B, "\"0.6 mm\"", "\"0.6 mmm\"",
     "error: FILE:13: parts[0].side = \"0.6 mmm\": has an unknown unit \"mmm\"; expected a length, e.g. \"1 m\"\n"},
    {B, "\"0.6 mm\"", "\"1e999 mm\"",
     "error: FILE:13: parts[0].side = \"1e999 mm\": is outside the range of numbers; expected a length, e.g. \"1 "
     "m\"\n"},
    {B, "= 0.16", "= 0.5", "error: FILE:8: materials.sic.poisson_ratio = 0.5: must be > -1 and < 0.5\n"},
    {B, "seed = 7", "seed = 7.5",
     "error: FILE:3: simulation.seed = 7.5: is a number with a fraction; must be an integer >= 0\n"},
    {B, "seed = 7", "seed = -7", "error: FILE:3: simulation.seed = -7: must be >= 0\n"},
    {B, "title = \"disc\"", "title = 3", "error: FILE:2: simulation.title = 3: is an integer; must be a text\n"},
    {B, "side =", "sliver_fraction = 0.7\nside =",
     "error: FILE:13: parts[0].sliver_fraction = 0.7: must be >= 0 and < 0.5\n"},
    {B, "every =", "contacts = \"yes\"\nevery =",
     "error: FILE:34: output.contacts = \"yes\": is a text; must be true or false\n"},
    {B, "cohesion =", "residual_friction = []\ncohesion =",
     "error: FILE:20: bonds[0].residual_friction = []: is an array; must be a number >= 0 or \"auto\"\n"},
    {B, "\"15 mm\"", "\"15 MPa\"",
     "error: FILE:15: parts[0].region.diameter = \"15 MPa\": is a stress; expected a length, e.g. \"1 m\"\n"},
    {B, "side =", "velocity = [1, 2]\nside =",
     "error: FILE:13: parts[0].velocity = [1, 2]: has 2 entries; must be an array of 3 such as [\"1 m/s\", \"1 m/s\", "
     "\"1 m/s\"]\n"},
    {B, "side =", "velocity = [1, \"2 m\", 3]\nside =",
     "error: FILE:13: parts[0].velocity[1] = \"2 m\": is a length; expected a velocity, e.g. \"1 m/s\"\n"},
    {B, "side =", "velocity = 3\nside =",
     "error: FILE:13: parts[0].velocity = 3: is an integer; must be an array of 3 such as [\"1 m/s\", \"1 m/s\", \"1 "
     "m/s\"]\n"},
    // words
    {B, "\"disc\", diameter", "\"disk\", diameter",
     "error: FILE:15: parts[0].region.shape = \"disk\": must be one of \"box\", \"beam\", \"cylinder\", \"disc\", "
     "\"sphere\"; did you mean \"disc\"?\n"},
    {B, "side =", "stacking = \"zigzag\"\nside =",
     "error: FILE:13: parts[0].stacking = \"zigzag\": must be one of \"columnar\", \"half\", \"hollow\", \"AA\", "
     "\"AB\"\n"},
    {B, "friction = 0.2", "law = \"hertz\"", "error: FILE:26: contacts[0].law = \"hertz\": must be \"linear\"\n"},
    {B, "cohesion =", "failure = \"cohesive\"\ncohesion =",
     "error: FILE:20: bonds[0].failure = \"cohesive\": must be one of \"unbreakable\", \"point\", \"face\"\n"},
    // keys and tables
    {B, "density =", "densty =",
     "error: FILE:5: materials.sic.density: missing; required: a quantity > 0 kg/m^3 such as \"1 kg/m^3\"\n"
     "error: FILE:6: materials.sic.densty = \"3100 kg/m^3\": unknown key; did you mean \"density\"?\n"},
    {B, "[output]", "[outptu]", "error: FILE:33: outptu: unknown key; did you mean \"output\"?\n"},
    {B, "seed = 7", "colour = 7", "error: FILE:3: simulation.colour = 7: unknown key; known here: title, seed\n"},
    {B, "seed = 7", "\"a b\" = 7", "error: FILE:3: simulation.\"a b\" = 7: unknown key; known here: title, seed\n"},
    {B, "side = \"0.6 mm\"\n", "",
     "error: FILE:10: parts[0].side: missing; required with generator = \"hexagonal_prisms\": a quantity > 0 m such as "
     "\"1 m\"\n"},
    {B, "diameter = \"15 mm\", ", "",
     "error: FILE:15: parts[0].region.diameter: missing; required with shape = \"cylinder\", \"disc\" or \"sphere\": a "
     "quantity > "
     "0 m such as \"1 m\"\n"},
    {B, "region =", "# region =",
     "error: FILE:10: parts[0].region: missing; required with generator = \"hexagonal_prisms\", \"hcp\", \"fcc\", "
     "\"random_dense\" or \"taken\": a table\n"},
    {B, "height = \"5 mm\"", "height = \"5 mm\", size = [1, 1, 1]",
     "error: FILE:15: parts[0].region.size = [1, 1, 1]: has no meaning here; it goes with shape = \"box\" or "
     "\"beam\"\n"},
    {B, "side =", "generator = \"file\"\nside =",
     "error: FILE:10: parts[0].file: missing; required with generator = \"file\": a text\n"
     "error: FILE:14: parts[0].side = \"0.6 mm\": has no meaning here; it goes with generator = \"hexagonal_prisms\"\n"
     "error: FILE:15: parts[0].thickness = \"5 mm\": has no meaning here; it goes with generator = "
     "\"hexagonal_prisms\"\n"},
    {B, "[[parts]]", "[parts]", "error: FILE:10: parts: is a table; must be an array of tables, [[parts]]\n"},
    {B, "[output]\nevery = \"10 us\"", "output = 3",
     "error: FILE:33: test.output = 3: unknown key; known here: kind, platen_speed, platen, platen_radius, "
     "contact_half_width, direction, ends, grip_length, wall_friction, outer_span, inner_span, roller_radius, "
     "notch_depth, crack_length, drop_height, side_gap, fibre, matrix, support, control, damage_step, "
     "displacement_step, slide_step, profiles_at, relaxed, ramp, stop\n"},
    {B, "stop = { load_drop = 0.5 }", "stop = 3", "error: FILE:31: test.stop = 3: is an integer; must be a table\n"},
    // names
    {B, "material = \"sic\"", "material = \"sci\"",
     "error: FILE:12: parts[0].material = \"sci\": no such material; there are \"sic\"; did you mean \"sic\"?\n"},
    {B, "[\"disc\", \"disc\"]", "[\"disc\", \"dics\"]",
     "error: FILE:18: bonds[0].between[1] = \"dics\": no part, material or wall of this name; there are \"disc\", "
     "\"sic\", \"platen\", \"platen_top\", \"platen_bottom\", \"*\"; did you mean \"disc\"?\n"},
    {B, "[\"disc\", \"disc\"]", "[\"disc\"]",
     "error: FILE:18: bonds[0].between = [\"disc\"]: has 1 entries; must be an array of 2 names such as [\"*\", "
     "\"*\"]\n"},
    {B, "name = \"disc\"", "name = \"the disc\"",
     "error: FILE:11: parts[0].name = \"the disc\": the name of a part must consist of letters, digits, _ and -\n"},
    {B, "[test]", "[[contacts]]\nbetween = [\"*\", \"*\"]\n[test]",
     "error: FILE:29: contacts[1].between = [\"*\", \"*\"]: contacts[0] is for the same pair\n"},
    {C, "name = \"top\"", "name = \"block\"",
     "error: FILE:14: walls[0].name = \"block\": a part of this name exists already; parts, materials and walls need "
     "different names\n"
     "error: FILE:19: stages[0].move[0].wall = \"top\": no such wall; there are \"block\"\n"},
    {C, "wall = \"top\"", "wall = \"tpo\"",
     "error: FILE:19: stages[0].move[0].wall = \"tpo\": no such wall; there are \"top\"; did you mean \"top\"?\n"},
    {C, "[[stages]]", "[[contacts]]\nbetween = [\"block\", \"platen\"]\n[[stages]]",
     "error: FILE:18: contacts[0].between[1] = \"platen\": no part, material or wall of this name; there are "
     "\"block\", \"sic\", \"top\", \"*\"\n"},
    // values that contradict each other
    {B, "friction = 0.3", "friction = 0.3\nresidual_friction = 0.31",
     "error: FILE:22: bonds[0].residual_friction = 0.31: must be <= friction, 0.3: broken bonds would create energy\n"},
    {B, "friction = 0.3", "friction = 3",
     "error: FILE:19: bonds[0].tensile_strength = \"300 MPa\": must be <= 2e+08 Pa, cohesion / friction, with onset = "
     "\"mohr_coulomb\"\n"},
    {B, "fracture_energy_I = 29\n", "",
     "error: FILE:17: bonds[0].fracture_energy_I: missing; required with softening = \"bilinear\": a quantity > 0 "
     "J/m^2 such as \"1 J/m^2\"\n"},
    {B, "tensile_strength = \"300 MPa\"\n", "softening = \"brittle\"\n",
     "error: FILE:17: bonds[0].tensile_strength: missing; required with failure = \"point\" or \"face\": a quantity > "
     "0 Pa such as \"1 Pa\"\n"},
    {B, "friction = 0.3", "failure = \"face\"",
     "error: FILE:21: bonds[0].failure = \"face\": \"face\" needs softening = \"brittle\", not \"bilinear\"\n"},
    {B, "friction = 0.3", "failure = \"face\"\nlaw = \"point\"\nsoftening = \"brittle\"",
     "error: FILE:21: bonds[0].failure = \"face\": \"face\" needs law = \"interface\", not \"point\"\n"},
    {B, "poisson_ratio = 0.16\n",
     "poisson_ratio = 0.26\n[[bonds]]\nelasticity = \"solid\"\nfailure = \"unbreakable\"\n",
     "error: FILE:10: bonds[0].elasticity = \"solid\": \"solid\" with shear_ratio = \"auto\" needs poisson_ratio < "
     "1/4; that of \"sic\" is 0.26\n"},
    {B, "friction = 0.3", "law = \"parallel\"\nsoftening = \"bilinear\"",
     "error: FILE:22: bonds[0].softening = \"bilinear\": \"bilinear\" needs law = \"interface\", not \"parallel\"\n"},
    {B, "side =", "dilation_radius = \"0.3 mm\"\nside =",
     "error: FILE:13: parts[0].dilation_radius = \"0.3 mm\": must be <= 0.000173205 m, a third of the inradius of the "
     "prism (side 0.0006 m, thickness 0.005 m)\n"},
    {B, "side =", "orientation = { random = \"uniform\", file = \"q\" }\nside =",
     "error: FILE:13: parts[0].orientation = { random = \"uniform\", file = \"q\" }: has several of choices, random, "
     "file; must have exactly one\n"},
    {B, "side =", "orientation = {}\nside =",
     "error: FILE:13: parts[0].orientation = {}: has none of choices, random, file; must have exactly one\n"},
    {B, "side =", "orientation = { choices = [] }\nside =",
     "error: FILE:13: parts[0].orientation.choices = []: is empty; must be a quantity such as \"1 rad\", "
     "or an array of them\n"},
    {B, "platen_speed = \"20 mm/s\"\n", "",
     "error: FILE:28: test.platen_speed: missing; required with any kind but \"custom\" and \"drop\": a quantity > 0 "
     "m/s "
     "such as \"1 m/s\"\n"},
    {B, "height = \"5 mm\"", "height = \"5 mm\", axis = \"x\"",
     "error: FILE:15: parts[0].region.axis = \"x\": must be \"z\" in a brazilian test\n"},
    {B, "{ shape = \"disc\", diameter = \"15 mm\", height = \"5 mm\" }", "{ shape = \"box\", size = [1, 1, 1] }",
     "error: FILE:15: parts[0].region.shape = \"box\": must be \"disc\" or \"cylinder\" in a brazilian test\n"},
    {B, "[output]", "[[stages]]\nname = \"a\"\nduration = 1\n[output]",
     "error: FILE:33: stages[0]: a brazilian test makes its own stages; use test.kind = \"custom\"\n"},
    {B, "platen_speed =", "contact_half_width = \"8 mm\"\nplaten_speed =",
     "error: FILE:30: test.contact_half_width = \"8 mm\": must be <= 0.0075 m, half the diameter of the disc\n"},
    {B, "load_drop = 0.5", "",
     "error: FILE:31: test.stop = { }: the run would never end; required: at least one of load_drop, strain, time\n"},
    {B, "every =", "snapshots = 5\nevery =",
     "error: FILE:34: output.snapshots = 5: give either every or snapshots, not both\n"},
    {B, "every = \"10 us\"", "snapshots = 5",
     "error: FILE:34: output.snapshots = 5: needs test.stop.time or a stage with a duration; or give every\n"},
    {C, "duration = \"1 ms\"\n", "",
     "error: FILE:17: stages[0]: never ends; required: at least one of duration, max_displacement, load, stress, "
     "load_drop, unbalanced_force_ratio, rest, or test.stop.time\n"},
    {C, "duration = \"1 ms\"", "duration = \"1 ms\"\n[test]\nplaten_speed = 1",
     "error: FILE:22: test.platen_speed = 1: has no meaning here; it goes with any kind but \"custom\" and "
     "\"drop\"\n"},
    {C, "name = \"top\"", "name = \"top\"\nnormal = [0, 0, 0]",
     "error: FILE:15: walls[0].normal = [0, 0, 0]: must not be zero\n"},
    {C, "size = [0.01, 0.01]", "shape = \"sphere\"",
     "error: FILE:13: walls[0].radius: missing; required with shape = \"cylinder\" or \"sphere\": a quantity > 0 m "
     "such as \"1 m\"\n"},
    {C, "velocity = [0, \"-20 mm/s\", 0]", "velocity = [0, 0, 0]", ""},
    // cleavage planes and flaws
    {B, "poisson_ratio = 0.16",
     "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"{11-10}\"]\ntoughness = 1\nflaw_size = \"30 um\"",
     "error: FILE:10: materials.sic.cleavage.planes[0] = \"{11-10}\": \"{11-10}\" is no crystal plane: the first three "
     "indices do not add up to zero; expected Miller-Bravais indices, e.g. \"{10-10}\" or \"(0001)\"\n"},
    {B, "poisson_ratio = 0.16",
     "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"{10-10\"]\ntoughness = 1\nflaw_size = \"30 um\"",
     "error: FILE:10: materials.sic.cleavage.planes[0] = \"{10-10\": \"{10-10\" is no crystal plane: it stands neither "
     "in {} nor in (); expected Miller-Bravais indices, e.g. \"{10-10}\" or \"(0001)\"\n"},
    {B, "poisson_ratio = 0.16",
     "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"(0000)\"]\ntoughness = 1\nflaw_size = \"30 um\"",
     "error: FILE:10: materials.sic.cleavage.planes[0] = \"(0000)\": \"(0000)\" is no crystal plane: all indices are "
     "zero; expected Miller-Bravais indices, e.g. \"{10-10}\" or \"(0001)\"\n"},
    {B, "poisson_ratio = 0.16",
     "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"{12}\"]\ntoughness = 1\nflaw_size = \"30 um\"",
     "error: FILE:10: materials.sic.cleavage.planes[0] = \"{12}\": \"{12}\" is no crystal plane: it has 2 indices, not "
     "four; expected Miller-Bravais indices, e.g. \"{10-10}\" or \"(0001)\"\n"},
    {B, "poisson_ratio = 0.16",
     "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"(0001)\"]\ntoughness = 1\nflaw_size = \"30 "
     "um\"\nmode_ratio = 0",
     "error: FILE:13: materials.sic.cleavage.mode_ratio = 0: must be > 0\n"},
    {B, "poisson_ratio = 0.16",
     "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"(0001)\"]\ntoughness = 1\nflaw_size = \"30 "
     "um\"\nfriction = -1",
     "error: FILE:13: materials.sic.cleavage.friction = -1: must be >= 0\n"},
    {B, "poisson_ratio = 0.16",
     "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"(0001)\"]\ntoughness = 1\nflaw_size = \"30 "
     "um\"\nmin_section = 1",
     "error: FILE:13: materials.sic.cleavage.min_section = 1: must be >= 0 and < 1\n"},
    {B, "poisson_ratio = 0.16",
     "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"(0001)\"]\ntoughness = 1\nflaw_size = \"30 "
     "um\"\nflaw = \"round\"",
     "error: FILE:13: materials.sic.cleavage.flaw = \"round\": must be one of \"through\", \"edge\", \"penny\"\n"},
    {B, "poisson_ratio = 0.16",
     "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"(0001)\"]\ntoughness = 1\nflaw_size = \"30 "
     "um\"\nfracture_energy = 3\nnew_surface = \"free\"",
     "error: FILE:13: materials.sic.cleavage.fracture_energy = 3: has no meaning here; it goes with new_surface = "
     "\"cohesive\" or \"pre_cut\"\n"},
    {B, "poisson_ratio = 0.16",
     "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = []\ntoughness = 0\nflaw_size = \"-30 um\"",
     "error: FILE:10: materials.sic.cleavage.planes = []: is empty; must be an array of texts such as [\"{10-10}\"]\n"
     "error: FILE:11: materials.sic.cleavage.toughness = 0: must be > 0 Pa m^0.5\n"
     "error: FILE:12: materials.sic.cleavage.flaw_size = \"-30 um\": must be > 0 m\n"},
    {B, "poisson_ratio = 0.16", "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"(0001)\"]",
     "error: FILE:9: materials.sic.cleavage.toughness: missing; required: a quantity > 0 Pa m^0.5 such as \"1 Pa "
     "m^0.5\", or an array of them\n"
     "error: FILE:9: materials.sic.cleavage.flaw_size: missing; required: a quantity > 0 m such as \"1 m\"\n"},
    {B, "poisson_ratio = 0.16",
     "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"{10-10}\", \"{10-10}\"]\ntoughness = \"2 MPa "
     "m^0.5\"\nflaw_size = \"30 um\"\nmin_fragment_volume = 0.5",
     "error: FILE:10: materials.sic.cleavage.planes[1] = \"{10-10}\": is listed already\n"
     "error: FILE:13: materials.sic.cleavage.min_fragment_volume = 0.5: must be >= 0 and < 0.5\n"},
    {B, "poisson_ratio = 0.16",
     "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"{10-10}\"]\ntoughness = \"2 MPa m^0.5\"\nflaw_size = "
     "\"30 um\"\nnew_surface = \"pre_cut\"\nresidual_friction = 0.4",
     "error: FILE:14: materials.sic.cleavage.residual_friction = 0.4: must be <= friction, 0.3, with new_surface = "
     "\"pre_cut\": broken planes would create energy\n"},
    // walls: sizes, sides, files, servos
    {C, "size = [0.01, 0.01]", "size = [0.01, 0.01, 0.01]",
     "error: FILE:15: walls[0].size = [0.01, 0.01, 0.01]: has 3 entries; a plate must have 2 such as [\"1 m\", \"1 "
     "m\"]\n"},
    {C, "size = [0.01, 0.01]", "shape = \"box\"\nsize = [0.01, 0.01]",
     "error: FILE:16: walls[0].size = [0.01, 0.01]: has 2 entries; a box must have 3 such as [\"1 m\", \"1 m\", \"1 "
     "m\"]\n"},
    {C, "size = [0.01, 0.01]", "shape = \"bxo\"\nsize = [0.01, 0.01]",
     "error: FILE:15: walls[0].shape = \"bxo\": must be one of \"plate\", \"box\", \"cylinder\", \"sphere\", \"stl\"; "
     "did you mean \"box\"?\n"},
    {C, "size = [0.01, 0.01]", "shape = \"box\"\nsize = [1, 1, 1]\nopen = [\"up\"]",
     "error: FILE:17: walls[0].open[0] = \"up\": must be one of \"+x\", \"-x\", \"+y\", \"-y\", \"+z\", \"-z\"\n"},
    {C, "size = [0.01, 0.01]", "size = [1, 1]\nopen = [\"+z\"]",
     "error: FILE:16: walls[0].open = [\"+z\"]: has no meaning here; it goes with shape = \"box\"\n"},
    {C, "size = [0.01, 0.01]", "shape = \"box\"\nsize = [1, 1, 1]\nopen = [\"+z\", \"+z\"]",
     "error: FILE:17: walls[0].open = [\"+z\", \"+z\"]: names a side twice\n"},
    {C, "size = [0.01, 0.01]",
     "shape = \"box\"\nsize = [1, 1, 1]\nopen = [\"+x\", \"-x\", \"+y\", \"-y\", \"+z\", \"-z\"]",
     "error: FILE:17: walls[0].open = [\"+x\", \"-x\", \"+y\", \"-y\", \"+z\", \"-z\"]: no side of the box is left\n"},
    {C, "size = [0.01, 0.01]", "shape = \"box\"\nsize = [1, 1, 1]\nopen = \"+z\"",
     "error: FILE:17: walls[0].open = \"+z\": is a text; must be an array of texts, each one of \"+x\", \"-x\", "
     "\"+y\", \"-y\", \"+z\", \"-z\"\n"},
    {C, "size = [0.01, 0.01]", "shape = \"box\"\nsize = [1, 1, -1]",
     "error: FILE:16: walls[0].size[2] = -1: must be > 0 m\n"},
    {C, "size = [0.01, 0.01]", "shape = \"stl\"",
     "error: FILE:13: walls[0].file: missing; required with shape = \"stl\": a text\n"
     "error: FILE:13: walls[0].file_unit: missing; required with shape = \"stl\": a quantity > 0 m such as \"1 m\"\n"},
    {C, "size = [0.01, 0.01]", "shape = \"stl\"\nfile = \"\"\nfile_unit = \"1 mm\"",
     "error: FILE:16: walls[0].file = \"\": must not be empty\n"},
    {C, "size = [0.01, 0.01]", "shape = \"stl\"\nfile = \"a.stl\"\nfile_unit = \"1 kg\"",
     "error: FILE:17: walls[0].file_unit = \"1 kg\": is a mass; expected a length, e.g. \"1 m\"\n"},
    {C, "size = [0.01, 0.01]", "size = [1, 1]\nfile = \"a.stl\"",
     "error: FILE:16: walls[0].file = \"a.stl\": has no meaning here; it goes with shape = \"stl\"\n"},
    {C, "size = [0.01, 0.01]", "size = [1, 1]\nservo = {}",
     "error: FILE:16: walls[0].servo = {}: has none of force, stress; must have exactly one: the push that the wall "
     "holds\n"},
    {C, "size = [0.01, 0.01]", "size = [1, 1]\nservo = { force = \"1 N\", stress = \"1 Pa\" }",
     "error: FILE:16: walls[0].servo = { force = \"1 N\", stress = \"1 Pa\" }: has both of force, stress; must have "
     "exactly one: the push that the wall holds\n"},
    {C, "size = [0.01, 0.01]", "size = [1, 1]\nservo = { stress = \"1 N\" }",
     "error: FILE:16: walls[0].servo.stress = \"1 N\": is a force; expected a stress, e.g. \"1 Pa\"\n"},
    {C, "size = [0.01, 0.01]", "size = [1, 1]\nservo = { force = -1 }",
     "error: FILE:16: walls[0].servo.force = -1: must be > 0 N\n"},
    {C, "size = [0.01, 0.01]", "size = [1, 1]\nservo = { force = 1, area = 1 }",
     "error: FILE:16: walls[0].servo.area = 1: has no meaning here; it goes with stress\n"},
    {C, "size = [0.01, 0.01]", "size = [1, 1]\nservo = { force = 1, max_speed = 0 }",
     "error: FILE:16: walls[0].servo.max_speed = 0: must be > 0 m/s\n"},
    {C, "size = [0.01, 0.01]", "size = [1, 1]\nservo = { force = 1, direction = [0, 0, 0] }",
     "error: FILE:16: walls[0].servo.direction = [0, 0, 0]: must not be zero\n"},
    {C, "size = [0.01, 0.01]", "size = [1, 1]\nservo = { force = 1, target = 2 }",
     "error: FILE:16: walls[0].servo.target = 2: unknown key; known here: force, stress, area, direction, max_speed\n"},
    {C, "size = [0.01, 0.01]", "size = [1, 1]\nservo = { force = 1 }\nvelocity = [0, 1, 0]",
     "error: FILE:17: walls[0].velocity = [0, 1, 0]: give either velocity or servo, not both\n"},
    {C, "size = [0.01, 0.01]", "shape = \"sphere\"\nradius = 1\nservo = { force = 1 }",
     "error: FILE:17: walls[0].servo = { force = 1 }: direction is missing; required for a wall that is no plate: "
     "where it pushes\n"},
    {U, "[test]", "[[walls]]\nname = \"side\"\nsize = [1, 1]\nservo = { force = 1 }\n[test]",
     "error: FILE:17: walls[0].servo = { force = 1 }: a uniaxial_compression test drives its own walls; use test.kind "
     "= \"custom\"\n"},
    // stages
    {C, ", velocity = [0, \"-20 mm/s\", 0]", "",
     "error: FILE:19: stages[0].move[0] = { wall = \"top\" }: must have velocity or servo\n"},
    {C, ", velocity = [0, \"-20 mm/s\", 0]", ", servo = { stress = \"1 MPa\", force = \"1 N\" }",
     "error: FILE:19: stages[0].move[0].servo = { stress = \"1 MPa\", force = \"1 N\" }: has both of force, stress; "
     "must have exactly one: the push that the wall holds\n"},
    {C, "velocity = [0, \"-20 mm/s\", 0]", "velocity = [0, 1, 0], servo = { stress = \"1 MPa\" }",
     "error: FILE:19: stages[0].move[0].velocity = [0, 1, 0]: give either velocity or servo, not both\n"},
    {C, "duration =", "kind = \"lod\"\nduration =",
     "error: FILE:20: stages[0].kind = \"lod\": must be one of \"settle\", \"compact\", \"bond\", \"load\", "
     "\"unload\"; did you mean \"load\"?\n"},
    {C, "duration =", "rest = 1.5\nduration =", "error: FILE:20: stages[0].rest = 1.5: must be > 0 and <= 1\n"},
    {C, "duration =", "gravity = 9.81\nduration =",
     "error: FILE:20: stages[0].gravity = 9.81: is a number with a fraction; must be an array of 3 such as [\"1 "
     "m/s^2\", \"1 m/s^2\", \"1 m/s^2\"] or \"auto\"\n"},
    {C, "duration =", "gravity = [0, 0, \"9.81 m\"]\nduration =",
     "error: FILE:20: stages[0].gravity[2] = \"9.81 m\": is a length; expected an acceleration, e.g. \"1 m/s^2\"\n"},
    {C, "duration =", "local_damping = 1\nduration =",
     "error: FILE:20: stages[0].local_damping = 1: must be >= 0 and < 1\n"},
    {C, "duration =", "stress = \"-1 MPa\"\nduration =",
     "error: FILE:20: stages[0].stress = \"-1 MPa\": must be > 0 Pa\n"},
    {C, "duration =", "bond_distance = \"1 um\"\nduration =",
     "error: FILE:20: stages[0].bond_distance = \"1 um\": has no meaning here; it goes with kind = \"bond\"\n"},
    {C, "velocity = [0, \"-20 mm/s\", 0] }]", "velocity = [0, 0, 0] }]\nload = 3\nstress = 4\nmax_displacement = 5",
     "error: FILE:20: stages[0].load = 3: no wall moves in this stage\n"
     "error: FILE:21: stages[0].stress = 4: no wall moves in this stage\n"
     "error: FILE:22: stages[0].max_displacement = 5: no wall moves in this stage\n"},
    {C, "duration = \"1 ms\"", "duration = \"1 ms\"\n[[stages]]\nname = \"on\"\nkind = \"bond\"",
     "error: FILE:21: stages[1].bond_distance: missing; required with kind = \"bond\": a quantity > 0 m such as \"1 "
     "m\"\n"},
    {C, "duration = \"1 ms\"",
     "duration = \"1 ms\"\n[[stages]]\nname = \"on\"\nkind = \"bond\"\nbond_distance = \"1 um\"\nduration = 1",
     "error: FILE:25: stages[1].duration = 1: has no meaning here; it goes with any kind but \"bond\"\n"},
    {C, "duration = \"1 ms\"",
     "duration = \"1 ms\"\n[[stages]]\nname = \"on\"\nkind = \"bond\"\nbond_distance = 0\nbond_angle = \"40 deg\"",
     "error: FILE:24: stages[1].bond_distance = 0: must be > 0 m\n"
     "error: FILE:25: stages[1].bond_angle = \"40 deg\": must be > 0 rad and <= 0.5 rad\n"},
    {C, "duration = \"1 ms\"", "duration = \"1 ms\"\n[[stages]]\nname = \"on\"\nkind = \"bond\"\nbond_distance = 1",
     "error: FILE:21: stages[1]: makes no bonds; required: [[bonds]] with made_in = \"on\"\n"},
    {C, "[[stages]]\n", "[[bonds]]\nfailure = \"unbreakable\"\nmade_in = \"pres\"\n[[stages]]\n",
     "error: FILE:19: bonds[0].made_in = \"pres\": no stage of kind = \"bond\" has this name; there are none\n"},
    {B, "cohesion =", "made_in = \"later\"\ncohesion =",
     "error: FILE:20: bonds[0].made_in = \"later\": no stage of kind = \"bond\" has this name; there are none\n"},
    {C, "move = [{ wall = \"top\", velocity = [0, \"-20 mm/s\", 0] }]\n", "kind = \"unload\"\n",
     "error: FILE:17: stages[0]: no wall moved before; say in move how walls go back\n"},
    {C, "velocity = [0, \"-20 mm/s\", 0] }]\nduration = \"1 ms\"",
     "servo = { force = 1 } }]\nduration = 1\n[[stages]]\nname = \"back\"\nkind = \"unload\"",
     "error: FILE:21: stages[1]: wall \"top\" held a push before; say in move how it goes back\n"},
    {C, "duration = \"1 ms\"", "duration = \"1 ms\"\n[[stages]]\nname = \"press\"\nduration = 1",
     "error: FILE:22: stages[1].name = \"press\": a stage of this name exists already\n"},
    {C, "thickness =", "gap = \"-1 um\"\nthickness =", "error: FILE:10: parts[0].gap = \"-1 um\": must be >= 0 m\n"},
    // ready-made tests; U, F, D: see above
    {U, "uniaxial_compression", "uniaxial_tension",
     "error: FILE:17: test.wall_friction = 0.1: has no meaning here; it goes with kind = \"uniaxial_compression\" "
     "(platens) or bending\n"},
    {U, "wall_friction = 0.1", "grip_length = \"1 mm\"",
     "error: FILE:17: test.grip_length = \"1 mm\": has no meaning here; it goes with kind = \"uniaxial_tension\" or "
     "\"dcb\", or ends = \"gripped\"\n"},
    {U, "wall_friction = 0.1", "wall_friction = -0.1", "error: FILE:17: test.wall_friction = -0.1: must be >= 0\n"},
    {U, "wall_friction = 0.1", "ends = \"glued\"",
     "error: FILE:17: test.ends = \"glued\": must be one of \"platens\", \"gripped\"\n"},
    {U, "stop = { strain = 0.01 }", "stop = { rest = 0.01 }",
     "error: FILE:18: test.stop = { rest = 0.01 }: the run would never end; required: at least one of load_drop, "
     "strain, time\n"
     "error: FILE:18: test.stop.rest = 0.01: has no meaning here; it goes with kind = \"drop\"\n"},
    {U, "[test]", "[[walls]]\nname = \"platen_top\"\nsize = [1, 1]\n[test]",
     "error: FILE:15: walls[0].name = \"platen_top\": this name belongs to the walls of the uniaxial_compression "
     "test\n"},
    {F, "inner_span = \"8 mm\"", "inner_span = \"16 mm\"",
     "error: FILE:18: test.inner_span = \"16 mm\": must be < 0.016 m, the outer span\n"},
    {F, "inner_span = \"8 mm\"", "inner_span = 0",
     "error: FILE:18: test.inner_span = 0: must be > 0 m; one loading roller is kind = \"three_point_bending\"\n"},
    {F, "inner_span = \"8 mm\"\n", "",
     "error: FILE:14: test.inner_span: missing; required with kind = \"four_point_bending\": a quantity >= 0 m such as "
     "\"1 m\"\n"},
    {F, "outer_span = \"16 mm\"\n", "",
     "error: FILE:14: test.outer_span: missing; required with kind = \"three_point_bending\", \"four_point_bending\" "
     "or "
     "\"notched_beam\": a quantity > 0 m such as \"1 m\"\n"},
    {F, "inner_span = \"8 mm\"", "inner_span = \"8 mm\"\nroller_radius = 0",
     "error: FILE:19: test.roller_radius = 0: must be > 0 m\n"},
    {F, "inner_span = \"8 mm\"", "inner_span = \"8 mm\"\nnotch_depth = \"1 mm\"",
     "error: FILE:19: test.notch_depth = \"1 mm\": has no meaning here; it goes with kind = \"notched_beam\"\n"},
    {F, "\"four_point_bending\"", "\"notched_beam\"",
     "error: FILE:14: test.notch_depth: missing; required with kind = \"notched_beam\": a quantity > 0 m such as \"1 "
     "m\"\n"},
    {D, "drop_height = \"5 mm\"", "drop_height = \"-5 mm\"",
     "error: FILE:16: test.drop_height = \"-5 mm\": must be >= 0 m\n"},
    {D, "drop_height = \"5 mm\"\n", "",
     "error: FILE:14: test.drop_height: missing; required with kind = \"drop\": a quantity >= 0 m such as \"1 m\"\n"},
    {D, "drop_height = \"5 mm\"", "drop_height = \"5 mm\"\nside_gap = -1",
     "error: FILE:17: test.side_gap = -1: must be >= 0 m\n"},
    {D, "rest = 0.01", "load_drop = 0.5",
     "error: FILE:17: test.stop = { load_drop = 0.5 }: the run would never end; required: at least one of time, rest\n"
     "error: FILE:17: test.stop.load_drop = 0.5: has no meaning in a drop test; use time or rest\n"},
    {D, "[test]", "[control]\ngravity = [0, 1, 1]\n[test]",
     "error: FILE:15: control.gravity = [0, 1, 1]: must point along an axis in a drop test; left out it is 9.81 m/s^2 "
     "along -z\n"},
    {D, "\"drop\"\ndrop_height = \"5 mm\"\nstop = { rest = 0.01 }", "\"dcb\"\nplaten_speed = 1\nstop = { time = 1 }",
     "error: FILE:14: test.crack_length: missing; required with kind = \"dcb\": a quantity > 0 m such as \"1 m\"\n"},
    // TOML itself
    {B, "seed = 7", "seed = ", "error: FILE:3: "},
    {B, "seed = 7", "title = \"again\"", "error: FILE:3: "},
    {B, "\"0.6 mm\"", "\"0.6 mm", "error: FILE:13: "},
    {B, "[materials.sic]", "[materials.sic", "error: FILE:5: "},
    {B, "\"0.6 mm\"", "600 µm",
     "error: FILE:13: a character that is not ASCII stands outside quotation marks; quantities with units are texts, "
     "e.g. \"30 µm\"\n"},
    {B, "[[parts]]", "[[[parts]]]", "error: FILE:10: not TOML: a bracket or a key is out of place\n"},
    {B, "[[parts]]", "[[=", "error: FILE:10: not TOML: a bracket or a key is out of place\n"},
};

/// `s` n times, with something before and behind: thousands of dots or brackets that ask for a tree of tables.
std::string repeated(const char* before, const char* s, int n, const char* behind)
{
    std::string out = before;
    for (int i = 0; i < n; ++i) out += s;
    return out += behind;
}

/// What only building the model can find out.
struct Unbuildable {
    std::string base;
    const char* from;
    const char* to;
    const char* report;
};

const std::string bonded_bar = replaced(custom_input, "[[walls]]", "[[bonds]]\nfailure = \"unbreakable\"\n\n[[walls]]");
std::string bonded(const std::string& lines)
{
    return bonded_bar.substr(0, bonded_bar.find("[[walls]]")) + "[test]\n" + lines;
}
const std::string short_span = replaced(replaced(four_point_input, "\"16 mm\"", "\"4 mm\""), "\"8 mm\"", "\"2 mm\"");
const std::string three_point =
    replaced(replaced(short_span, "four_point", "three_point"), "inner_span = \"2 mm\"\n", "");
const std::string notched = replaced(replaced(short_span, "four_point_bending", "notched_beam"),
                                     "inner_span = \"2 mm\"", "roller_radius = \"0.5 mm\"\nnotch_depth = \"20 mm\"");
const std::string dcb = bonded("kind = \"dcb\"\nplaten_speed = 1\ncrack_length = \"2 mm\"\nstop = { time = 1 }\n");
const std::string cleaving =
    replaced(custom_input, "poisson_ratio = 0.16",
             "poisson_ratio = 0.16\n[materials.sic.cleavage]\nplanes = [\"{10-10}\"]\ntoughness = \"2 MPa "
             "m^0.5\"\nflaw_size = \"30 um\"");

const Unbuildable unbuildable[] = {
    {four_point_input, "\"16 mm\"", "\"16 mm\"",
     "error: FILE:17: test.outer_span = \"16 mm\": must be <= 0.00467654 m, the length of the specimen: the supports "
     "would stand beside it\n"},
    {short_span, "inner_span", "roller_radius = \"3 mm\"\ninner_span",
     "error: FILE:18: test.roller_radius = \"3 mm\": must be < 0.001 m, half of the smaller span, or two rollers "
     "overlap\n"},
    {three_point, "outer_span = \"4 mm\"", "outer_span = \"40 mm\"",
     "error: FILE:17: test.outer_span = \"40 mm\": must be <= 0.00467654 m, the length of the specimen: the supports "
     "would stand beside it\n"},
    {notched, "\"20 mm\"", "\"20 mm\"",
     "error: FILE:19: test.notch_depth = \"20 mm\": must be < 0.0099 m, the height of the beam\n"},
    {uniaxial_input, "wall_friction = 0.1", "ends = \"gripped\"\ngrip_length = \"6 mm\"",
     "error: FILE:18: test.grip_length = \"6 mm\": the two grips meet; must be less than half of the specimen's "
     "length\n"},
    {uniaxial_input, "wall_friction = 0.1", "ends = \"gripped\"\ngrip_length = \"1 um\"",
     "error: FILE:18: test.grip_length = \"1 um\": no grain has its centre within this length of the end; raise it\n"},
    {dcb, "crack_length = \"2 mm\"", "crack_length = \"60 mm\"",
     "error: FILE:19: test.crack_length = \"60 mm\": must be < 0.00467654 m, the length of the arms\n"},
    {dcb, "[[bonds]]\nfailure = \"unbreakable\"\n", "",
     "error: FILE:15: test.kind = \"dcb\": a dcb test needs [[bonds]] of law = \"interface\" between the arms\n"},
    {cleaving, "\"30 um\"", "\"3 mm\"",
     "error: FILE:8: materials.sic.cleavage.flaw_size = \"3 mm\": must be < 0.000519615 m: the flaw would be longer "
     "than the ball that fits in a grain of \"block\" is wide\n"},
    {cleaving, "\"30 um\"", "\"3 mm\"\nflaw = \"edge\"",
     "error: FILE:8: materials.sic.cleavage.flaw_size = \"3 mm\": must be < 0.00103923 m: the flaw would be longer "
     "than the ball that fits in a grain of \"block\" is wide\n"},
    {custom_input, "thickness =", "gap = \"2 mm\"\nthickness =",
     "error: FILE:10: parts[0].gap = \"2 mm\": nothing is left of a grain; lower it\n"},
    {custom_input, "name = \"top\"\nsize = [0.01, 0.01]",
     "name = \"top\"\nshape = \"stl\"\nfile = \"no_such.stl\"\nfile_unit = 1\nclosed = false",
     "error: FILE:16: walls[0].file = \"no_such.stl\": \"FOLDER/no_such.stl\" cannot be opened: No such file or "
     "directory\n"},
    {custom_input, "size = [0.01, 0.01]", "shape = \"box\"\nsize = [\"5 mm\", \"5 mm\", \"5 mm\"]",
     "error: FILE:13: walls[0]: grain 4 of \"block\" and wall \"top\" overlap at the start, by 4.58e-05 m or more; "
     "move them apart\n"},
};

}  // namespace

TEST_CASE("the files that are spoiled are good", "[input]")
{
    CHECK(problems_of(brazilian_input) == "");
    CHECK(problems_of(custom_input) == "");
    for (const char* const input : {U, F, D}) CHECK(problems_of(input) == "");
}

TEST_CASE("wrong values are reported with file, line, key, value and what is allowed", "[input]")
{
    for (const Wrong& wrong : wrong_values) {
        INFO(wrong.from << " -> " << wrong.to);
        const std::string report = problems_of(replaced(wrong.base, wrong.from, wrong.to));
        const std::string expected = wrong.report;
        if (expected.ends_with(": ")) {  // what follows is the TOML parser's
            CHECK(report.substr(0, expected.size()) == expected);
            CHECK(report.size() > expected.size() + 10);
        } else {
            CHECK(report == expected);
        }
    }
}

TEST_CASE("experiments that cannot be built are refused with file, line, key, value and what is allowed", "[input]")
{
    for (const Unbuildable& wrong : unbuildable) {
        INFO(wrong.from << " -> " << wrong.to);
        CHECK(build_problems_of(replaced(wrong.base, wrong.from, wrong.to)) == wrong.report);
    }
}

TEST_CASE("five mistakes are reported together, in the order of the file", "[input]")
{
    std::string text = brazilian_input;
    text = replaced(text, "\"3100 kg/m^3\"", "\"-3100 kg/m^3\"");
    text = replaced(text, "thickness =", "thicknes =");
    text = replaced(text, "\"15 mm\"", "\"15 kg\"");
    text = replaced(text, "cohesion = \"600 MPa\"\n", "");
    text = replaced(text, "\"brazilian\"", "\"brasilian\"");
    CHECK(problems_of(text) ==
          "error: FILE:6: materials.sic.density = \"-3100 kg/m^3\": must be > 0 kg/m^3\n"
          "error: FILE:10: parts[0].thickness: missing; required with generator = \"hexagonal_prisms\": a quantity > 0 "
          "m such as \"1 m\"\n"
          "error: FILE:14: parts[0].thicknes = \"5 mm\": unknown key; did you mean \"thickness\"?\n"
          "error: FILE:15: parts[0].region.diameter = \"15 kg\": is a mass; expected a length, e.g. \"1 m\"\n"
          "error: FILE:17: bonds[0].cohesion: missing; required with failure = \"point\" or \"face\": a quantity > 0 "
          "Pa such as \"1 Pa\"\n"
          "error: FILE:28: test.kind = \"brasilian\": must be one of \"brazilian\", "
          "\"uniaxial_compression\", \"uniaxial_tension\", \"three_point_bending\", \"four_point_bending\", "
          "\"notched_beam\", \"dcb\", \"drop\", \"pull_out\", \"custom\"; did you mean \"brazilian\"?\n");
}

TEST_CASE("wrong values of the command line", "[input]")
{
    const auto report = [](const std::string& text) { return problems_of(brazilian_input, {text}); };
    CHECK(report("parts[0].side=\"-1 mm\"") == "error: --set parts[0].side = \"-1 mm\": must be > 0 m\n");
    CHECK(report("parts.disc.side=\"1 s\"") ==
          "error: --set parts[0].side = \"1 s\": is a time; expected a length, e.g. \"1 m\"\n");
    CHECK(report("parts.disk.side=1") ==
          "error: --set parts.disk.side = 1: parts has no entry named \"disk\"; there are \"disc\"\n");
    CHECK(report("parts[2].side=1") ==
          "error: --set parts[2].side = 1: parts has 1 entries; the index must be 0 to 1\n");
    CHECK(report("test[0].side=1") == "error: --set test[0].side = 1: test is a table, not an array\n");
    CHECK(report("simulation.seed.x=1") ==
          "error: --set simulation.seed.x = 1: simulation.seed is an integer, it has no keys\n");
    CHECK(report("control.time_stp=1") ==
          "error: --set control.time_stp = 1: unknown key; did you mean \"time_step\"?\n");
    CHECK(report("parts[0].side=1 mm") ==
          "error: --set parts[0].side = 1 mm: is not a TOML value; texts need quotes: --set 'parts[0].side=\"...\"'\n");
    CHECK(report("simulation.seed=1\nx=2") == "error: --set simulation.seed = 1 x=2: is more than one TOML value\n");
    CHECK(report("materials.glass.density=2500") ==
          "error: --set materials.glass.young_modulus: missing; required: a quantity > 0 Pa such as \"1 Pa\"\n"
          "error: --set materials.glass.poisson_ratio: missing; required: a number > -1 and < 0.5\n");
    for (const char* text : {"=", "=1", "side", "parts[0.side=1", "parts[x].side=1", "parts[].side=1", "a..b=1", ".a=1",
                             "parts[99999999999]=1", "\"a=1", "a b=1", "parts[0]side=1"}) {
        INFO(text);
        CHECK(report(text) == "error: --set " + std::string(text) +
                                  ": is not of the form key.path=value, e.g. parts[0].side=\"1 mm\"\n");
    }
    CHECK(report("") == "error: --set \"\": is not of the form key.path=value, e.g. parts[0].side=\"1 mm\"\n");
    CHECK(report(repeated("", "a.", 100000, "a=1")).starts_with("error: --set a.a.a."));
    CHECK(report(repeated("simulation.seed=", "[", 10000, "")).starts_with("error: --set simulation.seed = [[["));
}

TEST_CASE("files that are none", "[input]")
{
    std::map<std::string, SourcePlace> places;
    const auto report = [&](const std::string& file) {
        try {
            read_case(file, {}, places);
        } catch (const InputError& e) {
            return render_problems(e.problems, places, file);
        }
        return std::string();
    };
    CHECK(report("/no/such/file.toml") == "error: /no/such/file.toml: cannot be opened: No such file or directory\n");
    CHECK(report("/tmp") == "error: /tmp: is a directory; give a TOML file\n");
    CHECK(report("/dev/zero") == "error: /dev/zero: is larger than 4 MiB; not an input file\n");
    CHECK(problems_of("") == "error: FILE: is empty\n");
    CHECK(problems_of(" \n\n") == "error: FILE: is empty\n");
    CHECK(problems_of("# nothing\n").starts_with("error: FILE: parts: missing; required: at least one [[parts]]\n"));
    CHECK(problems_of(repeated("x = ", "[", 10000, "1]")).starts_with("error: FILE:1: "));
    CHECK(problems_of(repeated("x = ", "{a=", 10000, "")).starts_with("error: FILE:1: "));
    CHECK(problems_of(repeated("\n", "a.", 1000000, "a = 1")) == "error: FILE:2: a key has more than 16 parts\n");
    CHECK(problems_of(repeated("[", "a . ", 100000, "a]")) == "error: FILE:1: a key has more than 16 parts\n");
    CHECK(problems_of(repeated("x = \"\"\"a\"b\"\"\"\"\n", "\"a\".", 100000, "a = 1")) ==
          "error: FILE:2: a key has more than 16 parts\n");
    CHECK(problems_of(repeated("\"", ".\\\"", 100000, "\" = 1")) == "error: FILE:1: a key is longer than 200 bytes\n");
    CHECK(problems_of(repeated("x = ", "{a.a.a.a.a.a.a.a.a.a.a.a.a=", 200, repeated("1", "}", 200, "").c_str())) ==
          "error: FILE:1: tables or arrays are nested deeper than 64\n");
    CHECK(problems_of(std::string("a = 1\0b", 7)).starts_with("error: FILE:1: "));
    CHECK(problems_of("\xFF\xFE" + std::string(20, '\0')).starts_with("error: FILE:1: "));
}

TEST_CASE("no piece of a file crashes the reader", "[input]")
{
    const std::string whole = brazilian_input;
    for (std::size_t n = 0; n < whole.size(); n += 3) {
        problems_of(whole.substr(0, n));
        problems_of(whole.substr(n));
    }
    std::mt19937 random(1);
    for (int k = 0; k < 300; ++k) {
        std::string text = k % 3 == 0 ? std::string(200, ' ') : whole;
        for (int i = 0; i < 1 + k / 10; ++i)
            text[random() % text.size()] = static_cast<char>(random() % (k % 3 == 0 ? 256 : 128));
        problems_of(text);
    }
    SUCCEED();
}

TEST_CASE("messages are one printable line each", "[input]")
{
    const std::string report = problems_of(
        replaced(brazilian_input, "\"0.6 mm\"", repeated("[\n  \"\\u001b[31m\", # \xC2\xB5\n  ", "1, ", 100, "]")));
    CHECK(report.find('\x1b') == report.npos);
    CHECK(std::count(report.begin(), report.end(), '\n') == 1);
    CHECK(report.size() < 250);
    const std::string key = problems_of(replaced(brazilian_input, "seed = 7", "\"\\u001b\\n\" = 7"));
    CHECK(key.find('\x1b') == key.npos);
    CHECK(std::count(key.begin(), key.end(), '\n') == 1);
}
