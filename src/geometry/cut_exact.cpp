// SPDX-License-Identifier: GPL-3.0-or-later
// The second, independent route for cuts: CGAL classifies the vertices with exact predicates and both halves are convex
// hulls of their points. (CGAL's halfspace_intersection_3 is not used: it misplaces vertices of plain prisms.)
#include "geometry/cut.h"
#include "geometry/mass_properties.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <CGAL/exceptions.h>

#include <algorithm>
#include <limits>
#include <map>

namespace grainfrac {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

/// Hull triangles must lie in a known plane within this share of the size, else the cut is reported as degenerate.
constexpr double coplanar_tolerance = 1e-9;

/// Volumes of the parts of a clean cut add up to this share of the whole.
constexpr double volume_tolerance = 1e-12;

struct KnownFace {
    Plane plane;
    int tag;
};

/// -1, 0, 1: exact sign of n . v - d, but 0 for vertices within the on-plane tolerance.
std::vector<int> exact_sides(const Polyhedron& p, const Plane& plane, double tolerance)
{
    const Kernel::Plane_3 exact(plane.normal.x, plane.normal.y, plane.normal.z, -plane.offset);
    std::vector<int> side;
    for (const Vec3& v : p.vertices) {
        const int sign = static_cast<int>(exact.oriented_side(Point(v.x, v.y, v.z)));
        side.push_back(std::fabs(dot(plane.normal, v) - plane.offset) <= tolerance ? 0 : sign);
    }
    return side;
}

/// One point for every edge with ends strictly on different sides, and the vertices on the plane.
std::vector<Vec3> section_points(const Polyhedron& p, const Plane& plane, const std::vector<int>& side, double weld)
{
    std::vector<Vec3> points;
    const auto add = [&](const Vec3& x) {
        for (const Vec3& y : points)
            if (norm2(x - y) <= weld * weld) return;
        points.push_back(x);
    };
    for (std::size_t v = 0; v < p.vertices.size(); ++v)
        if (side[v] == 0) add(p.vertices[v]);
    for (const auto& face : p.faces)
        for (std::size_t k = 0; k < face.size(); ++k) {
            const auto u = static_cast<std::size_t>(face[k]), v = static_cast<std::size_t>(face[(k + 1) % face.size()]);
            if (u > v || side[u] * side[v] >= 0) continue;  // each edge once, from its lower vertex
            const double a = dot(plane.normal, p.vertices[u]) - plane.offset;
            const double b = dot(plane.normal, p.vertices[v]) - plane.offset;
            add(p.vertices[u] + (a / (a - b)) * (p.vertices[v] - p.vertices[u]));
        }
    return points;
}

/// The known face whose plane holds the triangle best; -1 if none does.
int face_of_triangle(const Vec3 (&x)[3], const std::vector<KnownFace>& known, double tolerance)
{
    int best = -1;
    double least = tolerance;
    for (std::size_t i = 0; i < known.size(); ++i) {
        double worst = 0.0;
        for (const Vec3& v : x)
            worst = std::max(worst, std::fabs(dot(known[i].plane.normal, v) - known[i].plane.offset));
        if (worst < least) {
            least = worst;
            best = static_cast<int>(i);
        }
    }
    return best;
}

/// Boundary of a set of triangles (directed edges) as one loop; empty if it is not one.
std::vector<int> boundary_loop(const std::vector<std::pair<int, int>>& edges)
{
    std::map<int, int> next;
    for (const auto& e : edges) {
        if (std::find(edges.begin(), edges.end(), std::pair(e.second, e.first)) != edges.end()) continue;
        if (!next.emplace(e.first, e.second).second) return {};
    }
    std::vector<int> loop;
    if (next.empty()) return loop;
    int v = next.begin()->first;
    do {
        loop.push_back(v);
        const auto it = next.find(v);
        if (it == next.end() || loop.size() > next.size()) return {};
        v = it->second;
    } while (v != loop.front());
    if (loop.size() != next.size()) loop.clear();
    return loop;
}

/// Convex hull of the points with the triangles of each known plane merged to one polygon; empty if that fails.
Polyhedron hull(const std::vector<Vec3>& vertices, const std::vector<KnownFace>& known, double size)
{
    Polyhedron p;
    if (vertices.size() < 4) return p;
    std::vector<Point> points;
    for (const Vec3& v : vertices) points.emplace_back(v.x, v.y, v.z);
    Mesh mesh;
    CGAL::convex_hull_3(points.begin(), points.end(), mesh);
    if (mesh.number_of_faces() < 4) return p;

    // vertices in the order in which they were given, whatever order the hull finds them in
    std::map<Point, int> given;
    for (std::size_t i = 0; i < points.size(); ++i) given.emplace(points[i], static_cast<int>(i));
    std::vector<std::vector<std::pair<int, int>>> edges(known.size());
    for (const auto face : mesh.faces()) {
        int index[3] = {0, 0, 0}, k = 0;
        for (const auto v : CGAL::vertices_around_face(mesh.halfedge(face), mesh)) index[k++] = given.at(mesh.point(v));
        const Vec3 x[3] = {vertices[static_cast<std::size_t>(index[0])], vertices[static_cast<std::size_t>(index[1])],
                           vertices[static_cast<std::size_t>(index[2])]};
        const int f = face_of_triangle(x, known, coplanar_tolerance * size);
        if (f < 0) return {};
        for (int i = 0; i < 3; ++i) edges[static_cast<std::size_t>(f)].emplace_back(index[i], index[(i + 1) % 3]);
    }
    std::vector<int> index(vertices.size(), -1);
    for (std::size_t f = 0; f < known.size(); ++f) {
        if (edges[f].empty()) continue;
        std::vector<int> loop = boundary_loop(edges[f]);
        if (loop.size() < 3) return {};
        for (int& v : loop) {
            int& i = index[static_cast<std::size_t>(v)];
            if (i < 0) {
                i = static_cast<int>(p.vertices.size());
                p.vertices.push_back(vertices[static_cast<std::size_t>(v)]);
            }
            v = i;
        }
        p.faces.push_back(std::move(loop));
        p.planes.push_back(known[f].plane);
        p.face_tags.push_back(known[f].tag);
    }
    return p;
}

/// Vertices that count as on the plane move by the tolerance; where that shows in the volume the cut is not clean.
bool volumes_add_up(const Polyhedron& whole, const Polyhedron& a, const Polyhedron& b)
{
    const double volume = mass_properties(whole).volume;
    return std::fabs(mass_properties(a).volume + mass_properties(b).volume - volume) <= volume_tolerance * volume;
}

}  // namespace

