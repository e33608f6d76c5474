// SPDX-License-Identifier: GPL-3.0-or-later
// What a library does to a damaged file stays in the process that reads it.
#include "io/hdf5_file.h"
#include "io/isolated_read.h"

#include <catch2/catch.hpp>

#include <csignal>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <sys/mman.h>

using namespace grainfrac;
using Catch::Matchers::Contains;

namespace {

std::vector<Ball> two_balls(const std::filesystem::path&)
{
    return {{{0.1, 0.2, 0.3}, 0.5}, {{1.0, 2.0, 3.0}, 0.25}};
}
std::vector<Ball> none(const std::filesystem::path&)
{
    return {};
}
std::vector<Ball> refuses(const std::filesystem::path& file)
{
    throw std::runtime_error(file.string() + ": of another kind");
}
std::vector<Ball> crashes(const std::filesystem::path&)
{
    std::raise(SIGSEGV);
    return {};
}
std::vector<Ball> gives_up(const std::filesystem::path&)
{
    std::_Exit(3);
}
std::vector<Ball> takes_some_memory(const std::filesystem::path&)
{
    return {std::vector<Ball>(1 << 20).back()};
}
std::vector<Ball> needs_all_memory(const std::filesystem::path&)
{
    throw std::bad_alloc();
}

}  // namespace

TEST_CASE("a reader in a process of its own gives the same spheres", "[output]")
{
    const std::vector<Ball> balls = read_isolated(two_balls, "file");
    REQUIRE(balls.size() == 2);
    CHECK(balls[0].center == Vec3{0.1, 0.2, 0.3});
    CHECK(balls[1].radius == 0.25);
    CHECK(read_isolated(none, "file").empty());
}

TEST_CASE("whatever a reader does to its process ends as a message", "[output]")
{
    CHECK_THROWS_WITH(read_isolated(refuses, "file"), "file: of another kind");
    CHECK_THROWS_WITH(read_isolated(crashes, "file"), Contains("\"file\"") && Contains("crashed"));
    CHECK_THROWS_WITH(read_isolated(gives_up, "file"), Contains("crashed"));
    CHECK_THROWS_WITH(read_isolated(needs_all_memory, "file"), Contains("memory"));
}

TEST_CASE("what the program holds already is not taken from what a reader may have", "[output]")
{
    const std::size_t held = std::size_t{3} << 30;  // more than the limit of a small file; never touched
    void* const memory =
        mmap(nullptr, held, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    REQUIRE(memory != MAP_FAILED);
    CHECK(read_isolated(takes_some_memory, "file").size() == 1);
    munmap(memory, held);
}

TEST_CASE("an attribute of several values is not read into the place of one", "[output]")
{
    std::string name = (std::filesystem::temp_directory_path() / "grainfrac_attribute_XXXXXX").string();
    const int descriptor = mkstemp(name.data());
    REQUIRE(descriptor >= 0);
    {
        const Hdf5Id file(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
        const hsize_t many = 1000;
        const Hdf5Id space(H5Screate_simple(1, &many, nullptr), H5Sclose);
        const Hdf5Id attribute(H5Acreate2(file.get(), "schema", H5T_STD_I64LE, space.get(), H5P_DEFAULT, H5P_DEFAULT),
                               H5Aclose);
        const std::vector<std::int64_t> values(many, 1);
        REQUIRE(H5Awrite(attribute.get(), H5T_NATIVE_INT64, values.data()) >= 0);
    }
    {
        const Hdf5File file = Hdf5File::open(name);
        CHECK_THROWS_AS(file.attribute<std::int64_t>("/", "schema"), std::runtime_error);
    }
    std::filesystem::remove(name);
}
