// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainfrac {

namespace {

/// A sphere is some kB of state with its bonds and contacts; a slip of the unit in `diameter` is far beyond this.
constexpr double most_spheres = 2e7;

/// Layers at a distance that fit into a length; each stands for one distance.
int layers(double length, double distance)
{
    return static_cast<int>(std::lround(length / distance));
}

/// The density of the lattice times the volume; of a region thinner than a sphere, what its length holds.
double most_sites(const SphereRegion& region, double d)
{
    return std::max(region.volume() * std::numbers::sqrt2 / (d * d * d), 2.0 * norm(region.half) / d);
}

[[noreturn]] void none_fits(const SphereRegion& region, double d)
{
    throw InputError("diameter", fmt::format("no sphere fits: {:.6g} m against {:.6g} m, the smallest length of the "
                                             "region",
                                             d, region.thinnest()));
}

}  // namespace

void check_count(const char* key, double spheres)
{
    if (spheres > most_spheres) {
        throw InputError(key, fmt::format("makes {:.2g} spheres; at most {:.2g} are possible", spheres, most_spheres));
    }
}

std::vector<Vec3> hcp_sites(const SphereRegion& region, double d, int axis, bool channel)
{
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;  // along the rows, across them
    const double h = std::sqrt(2.0 / 3.0) * d, row = std::sqrt(0.75) * d, hollow = d / std::sqrt(3.0);
    check_count("diameter", most_sites(region, d));
    const int levels = layers(2.0 * region.half[axis], h);
    if (levels < 1 || layers(2.0 * region.half[u], d) < 1 || layers(2.0 * region.half[v], row) < 1)
        none_fits(region, d);
    const int rows = static_cast<int>(region.half[v] / row) + 2, places = static_cast<int>(region.half[u] / d) + 2;
    std::vector<Vec3> sites;
    for (int k = 0; k < levels; ++k) {
        for (int j = -rows; j <= rows; ++j) {
            for (int i = -places; i <= places; ++i) {
                Vec3 x = region.center;
                x[u] += d * (i + (j % 2 == 0 ? 0.0 : 0.5));
                x[v] += row * j + (k % 2 == 0 ? 0.0 : hollow) + (channel ? hollow : 0.0);
                x[axis] += h * (k - 0.5 * (levels - 1));
                if (region.contains(x)) sites.push_back(x);
            }
        }
    }
    return sites;
}

std::vector<Vec3> fcc_sites(const SphereRegion& region, double d)
{
    const double step = d / std::numbers::sqrt2;  // half a cube's edge: sites where i + j + k is even
    check_count("diameter", most_sites(region, d));
    if (layers(region.thinnest(), step) < 1) none_fits(region, d);
    const auto reach = [&](int axis) { return static_cast<int>(region.half[axis] / step) + 1; };
    std::vector<Vec3> sites;
    for (int k = -reach(2); k <= reach(2); ++k) {
        for (int j = -reach(1); j <= reach(1); ++j) {
            for (int i = -reach(0); i <= reach(0); ++i) {
                const Vec3 x = region.center + step * Vec3{1.0 * i, 1.0 * j, 1.0 * k};
                if ((i + j + k) % 2 == 0 && region.contains(x)) sites.push_back(x);
            }
        }
    }
    return sites;
}

}  // namespace grainfrac
