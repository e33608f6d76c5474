// SPDX-License-Identifier: GPL-3.0-or-later
// TOML input: any text is a case or an InputError, and a case written as resolved.toml reads back as itself.
#include "io/input.h"

#include <cstdint>
#include <cstdlib>

using namespace grainfrac;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string text(reinterpret_cast<const char*>(data), size);
    std::map<std::string, SourcePlace> places;
    try {
        const std::string resolved = to_toml(read_case_text(text, "FILE", {}, places));
        if (to_toml(read_case_text(resolved, "RESOLVED", {}, places)) != resolved) std::abort();
    } catch (const InputError& e) {
        if (e.problems.empty() || render_problems(e.problems, places, "FILE").empty()) std::abort();
    }
    return 0;
}
