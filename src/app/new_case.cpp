// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/options.h"
#include "io/atomic_file.h"
#include "io/input.h"

#include <fmt/format.h>

#include <filesystem>

namespace grainfrac {

int new_command(const Options& o, const std::string& kind)
{
    const std::filesystem::path out = o.out.empty() ? kind + ".toml" : o.out;
    std::error_code unknown;
    if (std::filesystem::exists(std::filesystem::symlink_status(out, unknown)) && !o.force)
        throw InputError("--out", fmt::format("\"{}\" exists; give another name or --force", out.string()));
    write_file(out, new_case(kind));
    if (!o.quiet)
        fmt::print("{}; run it with: grainfrac {} {}\n", out.string(), kind == "calibrate" ? kind : "run",
                   out.string());
    return exit_code::done;
}

}  // namespace grainfrac
