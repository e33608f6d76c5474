// SPDX-License-Identifier: GPL-3.0-or-later
// Wrong input files by the hundred: `check` says what is wrong with exit code 2, or takes them; nothing else.
#include "support/mutated_text.h"
#include "support/workplace.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <map>
#include <vector>

using namespace grainfrac::test;
namespace fs = std::filesystem;

namespace {

// Of `check`, which a file that asks for many grains may take longer for; the sanitizers too.
#if defined(__SANITIZE_ADDRESS__)
constexpr int most_seconds = 60;
#else
constexpr int most_seconds = 5;
#endif

constexpr int killed = 128 + 9;

int number_from(const char* variable, int otherwise)
{
    const char* text = std::getenv(variable);
    return text ? std::atoi(text) : otherwise;
}

/// Examples that are small enough to be built in a moment, without the files that they need.
std::vector<fs::path> originals()
{
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(GF_SOURCE_DIR) / "examples")) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() == ".toml" && name != "sphere_on_plane" && name != "brazilian_fine")
            files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

// More of them: GF_MUTATIONS=2000 GF_FIRST_MUTATION=1 test_regression "mutated*"; those that fail are kept in
// GF_MUTATION_FOLDER. With another build of the program: GF_OTHER_PROGRAM, GF_MUTATION_SECONDS.
TEST_CASE("mutated inputs are refused with a message or checked, and nothing else", "[slow]")
{
    const Workplace w;
    const std::vector<fs::path> files = originals();
    REQUIRE(files.size() > 15);
    const int first = number_from("GF_FIRST_MUTATION", 1), count = number_from("GF_MUTATIONS", 100);
    std::map<int, int> codes;
    int large = 0;
    double slowest = 0.0;
    for (int k = first; k < first + count; ++k) {
        const fs::path& file = files[static_cast<std::size_t>(k) % files.size()];
        const std::string text = Mutation(static_cast<std::uint64_t>(k))(text_of(file));
        std::ofstream(w.folder / "input.toml", std::ios::binary) << text;
        const auto before = std::chrono::steady_clock::now();
        const Outcome o = w.run("check input.toml --threads 1",
                                "timeout -s KILL " + std::to_string(number_from("GF_MUTATION_SECONDS", most_seconds)));
        if (o.code != killed)
            slowest =
                std::max(slowest, std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count());
        if (o.code == killed && o.err.starts_with("building about ")) {  // a valid input that is large
            ++large;
            continue;
        }
        ++codes[o.code];
        const bool no_memory = o.code == 1 && o.err.find("GB of memory") != o.err.npos;
        const bool good = (o.code == 0 || (o.code == 2 && o.err.find("error: ") != o.err.npos) || no_memory) &&
                          o.err.find("Sanitizer") == o.err.npos && o.err.find("runtime error") == o.err.npos;
        if (!good) {
            if (const char* kept = std::getenv("GF_MUTATION_FOLDER"))
                fs::copy_file(w.folder / "input.toml", fs::path(kept) / (std::to_string(k) + ".toml"),
                              fs::copy_options::overwrite_existing);
        }
        INFO("mutation " << k << " of " << file << ", exit code " << o.code << '\n' << o.err);
        CHECK(good);
    }
    std::string tally;
    for (const auto& [code, number] : codes)
        tally += std::to_string(number) + " with exit code " + std::to_string(code) + ", ";
    WARN(tally << large << " too large to wait for, slowest " << slowest << " s");
    CHECK(codes[0] > 0);
    CHECK(codes[2] > count / 3);
}
