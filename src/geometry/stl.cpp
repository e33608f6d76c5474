// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stl.h"

#include <CGAL/IO/STL.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <compare>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace grainfrac {

namespace {

/// Normals that differ by less (1 - cosine, 1.4e-5 rad) are those of one plane: coordinates in files are floats.
constexpr double same_normal = 1e-10;

/// A corner as CGAL reads it. It looks for equal ones in a map; with an order that also places what is not a number,
/// such a corner is not taken for another.
struct RawPoint {
    double x[3];
    double& operator[](std::size_t k) { return x[k]; }
    void resize(std::size_t) {}
    friend bool operator<(const RawPoint& a, const RawPoint& b)
    {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::strong_ordering order = std::strong_order(a.x[k], b.x[k]);
            if (std::is_neq(order)) return std::is_lt(order);
        }
        return false;
    }
};

using Edge = std::pair<int, int>;
using Loop = std::vector<int>;

Vec3 low_corner(const std::vector<Vec3>& points)
{
    Vec3 low = points.front();
    for (const Vec3& p : points) {
        for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]);
    }
    return low;
}

double size_of(const std::vector<Vec3>& points)
{
    Vec3 low = points.front(), high = low;
    for (const Vec3& p : points) {
        for (int k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    }
    return norm(high - low);
}

/// Index of the first point within `tolerance` of each, by a grid of that width.
std::vector<int> welded(const std::vector<Vec3>& points, double tolerance, std::vector<Vec3>& kept)
{
    const Vec3 origin = low_corner(points);  // cells are counted from here, so that their numbers stay small
    std::map<std::tuple<std::int64_t, std::int64_t, std::int64_t>, std::vector<int>> grid;
    std::vector<int> index;
    for (const Vec3& p : points) {
        std::int64_t cell[3];
        for (int k = 0; k < 3; ++k) cell[k] = static_cast<std::int64_t>(std::floor((p[k] - origin[k]) / tolerance));
        int found = -1;
        for (int n = 0; n < 27 && found < 0; ++n) {
            const auto near = grid.find({cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1});
            if (near == grid.end()) continue;
            for (const int i : near->second) {
                if (norm(kept[static_cast<std::size_t>(i)] - p) <= tolerance) found = i;
            }
        }
        if (found < 0) {
            found = static_cast<int>(kept.size());
            kept.push_back(p);
            grid[{cell[0], cell[1], cell[2]}].push_back(found);
        }
        index.push_back(found);
    }
    return index;
}

/// The surface's triangles by their directed edges.
std::map<Edge, std::vector<int>> triangles_by_edge(const TriangleMesh& mesh)
{
    std::map<Edge, std::vector<int>> at;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& c = mesh.triangles[t];
        for (std::size_t k = 0; k < 3; ++k) at[{c[k], c[(k + 1) % 3]}].push_back(static_cast<int>(t));
    }
    return at;
}

/// Facets of one plane: loops of vertices, merged edge by edge.
class FlatRegion {
public:
    FlatRegion(const std::vector<Vec3>& vertices, const Vec3& normal, double tolerance, int most_corners)
        : vertices_(vertices), normal_(normal), tolerance_(tolerance), most_corners_(most_corners)
    {
    }

    std::vector<std::vector<Vec3>> facets(std::vector<Loop> loops) const
    {
        if (const Loop whole = border(loops); is_facet(whole)) return {corners(whole)};
        std::map<Edge, int> owner;  // of each directed edge; only loops that share one can be merged
        const auto enter = [&](int i) {
            const Loop& loop = loops[static_cast<std::size_t>(i)];
            for (std::size_t k = 0; k < loop.size(); ++k) owner[{loop[k], loop[(k + 1) % loop.size()]}] = i;
        };
        for (int i = 0; i < static_cast<int>(loops.size()); ++i) enter(i);
        bool merged = true;
        while (merged) {
            merged = false;
            for (int i = 0; i < static_cast<int>(loops.size()); ++i) {
                Loop& loop = loops[static_cast<std::size_t>(i)];
                for (int j = neighbour(loop, i + 1, owner); j >= 0; j = neighbour(loop, j + 1, owner)) {
                    Loop& other = loops[static_cast<std::size_t>(j)];
                    const Loop both = border({loop, other});
                    if (!is_facet(both)) continue;
                    for (std::size_t k = 0; k < other.size(); ++k)
                        owner.erase({other[k], other[(k + 1) % other.size()]});
                    for (std::size_t k = 0; k < loop.size(); ++k) owner.erase({loop[k], loop[(k + 1) % loop.size()]});
                    loop = both;
                    other.clear();
                    enter(i);
                    merged = true;
                }
            }
        }
        std::erase_if(loops, [](const Loop& loop) { return loop.empty(); });
        std::vector<std::vector<Vec3>> polygons;
        for (const Loop& loop : loops) polygons.push_back(corners(loop));
        return polygons;
    }

private:
    const Vec3& at(int v) const { return vertices_[static_cast<std::size_t>(v)]; }

