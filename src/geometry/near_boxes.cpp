// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/near_boxes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace grainfrac {

namespace {

/// A body this many times wider than the median is no cell-list member: it is tested against all boxes (platens).
constexpr double large_body = 4.0;
/// Cells beyond it are not told apart: nothing sound is there.
constexpr double farthest_cell = 1e15;

bool overlap(const Box& a, const Box& b)
{
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
           a.low.z <= b.high.z && b.low.z <= a.high.z;
}

double width(const Box& b)
{
    return std::max({b.high.x - b.low.x, b.high.y - b.low.y, b.high.z - b.low.z});
}

}  // namespace

std::vector<std::pair<int, int>> overlapping_boxes(const std::vector<Box>& boxes)
{
    const int n = static_cast<int>(boxes.size());
    std::vector<std::pair<int, int>> pairs;
    if (n < 2) return pairs;
    std::vector<double> widths;
    for (const Box& b : boxes) widths.push_back(width(b));
    std::vector<double> sorted = widths;
    std::nth_element(sorted.begin(), sorted.begin() + n / 2, sorted.end());
    const double limit = large_body * sorted[static_cast<std::size_t>(n / 2)];
    Vec3 cell;  // as wide as the widest along each axis: columns of grains are long along one only
    for (int i = 0; i < n; ++i) {
        const Box& b = boxes[static_cast<std::size_t>(i)];
        for (int k = 0; k < 3 && widths[static_cast<std::size_t>(i)] <= limit; ++k)
            cell[k] = std::max(cell[k], b.high[k] - b.low[k]);
    }
    const auto key = [](std::int64_t x, std::int64_t y, std::int64_t z) {
        return static_cast<std::uint64_t>(x) * 73856093ULL ^ static_cast<std::uint64_t>(y) * 19349663ULL ^
               static_cast<std::uint64_t>(z) * 83492791ULL;  // wraps around where places are far
    };
    const auto cell_of = [&](const Vec3& x, int k) {
        const double place = std::floor(x[k] / cell[k]);
        return std::fabs(place) < farthest_cell ? static_cast<std::int64_t>(place) : 0;  // of an unstable run: anywhere
    };
    std::unordered_map<std::uint64_t, std::vector<int>> grid;
    for (int i = 0; i < n; ++i) {
        const Box& b = boxes[static_cast<std::size_t>(i)];
        if (widths[static_cast<std::size_t>(i)] > limit) {
            for (int j = 0; j < n; ++j) {
                const bool other_large = widths[static_cast<std::size_t>(j)] > limit;
                if (j != i && (!other_large || i < j) && overlap(b, boxes[static_cast<std::size_t>(j)]))
                    pairs.emplace_back(std::minmax(i, j));
            }
            continue;
        }
        const Vec3 c = 0.5 * (b.low + b.high);
        const std::int64_t x = cell_of(c, 0), y = cell_of(c, 1), z = cell_of(c, 2);
        for (std::int64_t dx = -1; dx <= 1; ++dx) {
            for (std::int64_t dy = -1; dy <= 1; ++dy) {
                for (std::int64_t dz = -1; dz <= 1; ++dz) {
                    const auto found = grid.find(key(x + dx, y + dy, z + dz));
                    if (found == grid.end()) continue;
                    for (const int j : found->second) {
                        if (overlap(b, boxes[static_cast<std::size_t>(j)])) pairs.emplace_back(std::minmax(i, j));
                    }
                }
            }
        }
        grid[key(x, y, z)].push_back(i);
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());  // two cells may share a hash
    return pairs;
}

}  // namespace grainfrac
