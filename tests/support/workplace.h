// SPDX-License-Identifier: GPL-3.0-or-later
// The program run in a folder of its own.
#pragma once

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/wait.h>

namespace grainfrac::test {

struct Outcome {
    int code = 0;
    std::string out, err;
};

inline std::string text_of(const std::filesystem::path& file)
{
    std::ifstream in(file);
    std::ostringstream s;
    s << in.rdbuf();
    return s.str();
}

/// The one that was built with the tests, or another build of it.
inline std::string program_under_test()
{
    const char* other = std::getenv("GF_OTHER_PROGRAM");
    return other ? other : GF_PROGRAM;
}

/// A folder of its own for each case, removed at the end.
struct Workplace {
    std::filesystem::path folder;
    Workplace()
    {
        std::string name = (std::filesystem::temp_directory_path() / "grainfrac_test_XXXXXX").string();
        REQUIRE(mkdtemp(name.data()) != nullptr);
        folder = name;
    }
    ~Workplace() { std::filesystem::remove_all(folder); }
    /// `under`: a command that runs the program, such as timeout.
    Outcome run(const std::string& arguments, const std::string& under = "") const
    {
        const std::string command = "cd '" + folder.string() + "' && " + under + " '" + program_under_test() + "' " +
                                    arguments + " > out.txt 2> err.txt < /dev/null";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text_of(folder / "out.txt"),
                text_of(folder / "err.txt")};
    }
    nlohmann::json summary(const std::string& result) const
    {
        return nlohmann::json::parse(text_of(folder / result / "summary.json"));
    }
};

}  // namespace grainfrac::test