    /// The first loop from `from` on that shares an edge with this one; -1: none.
    static int neighbour(const Loop& loop, int from, const std::map<Edge, int>& owner)
    {
        int first = -1;
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const auto found = owner.find({loop[(k + 1) % loop.size()], loop[k]});
            if (found != owner.end() && found->second >= from && (first < 0 || found->second < first))
                first = found->second;
        }
        return first;
    }

    /// Outline of several loops; empty unless it is a single closed line that passes every vertex once.
    static Loop border(const std::vector<Loop>& loops)
    {
        std::set<Edge> edges;
        for (const Loop& loop : loops) {
            for (std::size_t k = 0; k < loop.size(); ++k) edges.insert({loop[k], loop[(k + 1) % loop.size()]});
        }
        std::map<int, int> next;
        for (const auto& [from, to] : edges) {
            if (edges.count({to, from}) > 0) continue;
            if (!next.try_emplace(from, to).second) return {};
        }
        Loop outline;
        if (next.empty()) return outline;
        int v = next.begin()->first;
        do {
            outline.push_back(v);
            const auto to = next.find(v);
            if (to == next.end() || outline.size() > next.size()) return {};
            v = to->second;
        } while (v != outline.front());
        return outline.size() == next.size() ? outline : Loop{};
    }

    /// The loop without vertices on the line of their neighbours.
    std::vector<Vec3> corners(const Loop& loop) const
    {
        std::vector<Vec3> kept;
        const std::size_t n = loop.size();
        for (std::size_t k = 0; k < n; ++k) {
            const Vec3 before = kept.empty() ? at(loop[n - 1]) : kept.back(), here = at(loop[k]);
            const Vec3 along = at(loop[(k + 1) % n]) - before;
            if (norm(cross(here - before, along)) > tolerance_ * norm(along)) kept.push_back(here);
        }
        return kept;
    }

    bool is_facet(const Loop& loop) const
    {
        if (loop.size() < 3) return false;
        const std::vector<Vec3> c = corners(loop);
        const std::size_t n = c.size();
        if (n < 3 || n > static_cast<std::size_t>(most_corners_)) return false;
        for (std::size_t k = 0; k < n; ++k) {
            const Vec3 in = c[(k + 1) % n] - c[k], out = c[(k + 2) % n] - c[(k + 1) % n];
            if (dot(cross(in, out), normal_) <= 0.0) return false;
        }
        return true;
    }

    const std::vector<Vec3>& vertices_;
    Vec3 normal_;
    double tolerance_;
    int most_corners_;
};

}  // namespace

