// SPDX-License-Identifier: GPL-3.0-or-later
// Files of grains that cannot be.
#include "generate/microstructure.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <stdexcept>

using namespace grainfrac;
using Catch::Matchers::Contains;

namespace {

/// A cube, with other faces.
std::string with_faces(const std::string& faces)
{
    return "{\"format\": \"grainfrac microstructure 1\", \"grains\": [{\"vertices\": [[0,0,0],[0,0,1],[0,1,0],[0,1,1],"
           "[1,0,0],[1,0,1],[1,1,0],[1,1,1]], \"faces\": [" +
           faces + "], \"site\": [0.5,0.5,0.5], \"crystal\": [1,0,0,0], \"dilation_radius\": 0.02}]}";
}

std::vector<GrainSpec> read(const std::string& text)
{
    std::string name = (std::filesystem::temp_directory_path() / "grainfrac_grains_XXXXXX").string();
    const int descriptor = mkstemp(name.data());
    REQUIRE(descriptor >= 0);
    std::ofstream(name) << text;
    struct Removed {
        std::string name;
        ~Removed() { std::filesystem::remove(name); }
    } const removed{name};
    return read_microstructure(name);
}

}  // namespace

TEST_CASE("indices of a grain's faces are whole numbers of its vertices", "[microstructure]")
{
    const std::string others = ",[4,6,7,5],[0,4,5,1],[2,3,7,6],[0,2,6,4],[1,5,7,3]";
    CHECK(read(with_faces("[0,1,3,2]" + others)).size() == 1);
    for (const char* face : {"[0,1,3,1e30]", "[0,1,3,-1]", "[0,1,3,8]", "[0,1,3,2.5]", "[0,1,3,18446744073709551615]",
                             "[0,1,3,\"2\"]", "[0,1,3,null]"}) {
        INFO(face);
        CHECK_THROWS_WITH(read(with_faces(face + others)), Contains("grain 0") && Contains("0 to 7"));
    }
}

TEST_CASE("files that are nested without end or hold nothing are refused", "[microstructure]")
{
    const std::size_t depth = 200000;
    CHECK_THROWS_AS(read(std::string(depth, '[')), std::runtime_error);
    CHECK_THROWS_AS(read(std::string(depth, '[') + std::string(depth, ']')), std::runtime_error);
    CHECK_THROWS_AS(read(""), std::runtime_error);
    CHECK_THROWS_AS(read("null"), std::runtime_error);
    CHECK_THROWS_AS(read("{\"format\": \"grainfrac microstructure 1\", \"grains\": {}}"), std::runtime_error);
}
