// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/shared_faces.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

namespace grainfrac {

namespace {

/// Points of an overlap closer than this share of the polygon's size are one point, and points this close to an edge
/// lie on it. Cells built separately agree to 1e-12; without the margin a shared quadrilateral would get spurious
/// corners.
constexpr double same_point_tolerance = 1e-9;

struct Bounds {
    Vec3 low, high;
};

Bounds bounds_of(const Polyhedron& p)
{
    Bounds b{p.vertices[0], p.vertices[0]};
    for (const Vec3& v : p.vertices)
        for (int i = 0; i < 3; ++i) {
            b.low[i] = std::min(b.low[i], v[i]);
            b.high[i] = std::max(b.high[i], v[i]);
        }
    return b;
}

struct Cell {
    int i[3];
    bool operator==(const Cell&) const = default;
};

struct CellHash {
    std::size_t operator()(const Cell& c) const
    {
        std::uint64_t h = 0;
        for (int k : c.i) h = (h ^ static_cast<std::uint32_t>(k)) * 0x9E3779B97F4A7C15ull + (h >> 29);
        return static_cast<std::size_t>(h);
    }
};

Cell cell_of(const Vec3& x, const Vec3& origin, double width)
{
    Cell c{};
    for (int i = 0; i < 3; ++i) c.i[i] = static_cast<int>(std::floor((x[i] - origin[i]) / width));
    return c;
}

/// Pairs a < b whose bounding boxes, grown by `margin` on all sides, overlap.
std::vector<std::pair<int, int>> close_pairs(const std::vector<Polyhedron>& polyhedra, double margin, double width)
{
    std::vector<Bounds> bounds;
    for (const Polyhedron& p : polyhedra) {
        Bounds b = p.vertices.empty() ? Bounds{} : bounds_of(p);
        b.low -= Vec3{margin, margin, margin};
        b.high += Vec3{margin, margin, margin};
        bounds.push_back(b);
    }
    Vec3 origin = bounds[0].low;
    for (const Bounds& b : bounds)
        origin = {std::min(origin.x, b.low.x), std::min(origin.y, b.low.y), std::min(origin.z, b.low.z)};

    std::vector<std::pair<int, int>> pairs;
    std::unordered_map<Cell, std::vector<int>, CellHash> grid;
    for (int b = 0; b < static_cast<int>(polyhedra.size()); ++b) {
        const Bounds& mine = bounds[static_cast<std::size_t>(b)];
        if (polyhedra[static_cast<std::size_t>(b)].vertices.empty()) continue;
        const Cell from = cell_of(mine.low, origin, width), to = cell_of(mine.high, origin, width);
        for (int i = from.i[0]; i <= to.i[0]; ++i)
            for (int j = from.i[1]; j <= to.i[1]; ++j)
                for (int k = from.i[2]; k <= to.i[2]; ++k) {
                    const Cell here{{i, j, k}};
                    std::vector<int>& members = grid[here];
                    for (int a : members) {
                        const Bounds& other = bounds[static_cast<std::size_t>(a)];
                        Vec3 low, high;
                        for (int d = 0; d < 3; ++d) {
                            low[d] = std::max(mine.low[d], other.low[d]);
                            high[d] = std::min(mine.high[d], other.high[d]);
                        }
                        // only the cell with the lower corner of the common box reports the pair
                        if (low.x <= high.x && low.y <= high.y && low.z <= high.z &&
                            cell_of(low, origin, width) == here)
                            pairs.emplace_back(a, b);
                    }
                    members.push_back(b);
                }
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

struct Scales {
    double size = 0.0;  ///< mean size of a polyhedron [m]
    double area = 0.0;  ///< mean area of a face [m^2]
};

Scales mean_scales(const std::vector<Polyhedron>& polyhedra)
{
    Scales s;
    std::size_t cells = 0, faces = 0;
    for (const Polyhedron& p : polyhedra) {
        if (p.vertices.empty()) continue;
        s.size += bounding_size(p);
        s.area += surface_area(p);
        faces += p.faces.size();
        ++cells;
    }
    if (cells == 0 || faces == 0) return {};
    return {s.size / static_cast<double>(cells), s.area / static_cast<double>(faces)};
}

bool face_in_plane(const Polyhedron& p, std::size_t face, const Plane& plane, double tolerance)
{
    for (int v : p.faces[face])
        if (std::fabs(dot(plane.normal, p.vertices[static_cast<std::size_t>(v)]) - plane.offset) > tolerance)
            return false;
    return true;
}

double polygon_size(const std::vector<Vec3>& polygon)
{
    double r2 = 0.0;
    for (const Vec3& v : polygon) r2 = std::max(r2, norm2(v - polygon[0]));
    return std::sqrt(r2);
}

/// Merges points closer than `tolerance`, drops points on the line of their neighbours; empty if no polygon is left.
std::vector<Vec3> tidy(std::vector<Vec3> polygon, double tolerance)
{
    for (std::size_t k = 0; k < polygon.size() && polygon.size() >= 3;) {
        const std::size_t n = polygon.size();
        const Vec3 &before = polygon[(k + n - 1) % n], &here = polygon[k], &after = polygon[(k + 1) % n];
        const Vec3 along = after - before;
        const bool same = norm(after - here) <= tolerance;
        if (same || norm(cross(here - before, along)) <= tolerance * norm(along)) {
            polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(k));
            k = k > 0 ? k - 1 : 0;
        } else {
            ++k;
        }
    }
    if (polygon.size() < 3) polygon.clear();
    return polygon;
}

}  // namespace

std::vector<Vec3> intersect_polygons(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const Vec3& normal)
{
    if (a.size() < 3 || b.size() < 3) return {};
    const double tolerance = same_point_tolerance * std::min(polygon_size(a), polygon_size(b));
    const double turn = dot(area_vector(b), normal) < 0.0 ? -1.0 : 1.0;
    std::vector<Vec3> kept = a;
    std::vector<double> distance;
    for (std::size_t k = 0; k < b.size() && kept.size() >= 3; ++k) {
        const Vec3 edge = b[(k + 1) % b.size()] - b[k];
        if (norm(edge) <= tolerance) continue;
        const Vec3 inward = turn * normalized(cross(normal, edge));
        distance.clear();
        for (const Vec3& v : kept) {
            const double d = dot(inward, v - b[k]);
            distance.push_back(std::fabs(d) <= tolerance ? 0.0 : d);
        }
        std::vector<Vec3> next;
        for (std::size_t i = 0; i < kept.size(); ++i) {
            const std::size_t j = (i + 1) % kept.size();
            if (distance[i] >= 0.0) next.push_back(kept[i]);
            if (distance[i] * distance[j] < 0.0)
                next.push_back(kept[i] + (distance[i] / (distance[i] - distance[j])) * (kept[j] - kept[i]));
        }
        kept = std::move(next);
    }
    return tidy(std::move(kept), tolerance);
}

std::vector<SharedFace> find_shared_faces(const std::vector<Polyhedron>& polyhedra, const SharedFaceOptions& options)
{
    std::vector<SharedFace> shared;
    const Scales scales = mean_scales(polyhedra);
    if (!(scales.size > 0.0)) return shared;
    const double near = std::max(options.plane_tolerance * scales.size, options.plane_distance);
    for (const auto& [ia, ib] : close_pairs(polyhedra, near, scales.size)) {
        const Polyhedron &a = polyhedra[static_cast<std::size_t>(ia)], &b = polyhedra[static_cast<std::size_t>(ib)];
        for (std::size_t fa = 0; fa < a.faces.size(); ++fa)
            for (std::size_t fb = 0; fb < b.faces.size(); ++fb) {
                const Vec3 &na = a.planes[fa].normal, &nb = b.planes[fb].normal;
                if (dot(na, nb) >= -1.0 + options.normal_tolerance || !face_in_plane(b, fb, a.planes[fa], near))
                    continue;
                const Vec3 normal = normalized(na - nb);
                std::vector<Vec3> polygon = intersect_polygons(face_polygon(a, static_cast<int>(fa)),
                                                               face_polygon(b, static_cast<int>(fb)), normal);
                if (polygon.empty() || norm(area_vector(polygon)) <= options.area_tolerance * scales.area) continue;
                shared.push_back({ia, ib, static_cast<int>(fa), static_cast<int>(fb), std::move(polygon), normal});
            }
    }
    return shared;
}

}  // namespace grainfrac
