// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/prepare.h"
#include "generate/microstructure.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

namespace grainfrac {

int generate_command(const Options& o)
{
    const Case c = load_case(o);
    const std::filesystem::path out =
        o.out.empty() ? std::filesystem::path(o.file).stem().string() + ".microstructure.json" : o.out;
    if (std::filesystem::exists(out) && !o.force) {
        throw InputError("--out", fmt::format("\"{}\" exists; give another name or --force", out.string()));
    }
    std::vector<GrainSpec> grains;
    try {
        grains = generate_grains(c);
    } catch (const InputError& e) {
        report(e, c);
        throw ReportedInputError{};
    }
    write_microstructure(out, grains, c.simulation.title);
    if (!o.quiet) fmt::print("{} grains -> {}\n", grains.size(), out.string());
    return exit_code::done;
}

}  // namespace grainfrac
