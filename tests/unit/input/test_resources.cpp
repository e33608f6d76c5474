// SPDX-License-Identifier: GPL-3.0-or-later
// The size of a model is known before it is made.
#include "experiment/experiment.h"
#include "experiment/resources.h"
#include "generate/microstructure.h"
#include "generate/packings.h"
#include "input_files.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

using namespace grainfrac;
using namespace grainfrac::test;

TEST_CASE("the expected number of bodies is about that of the model", "[input]")
{
    for (const std::string& kind : new_case_kinds()) {
        INFO(kind);
        const Case c = read_text(new_case(kind));
        const double expected = expected_bodies(c);
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

TEST_CASE("the memory that control groups leave is that of the tightest one", "[input]")
{
    namespace fs = std::filesystem;
    std::string name = (fs::temp_directory_path() / "grainfrac_test_XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    const fs::path place = name;
    const auto put = [&](const fs::path& file, const std::string& text) {
        fs::create_directories((place / file).parent_path());
        std::ofstream(place / file) << text << '\n';
    };
    const auto room = [&](const std::string& list) {
        put("cgroup", list);
        return room_of_own_group(place / "cgroup", place / "fs");
    };
    CHECK(room_of_own_group(place / "none", place) == INFINITY);
    CHECK(room("0::/job/step") == INFINITY);  // no files: no limit known
    put("fs/job/memory.max", "1000000");
    put("fs/job/memory.current", "400000");
    put("fs/job/memory.stat", "anon 300000\nfile 100000");
    put("fs/job/step/memory.max", "max");
    put("fs/job/step/memory.current", "100");
    CHECK(room("0::/job/step") == 700000.0);  // limit of the group above, its cache can be given back
    put("fs/job/step/memory.max", "600");
    CHECK(room("0::/job/step") == 500.0);
    CHECK(room("0::/") == INFINITY);
    put("fs/memory/slurm/memory.limit_in_bytes", "5000");
    put("fs/memory/slurm/memory.usage_in_bytes", "6000");
    put("fs/memory/slurm/memory.stat", "total_cache 3000");
    CHECK(room("7:cpu,memory:/slurm\n3:cpuset:/job") == 2000.0);
    fs::remove_all(place);
}

TEST_CASE("a part from a file counts by the size of the file", "[input]")
{
    namespace fs = std::filesystem;
    const fs::path file = fs::temp_directory_path() / "grainfrac_test_many_spheres.csv";
    std::ofstream(file) << "x,y,z,radius\n";
    fs::resize_file(file, std::uintmax_t{8} << 30);  // a hole: it takes no room
    PartSpec p;
    p.kind = "spheres";
    p.generator = "file";
    p.file = file.filename().string();
    CHECK(expected_bodies(p, file.parent_path()) > 1e8);
    CHECK(expected_bodies(p, file.parent_path() / "nowhere") == 0.0);
    fs::remove(file);
}
