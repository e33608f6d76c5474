// SPDX-License-Identifier: GPL-3.0-or-later
// The size of a model is known before it is made.
#include "experiment/experiment.h"
#include "experiment/resources.h"
#include "generate/microstructure.h"
#include "generate/packings.h"
#include "input_files.h"

#include <catch2/catch.hpp>

using namespace grainfrac;
using namespace grainfrac::test;

TEST_CASE("the expected number of bodies is about that of the model", "[input]")
{
    for (const std::string& kind : new_case_kinds()) {
        INFO(kind);
        const Case c = read_text(new_case(kind));
        double expected = 0.0;
        for (const PartSpec& p : c.parts) expected += expected_bodies(p);
        const double found = static_cast<double>(generate_grains(c).size() + generate_spheres(c).size());
        CHECK(expected > 0.7 * found);  // cut cells at the rim
        CHECK(expected < 1.5 * found);
    }
}

TEST_CASE("models beyond indices or memory are refused before anything is made", "[input]")
{
    const auto built = [](const std::string& kind, const std::string& set) {
        return build(read_text(new_case(kind), {set}), Device::cpu);
    };
    const char* const too_many[][2] = {{"brazilian", "parts[0].side=\"1 nm\""},
                                       {"brazilian", "parts[0].thickness=\"1e-300 m\""},
                                       {"brazilian", "parts[0].region.diameter=\"1e200 m\""},
                                       {"pull_out", "parts[0].diameter=\"1 um\""},
                                       {"pull_out", "parts[1].fibre.spacing=\"1e-12 m\""},
                                       {"pull_out", "parts[0].region.height=\"1e300 m\""}};
    for (const auto& [kind, set] : too_many) {
        INFO(set);
        CHECK_THROWS_AS(built(kind, set), InputError);
    }
    // 5.8e6 grains need 116 GB
    const std::string large = "parts[0].region={shape=\"disc\",diameter=\"3.5 m\",height=\"5 mm\"}";
    if (available_memory() < 100e9) CHECK_THROWS_WITH(built("brazilian", large), Catch::Contains("GB of memory"));
    CHECK(available_memory() > 1e6);
}
