// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment/resources.h"

#include "generate/sphere_region.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>
#include <string>

namespace grainfrac {

namespace {

// Measured: a block of 4,913 grains with 18 points a face, a cylinder of 50,578 spheres with six bonds each; twice the
// state, which a run holds when it writes or checks. Of unequal spheres no two bonds are of one kind: 1 kB more.
constexpr double bytes_a_grain = 20e3, bytes_a_sphere = 7e3;
/// Interface points and slots are counted in 32 bits; a grain of a lattice has ten faces of 16 points, halved.
constexpr double most_bodies = 2e7;

double chain_length(const FibreSpec& f)
{
    double length = norm(f.to - f.from);
    if (f.shape == "wavy") {  // not longer than this
        const double slope = 2.0 * std::numbers::pi * f.amplitude / f.wavelength;
        return length * std::sqrt(1.0 + slope * slope);
    }
    if (f.shape == "hooked") return length + 2.0 * f.hook_length;
    if (f.shape != "points") return length;
    length = 0.0;
    for (std::size_t i = 1; i < f.points.size(); ++i) length += norm(f.points[i] - f.points[i - 1]);
    return length;
}

/// Cells of a lattice of prisms along z.
double prisms(const PartSpec& p)
{
    const SphereRegion region(p.region);
    const bool upright = region.shape == SphereRegion::Shape::cylinder && region.axis == 2;
    const double area =
        upright ? std::numbers::pi * region.radius * region.radius : 4.0 * region.half.x * region.half.y;
    const double hexagon = 1.5 * std::numbers::sqrt3 * p.side * p.side;
    return (area / hexagon + 1.0) * std::max(std::round(2.0 * region.half.z / p.thickness), 1.0);
}

/// Balls or grains of a file, not fewer than there are by much: 40 bytes of text or of packed numbers are a ball, a
/// grain with its vertices and faces takes this many.
double bodies_in(const std::filesystem::path& file, bool spheres)
{
    constexpr double bytes_of_ball = 40.0, bytes_of_grain = 2000.0;
    std::error_code unknown;  // that it is not there is told by its reader
    const std::uintmax_t bytes = std::filesystem::file_size(file, unknown);
    return unknown ? 0.0 : static_cast<double>(bytes) / (spheres ? bytes_of_ball : bytes_of_grain);
}

/// Of a file with lines "NAME NUMBER ..."; 0 if there is none of this name.
double value_in(const std::string& file, const std::string& wanted)
{
    std::ifstream in(file);
    double value = 0.0;
    for (std::string name, rest; in >> name >> value; std::getline(in, rest)) {
        if (name == wanted) return value;
    }
    return 0.0;
}

double first_number(const std::filesystem::path& file, double missing)
{
    double value = missing;  // "max": no limit
    std::ifstream in(file);
    return in >> value ? value : missing;
}

/// What a control group and those above it leave.
double room_of_groups(const std::filesystem::path& root, std::filesystem::path group, const char* limit,
                      const char* used, const char* cached)
{
    double room = INFINITY;
    for (group = group.relative_path();; group = group.parent_path()) {
        const std::filesystem::path folder = root / group;
        const double most = first_number(folder / limit, INFINITY), taken = first_number(folder / used, 0.0);
        const double cache = value_in((folder / "memory.stat").string(), cached);  // given back when it is needed
        room = std::min(room, std::max(most - taken + cache, 0.0));
        if (group.empty()) return room;
    }
}

}  // namespace

double room_of_own_group(const std::filesystem::path& list, const std::filesystem::path& mounted)
{
    double room = INFINITY;
    std::ifstream in(list);
    for (std::string line; std::getline(in, line);) {  // "NUMBER:CONTROLLERS:PATH", version 2 without controllers
        const auto first = line.find(':'), second = line.find(':', first + 1);
        if (second == line.npos) continue;
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
        const std::string path = line.substr(second + 1);
        if (controllers == ",,")
            room = std::min(room, room_of_groups(mounted, path, "memory.max", "memory.current", "file"));
        if (controllers.find(",memory,") != controllers.npos)
            room = std::min(room, room_of_groups(mounted / "memory", path, "memory.limit_in_bytes",
                                                 "memory.usage_in_bytes", "total_cache"));
    }
    return room;
}

double expected_bodies(const PartSpec& p, const std::filesystem::path& folder)
{
    const double d3 = p.diameter * p.diameter * p.diameter;
    if (p.generator == "hexagonal_prisms") return prisms(p);
    if (p.generator == "hcp" || p.generator == "fcc") return SphereRegion(p.region).volume() * std::numbers::sqrt2 / d3;
    if (p.generator == "random_dense")
        return p.solid_fraction * SphereRegion(p.region).volume() / (std::numbers::pi / 6.0 * d3);
    if (p.generator == "chain") {
        const double spacing = p.fibre.spacing.value_or(p.diameter);
        return (chain_length(p.fibre) / spacing + 1.0) * static_cast<double>(p.copies.size() + 1);
    }
    if (p.generator == "file") return bodies_in(folder / p.file, p.kind == "spheres");
    return 0.0;
}

double expected_bodies(const Case& c)
{
    double bodies = 0.0;
    for (const PartSpec& p : c.parts) bodies += expected_bodies(p, std::filesystem::path(c.file).parent_path());
    return bodies;
}

double expected_memory(const Case& c)
{
    double bytes = 0.0;
    for (const PartSpec& p : c.parts)
        bytes += expected_bodies(p, std::filesystem::path(c.file).parent_path()) *
                 (p.kind == "spheres" ? bytes_a_sphere : bytes_a_grain);
    return bytes;
}

double available_memory()
{
    double available = INFINITY;
    if (const double kilobytes = value_in("/proc/meminfo", "MemAvailable:"); kilobytes > 0.0)
        available = 1024.0 * kilobytes;
    return std::min(available, room_of_own_group("/proc/self/cgroup", "/sys/fs/cgroup"));
}

void check_resources(const Case& c)
{
    for (std::size_t k = 0; k < c.parts.size(); ++k) {
        const double n = expected_bodies(c.parts[k], std::filesystem::path(c.file).parent_path());
        if (n <= most_bodies) continue;
        if (std::isnan(n))
            throw InputError(fmt::format("parts[{}]", k),
                             "its lengths are so far apart, or so small, that no number tells "
                             "how many bodies it has");
        const char* what = c.parts[k].kind == "spheres" ? "spheres" : "grains";
        throw InputError(fmt::format("parts[{}]", k),
                         fmt::format("about {:.2g} {}; must be <= {:.0e}: make them larger or the region smaller", n,
                                     what, most_bodies));
    }
    const double needed = expected_memory(c), available = available_memory();
    if (needed <= available) return;
    throw std::runtime_error(fmt::format(
        "about {:.2g} grains and spheres need {:.3g} GB of memory, {:.3g} GB are free; make them larger or the "
        "regions smaller",
        expected_bodies(c), 1e-9 * needed, 1e-9 * available));
}

}  // namespace grainfrac
