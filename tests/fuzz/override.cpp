// SPDX-License-Identifier: GPL-3.0-or-later
// --set: each line an override of the same small input.
#include "io/input.h"

#include <cstdint>
#include <cstdlib>
#include <sstream>

using namespace grainfrac;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const std::string text = new_case("brazilian");
    std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
    std::vector<std::string> overrides;
    for (std::string line; overrides.size() < 8 && std::getline(lines, line);) overrides.push_back(line);
    std::map<std::string, SourcePlace> places;
    try {
        read_case_text(text, "FILE", overrides, places);
    } catch (const InputError& e) {
        if (e.problems.empty() || render_problems(e.problems, places, "FILE").empty()) std::abort();
    }
    return 0;
}