TriangleMesh read_stl(const std::string& file)
{
    std::error_code unknown;
    const auto kind = std::filesystem::status(file, unknown);
    if (std::filesystem::is_directory(kind)) throw std::runtime_error("\"" + file + "\" is a directory");
    if (std::filesystem::exists(kind) && !std::filesystem::is_regular_file(kind))
        throw std::runtime_error("\"" + file + "\" is no ordinary file");
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error("\"" + file + "\" cannot be opened: " + std::strerror(errno));
    std::vector<RawPoint> points;
    std::vector<std::array<std::size_t, 3>> triangles;
    if (!CGAL::IO::read_STL(in, points, triangles))
        throw std::runtime_error("\"" + file + "\" is no STL file, neither ASCII nor binary, or it ends too early");
    if (triangles.empty()) throw std::runtime_error("\"" + file + "\" has no triangles: it is empty, or no STL file");
    std::vector<Vec3> raw;
    for (const auto& p : points) {
        raw.push_back({p.x[0], p.x[1], p.x[2]});
        if (!std::all_of(std::begin(p.x), std::end(p.x), [](double x) { return std::isfinite(x); }))
            throw std::runtime_error("\"" + file + "\" has a coordinate that is not a finite number");
    }
    TriangleMesh mesh;
    const double size = size_of(raw);
    if (!(size > 0.0)) throw std::runtime_error("\"" + file + "\" has no extent");
    const std::vector<int> index = welded(raw, weld_tolerance * size, mesh.vertices);
    bool flat = true;  // every triangle is a line
    for (const auto& t : triangles) {
        const std::array<int, 3> c{index[t[0]], index[t[1]], index[t[2]]};
        if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
        const Vec3 &a = mesh.vertices[static_cast<std::size_t>(c[0])],
                   u = mesh.vertices[static_cast<std::size_t>(c[1])] - a,
                   v = mesh.vertices[static_cast<std::size_t>(c[2])] - a;
        flat = flat && norm(cross(u, v)) <= weld_tolerance * size * std::max(norm(u), norm(v));
        mesh.triangles.push_back(c);
    }
    if (mesh.triangles.empty() || flat) throw std::runtime_error("\"" + file + "\" has no triangle with an area");
    return mesh;
}

std::string why_not_closed(const TriangleMesh& mesh)
{
    int border = 0, crowded = 0;
    const auto at = triangles_by_edge(mesh);
    for (const auto& [edge, triangles] : at) {
        const auto other = at.find({edge.second, edge.first});
        if (triangles.size() > 1)
            ++crowded;
        else if (other == at.end())
            ++border;
    }
    if (border > 0)
        return std::to_string(border) + (border == 1 ? " edge belongs" : " edges belong") + " to one triangle only";
    if (crowded > 0)
        return std::to_string(crowded) + (crowded == 1 ? " edge joins" : " edges join") +
               " more than two triangles, or two that are wound differently";
    return {};
}

std::vector<std::vector<Vec3>> convex_facets(const TriangleMesh& mesh, int most_corners)
{
    const double tolerance = weld_tolerance * size_of(mesh.vertices);
    const auto at = [&](int v) { return mesh.vertices[static_cast<std::size_t>(v)]; };
    std::vector<Vec3> normals;  // zero: no area
    for (const auto& t : mesh.triangles) {
        const Vec3 e = at(t[1]) - at(t[0]), f = at(t[2]) - at(t[1]), n = cross(e, f);
        const double longest = std::max({norm(e), norm(f), norm(e + f)});
        normals.push_back(norm(n) > tolerance * longest ? normalized(n) : Vec3{});
    }
    const auto neighbours = triangles_by_edge(mesh);
    std::vector<char> done(mesh.triangles.size(), 0);
    std::vector<std::vector<Vec3>> facets;
    for (std::size_t seed = 0; seed < mesh.triangles.size(); ++seed) {
        if (done[seed] != 0 || norm2(normals[seed]) == 0.0) continue;
        const Vec3 n = normals[seed];
        const double offset = dot(n, at(mesh.triangles[seed][0]));
        std::vector<Loop> region;
        std::vector<std::size_t> open{seed};
        done[seed] = 1;
        while (!open.empty()) {
            const auto& t = mesh.triangles[open.back()];
            open.pop_back();
            region.emplace_back(t.begin(), t.end());
            for (std::size_t k = 0; k < 3; ++k) {
                const auto found = neighbours.find({t[(k + 1) % 3], t[k]});
                if (found == neighbours.end() || found->second.size() != 1) continue;
                const auto other = static_cast<std::size_t>(found->second.front());
                const auto& c = mesh.triangles[other];
                const bool flat = std::all_of(c.begin(), c.end(),
                                              [&](int v) { return std::fabs(dot(n, at(v)) - offset) <= tolerance; });
                if (done[other] != 0 || !flat || dot(normals[other], n) < 1.0 - same_normal) continue;
                done[other] = 1;
                open.push_back(other);
            }
        }
        for (auto& polygon : FlatRegion(mesh.vertices, n, tolerance, most_corners).facets(std::move(region)))
            facets.push_back(std::move(polygon));
    }
    return facets;
}

}  // namespace grainfrac