namespace {

CutResult cut_with_cgal(const Polyhedron& p, const Plane& plane, int tag)
{
    CutResult result;
    const double size = bounding_size(p), tolerance = on_plane_distance(p);
    const std::vector<int> side = exact_sides(p, plane, tolerance);
    if (std::find(side.begin(), side.end(), 1) == side.end()) {
        result.status = CutStatus::all_inside;
        result.inside = p;
        return result;
    }
    if (std::find(side.begin(), side.end(), -1) == side.end()) {
        result.status = CutStatus::all_outside;
        result.outside = p;
        return result;
    }
    const std::vector<Vec3> section = section_points(p, plane, side, tolerance);
    for (const int keep : {-1, 1}) {
        std::vector<Vec3> points;
        for (std::size_t v = 0; v < p.vertices.size(); ++v)
            if (side[v] == keep) points.push_back(p.vertices[v]);
        points.insert(points.end(), section.begin(), section.end());
        std::vector<KnownFace> known;
        for (std::size_t f = 0; f < p.planes.size(); ++f) known.push_back({p.planes[f], p.face_tags[f]});
        known.push_back({keep < 0 ? plane : Plane{-plane.normal, -plane.offset}, tag});
        (keep < 0 ? result.inside : result.outside) = hull(points, known, size);
    }
    const bool closed = why_not_convex(result.inside).empty() && why_not_convex(result.outside).empty();
    if (closed && volumes_add_up(p, result.inside, result.outside)) {
        result.status = CutStatus::ok;
        result.section = face_polygon(result.inside, static_cast<int>(result.inside.faces.size()) - 1);
    } else {
        result.inside = result.outside = {};
    }
    return result;
}

}  // namespace

CutResult cut_exact(const Polyhedron& p, const Plane& plane, int tag)
{
    try {
        return cut_with_cgal(p, plane, tag);
    } catch (const CGAL::Failure_exception&) {  // a precondition of the hull that round-off broke: no clean cut
        return {};
    }
}

}  // namespace grainfrac
