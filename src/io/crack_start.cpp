// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/crack_start.h"

#include "experiment/specimen.h"
#include "geometry/gjk.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace grainfrac {

namespace {

/// Of the section: the load must go round such a crack, and in the coarsest specimens, five grains wide, it is more
/// than one face. More is not always reached before the load drops: grains bridge a crack that looks whole.
constexpr double macroscopic_share = 0.25;
/// Of the grain spacing: far above what faces move apart before the crack is large, far below a grain.
constexpr double reach_share = 0.1;

CrackStart start_of(const std::vector<CrackFace>& cracks, std::size_t i)
{
    CrackStart s;
    s.time = cracks[i].time;
    s.point = polygon_centroid(cracks[i].polygon);
    s.mode = cracks[i].mode;
    s.cause = cracks[i].cause;
    s.faces = static_cast<int>(
        std::count_if(cracks.begin(), cracks.end(), [&](const CrackFace& c) { return c.time == s.time; }));
    return s;
}

bool touch(const CrackFace& a, const CrackFace& b, const Vec3& from_a_to_b, double reach)
{
    const PlacedCore core_a{a.polygon.data(), static_cast<int>(a.polygon.size()), {}, {}},
        core_b{b.polygon.data(), static_cast<int>(b.polygon.size()), {}, {}};
    const Vec3 guess = norm(from_a_to_b) > 0.0 ? from_a_to_b : a.normal;
    return closest_points(core_a, core_b, guess).distance <= reach;
}

/// For each face the earlier ones that it touches. Faces in the order of x, each with those whose balls may reach it.
std::vector<std::vector<int>> earlier_neighbours(const std::vector<CrackFace>& cracks, double reach)
{
    const std::size_t n = cracks.size();
    std::vector<Vec3> center(n);
    std::vector<double> radius(n, 0.0);
    double widest = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        center[i] = polygon_centroid(cracks[i].polygon);
        for (const Vec3& p : cracks[i].polygon) radius[i] = std::max(radius[i], norm(p - center[i]));
        widest = std::max(widest, radius[i]);
    }
    std::vector<int> order(n);
    std::iota(order.begin(), order.end(), 0);
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    std::sort(order.begin(), order.end(), [&](int i, int j) { return center[at(i)].x < center[at(j)].x; });
    std::vector<std::vector<int>> result(n);
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t i = at(order[k]);
        for (std::size_t m = k + 1; m < n; ++m) {
            const std::size_t j = at(order[m]);
            if (center[j].x - center[i].x > radius[i] + widest + reach) break;
            const Vec3 d = center[j] - center[i];
            if (norm(d) > radius[i] + radius[j] + reach || !touch(cracks[i], cracks[j], d, reach)) continue;
            result[std::max(i, j)].push_back(static_cast<int>(std::min(i, j)));
        }
    }
    return result;
}

}  // namespace

CrackScale crack_scale(const Model& model, const State& state)
{
    const Vec3 size = specimen_extent(model, state).size();
    if (!(size.x > 0.0)) return {};  // no grains
    const double smallest = std::min({size.x * size.y, size.y * size.z, size.z * size.x});
    return {macroscopic_share * smallest, reach_share * model.nominal_length};
}

std::optional<MacroscopicCrack> find_macroscopic_crack(const std::vector<CrackFace>& cracks, const CrackScale& scale)
{
    if (!(scale.area > 0.0)) return std::nullopt;
    struct Crack {  // connected faces, kept at their root
        std::size_t start = 0;
        double area = 0.0;
        int faces = 0;
    };
    const std::vector<std::vector<int>> neighbours = earlier_neighbours(cracks, scale.reach);
    std::vector<std::size_t> parent(cracks.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    std::vector<Crack> crack(cracks.size());
    for (std::size_t i = 0; i < cracks.size(); ++i) {
        crack[i] = {i, cracks[i].area, 1};
        std::size_t largest = i;  // of the cracks that this face joins
        std::vector<std::size_t> joined{i};
        for (const int k : neighbours[i]) {
            const std::size_t r = root(static_cast<std::size_t>(k));
            if (std::find(joined.begin(), joined.end(), r) != joined.end()) continue;
            joined.push_back(r);
            const bool larger = largest == i || crack[r].area > crack[largest].area ||
                                (crack[r].area == crack[largest].area && crack[r].start < crack[largest].start);
            if (larger) largest = r;
        }
        for (const std::size_t r : joined) {
            if (r == largest) continue;
            parent[r] = largest;
            crack[largest].area += crack[r].area;
            crack[largest].faces += crack[r].faces;
        }
        const Crack& now = crack[largest];
        if (now.area >= scale.area)
            return MacroscopicCrack{start_of(cracks, now.start), cracks[i].time, now.area, now.faces};
    }
    return std::nullopt;
}

void CrackWatch::look(const Model& model, const State& state)
{
    if (first_ && macroscopic_) return;
    const std::vector<CrackFace> cracks = collect_cracks(model, state);
    if (cracks.empty()) return;
    if (!first_) first_ = start_of(cracks, 0);
    if (!macroscopic_) macroscopic_ = find_macroscopic_crack(cracks, scale_);
}

}  // namespace grainfrac
