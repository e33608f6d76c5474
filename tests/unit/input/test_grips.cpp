// SPDX-License-Identifier: GPL-3.0-or-later
// [[grips]] and `release`: what is said about wrong ones.
#include "input_files.h"

#include <catch2/catch.hpp>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

const std::string grip_input = R"([materials.steel]
density = 7800
young_modulus = "1 GPa"
poisson_ratio = 0.2

[[parts]]
name = "rope"
kind = "spheres"
material = "steel"
generator = "chain"
diameter = "2 m"
fibre = { from = [0, 0, 0], to = [98, 0, 0] }

[[grips]]
name = "left"
part = "rope"
at = "first"
hold = ["x", "y", "z"]

[[grips]]
name = "right"
part = "rope"
region = { shape = "box", center = [98, 0, 0], size = [1, 1, 1] }

[[stages]]
name = "pull"
move = [{ wall = "right", velocity = [1, 0, 0] }]
duration = 1

[[stages]]
name = "free"
release = ["left"]
duration = 1
)";

struct Wrong {
    std::string from, to, report;
};

const Wrong wrong_grips[] = {
    {"at = \"first\"\n", "", "error: FILE:14: grips[0].region: missing; required with no `at`: a table\n"},
    {"at = \"first\"", "at = \"frist\"",
     "error: FILE:17: grips[0].at = \"frist\": must be one of \"first\", \"last\"; did you mean \"first\"?\n"},
    {"at = \"first\"", "at = \"first\"\nregion = { shape = \"box\", size = [1, 1, 1] }",
     "error: FILE:18: grips[0].region = { shape = \"box\", size = [1, 1, 1] }: give either at or region, not both\n"},
    {"part = \"rope\"\nat", "part = \"rop\"\nat",
     "error: FILE:16: grips[0].part = \"rop\": no such part; there are \"rope\"; did you mean \"rope\"?\n"},
    {"\"x\", \"y\", \"z\"", "\"x\", \"w\"",
     "error: FILE:18: grips[0].hold[1] = \"w\": must be one of \"x\", \"y\", \"z\", \"rotation\"\n"},
    {"\"x\", \"y\", \"z\"", "\"x\", \"x\"",
     "error: FILE:18: grips[0].hold = [\"x\", \"x\"]: names one of them twice\n"},
    {"\"x\", \"y\", \"z\"", "",
     "error: FILE:18: grips[0].hold = []: is empty; must be an array of texts, each one of \"x\", \"y\", \"z\", "
     "\"rotation\"\n"},
    {"name = \"left\"", "name = \"rope\"",
     "error: FILE:15: grips[0].name = \"rope\": a part of this name exists already; parts, materials and walls need "
     "different names\n"
     "error: FILE:32: stages[1].release[0] = \"left\": no such grip; there are \"rope\", \"right\"\n"},
    {"velocity = [1, 0, 0]", "servo = { force = 1, direction = [1, 0, 0] }",
     "error: FILE:27: stages[0].move[0].servo = { force = 1, direction = [1, 0, 0] }: a grip has no servo; give its "
     "velocity\n"},
    {"release = [\"left\"]", "release = [\"lift\"]",
     "error: FILE:32: stages[1].release[0] = \"lift\": no such grip; there are \"left\", \"right\"; did you mean "
     "\"left\"?\n"},
    {"release = [\"left\"]", "release = [\"left\", \"left\"]",
     "error: FILE:32: stages[1].release[1] = \"left\": this grip has let go already\n"},
    {"release = [\"left\"]", "release = [\"right\"]\nmove = [{ wall = \"right\", velocity = [1, 0, 0] }]",
     "error: FILE:32: stages[1].release[0] = \"right\": this grip is moved in this stage; it cannot let go too\n"},
};

}  // namespace

TEST_CASE("grips: all is well with the input that the wrong ones are made from")
{
    CHECK(problems_of(grip_input) == "");
}

TEST_CASE("grips: one message for each wrong key")
{
    for (const Wrong& w : wrong_grips) {
        std::string text = grip_input;
        const std::size_t at = text.find(w.from);
        REQUIRE(at != text.npos);
        text.replace(at, w.from.size(), w.to);
        CHECK(problems_of(text) == w.report);
    }
}
