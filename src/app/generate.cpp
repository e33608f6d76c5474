// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/prepare.h"
#include "experiment/resources.h"
#include "generate/microstructure.h"
#include "generate/packings.h"
#include "generate/sphere_file.h"
#include "generate/sphere_region.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <numbers>

namespace grainfrac {

namespace {

bool has_kind(const Case& c, const char* kind)
{
    return std::any_of(c.parts.begin(), c.parts.end(), [&](const PartSpec& p) { return p.kind == kind; });
}

/// The endings tell a reader what is in a file.
void check_ending(const Options& o, const char* extension, bool both)
{
    const std::string found = std::filesystem::path(o.out).extension().string();
    const bool common = both && (found.empty() || found == ".json" || found == ".csv");
    if (o.out.empty() || common || found == extension) return;
    const std::string allowed = both ? "without an ending (grains go into .json, spheres into .csv)"
                                     : fmt::format("with the ending {}", extension);
    throw InputError("--out", fmt::format("\"{}\": give a name {}", o.out, allowed));
}

/// Grains and spheres go into two files; where a case has both, --out names what is common to them.
std::filesystem::path out_file(const Options& o, const char* ending, const char* extension, bool both)
{
    check_ending(o, extension, both);
    std::filesystem::path out = o.out;
    if (o.out.empty()) out = std::filesystem::path(o.file).stem().string() + ending;
    if (!o.out.empty() && both) out.replace_extension(extension);
    if (std::filesystem::exists(out) && !o.force) {
        throw InputError("--out", fmt::format("\"{}\" exists; give another name or --force", out.string()));
    }
    return out;
}

/// What random packings reached; less where a fibre took spheres away.
void print_solid_fractions(const Case& c, const std::vector<SphereSpec>& spheres)
{
    for (std::size_t k = 0; k < c.parts.size(); ++k) {
        if (c.parts[k].generator != "random_dense") continue;
        double volume = 0.0;
        int count = 0;
        for (const SphereSpec& s : spheres) {
            if (s.group != static_cast<std::int32_t>(k)) continue;
            volume += 4.0 / 3.0 * std::numbers::pi * s.radius * s.radius * s.radius;
            ++count;
        }
        fmt::print("{}: {} spheres, solid fraction {:.4f}\n", c.parts[k].name, count,
                   volume / SphereRegion(c.parts[k].region).volume());
    }
}

template <class Make>
auto made(const Case& c, const Make& make)
{
    try {
        check_resources(c);
        return make(c);
    } catch (const InputError& e) {
        report(e, c);
        throw ReportedInputError{};
    }
}

}  // namespace

int generate_command(const Options& o)
{
    const Case c = load_case(o);
    const bool grains = has_kind(c, "grains"), spheres = has_kind(c, "spheres");
    const std::filesystem::path grain_file =
        grains ? out_file(o, ".microstructure.json", ".json", spheres) : std::filesystem::path();
    const std::filesystem::path sphere_file =
        spheres ? out_file(o, ".spheres.csv", ".csv", grains) : std::filesystem::path();
    if (grains) {
        const std::vector<GrainSpec> all = made(c, generate_grains);
        write_microstructure(grain_file, all, c.simulation.title);
        if (!o.quiet) fmt::print("{} grains -> {}\n", all.size(), grain_file.string());
    }
    if (spheres) {
        const std::vector<SphereSpec> all = made(c, generate_spheres);
        write_spheres(sphere_file, all, c.parts);
        if (!o.quiet) {
            fmt::print("{} spheres -> {}\n", all.size(), sphere_file.string());
            print_solid_fractions(c, all);
        }
    }
    return exit_code::done;
}

}  // namespace grainfrac
