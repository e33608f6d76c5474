// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/polyhedron.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace grainfrac {

namespace {

/// Shares of the polyhedron's size by which a vertex may leave its face's plane, or stand out of another face. Well
/// above the round-off of cuts (1e-12), well below anything that contact or fracture could see.
constexpr double planarity_tolerance = 1e-9;
constexpr double convexity_tolerance = 1e-9;
/// Least volume over size^3; below it the cell is a sheet or a needle of round-off.
constexpr double volume_tolerance = 1e-15;
/// Error of the length of a "unit" normal that is put down to round-off.
constexpr double unit_tolerance = 1e-12;

Plane plane_of(const std::vector<Vec3>& polygon)
{
    const Vec3 n = normalized(area_vector(polygon));
    double d = 0.0;
    for (const Vec3& v : polygon) d += dot(n, v);
    return {n, d / static_cast<double>(polygon.size())};
}

std::string describe_face(int f)
{
    return "face " + std::to_string(f);
}

/// Every directed edge must occur once and its reverse once; empty if so. Counts the undirected edges.
std::string why_not_closed(const Polyhedron& p, int& edge_count)
{
    std::vector<std::pair<int, int>> edges;
    for (const auto& face : p.faces)
        for (std::size_t k = 0; k < face.size(); ++k) edges.emplace_back(face[k], face[(k + 1) % face.size()]);
    std::sort(edges.begin(), edges.end());
    edge_count = static_cast<int>(edges.size() / 2);
    const auto name = [](const std::pair<int, int>& e) {
        return "edge " + std::to_string(e.first) + "-" + std::to_string(e.second);
    };
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (edges[i].first == edges[i].second) return name(edges[i]) + " has no length";
        if (i > 0 && edges[i] == edges[i - 1]) return name(edges[i]) + " is used twice in one direction";
    }
    for (const auto& e : edges)
        if (!std::binary_search(edges.begin(), edges.end(), std::pair(e.second, e.first))) return name(e) + " is open";
    return {};
}

std::string why_lists_are_wrong(const Polyhedron& p)
{
    if (p.faces.size() < 4) return "fewer than four faces";
    if (p.planes.size() != p.faces.size() || p.face_tags.size() != p.faces.size())
        return "planes or face_tags do not match faces";
    std::vector<char> used(p.vertices.size(), 0);
    for (std::size_t f = 0; f < p.faces.size(); ++f) {
        if (p.faces[f].size() < 3) return describe_face(static_cast<int>(f)) + " has fewer than three vertices";
        for (int v : p.faces[f]) {
            if (v < 0 || v >= static_cast<int>(p.vertices.size()))
                return describe_face(static_cast<int>(f)) + " has a vertex index out of range";
            used[static_cast<std::size_t>(v)] = 1;
        }
    }
    for (std::size_t v = 0; v < used.size(); ++v)
        if (!used[v]) return "vertex " + std::to_string(v) + " belongs to no face";
    return {};
}

}  // namespace

const char* to_string(CutStatus status)
{
    switch (status) {
        case CutStatus::ok:
            return "ok";
        case CutStatus::all_inside:
            return "all inside";
        case CutStatus::all_outside:
            return "all outside";
        case CutStatus::degenerate:
            return "degenerate";
    }
    return "unknown";
}

Polyhedron make_polyhedron(std::vector<Vec3> vertices, std::vector<std::vector<int>> faces, int tag)
{
    Polyhedron p;
    p.vertices = std::move(vertices);
    p.faces = std::move(faces);
    for (std::size_t f = 0; f < p.faces.size(); ++f) {
        const std::string name = describe_face(static_cast<int>(f));
        if (p.faces[f].size() < 3) throw std::invalid_argument(name + " has fewer than three vertices");
        for (int v : p.faces[f])
            if (v < 0 || v >= static_cast<int>(p.vertices.size()))
                throw std::invalid_argument(name + ": vertex index " + std::to_string(v) + " is out of range");
        p.planes.push_back(plane_of(face_polygon(p, static_cast<int>(f))));
        if (!(norm2(p.planes.back().normal) > 0.0)) throw std::invalid_argument(name + " has zero area");
    }
    p.face_tags.assign(p.faces.size(), tag);
    return p;
}

Polyhedron make_box(const Vec3& size, const Vec3& center)
{
    const Vec3 h = 0.5 * size;
    std::vector<Vec3> vertices;
    for (int k = 0; k < 8; ++k)
        vertices.push_back(center + Vec3{k & 1 ? h.x : -h.x, k & 2 ? h.y : -h.y, k & 4 ? h.z : -h.z});
    Polyhedron p = make_polyhedron(
        std::move(vertices), {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}});
    p.face_tags = {0, 1, 2, 3, 4, 5};
    return p;
}

Polyhedron make_hexagonal_prism(double side, double thickness, const Vec3& center)
{
    // Table 2.2 of Saleme Ruiz 2016 with faces at +-t/2 (not +-t) and vertices on +-y, so that the lattice pitch along
    // x is sqrt(3) r without overlap; wound counter-clockwise from outside, which her listing is not.
    const double w = 0.5 * std::numbers::sqrt3 * side, h = 0.5 * side;
    std::vector<Vec3> hexagon{{w, -h, 0}, {w, h, 0}, {0, side, 0}, {-w, h, 0}, {-w, -h, 0}, {0, -side, 0}};
    for (Vec3& v : hexagon) v += center;
    return make_prism(hexagon, center.z - 0.5 * thickness, center.z + 0.5 * thickness);
}

Polyhedron make_prism(const std::vector<Vec3>& polygon, double z0, double z1)
{
    const int n = static_cast<int>(polygon.size());
    std::vector<Vec3> vertices;
    for (const Vec3& v : polygon) vertices.push_back({v.x, v.y, z0});
    for (const Vec3& v : polygon) vertices.push_back({v.x, v.y, z1});
    std::vector<std::vector<int>> faces;
    std::vector<int> bottom, top;
    for (int i = 0; i < n; ++i) {
        const int j = (i + 1) % n;
        faces.push_back({i, j, n + j, n + i});
        bottom.push_back(n - 1 - i);
        top.push_back(n + i);
    }
    faces.push_back(bottom);
    faces.push_back(top);
    Polyhedron p = make_polyhedron(std::move(vertices), std::move(faces));
    for (int f = 0; f < n + 2; ++f) p.face_tags[static_cast<std::size_t>(f)] = f;
    return p;
}

Polyhedron translated(const Polyhedron& p, const Vec3& shift)
{
    Polyhedron moved = p;
    for (Vec3& v : moved.vertices) v += shift;
    for (Plane& plane : moved.planes) plane.offset += dot(plane.normal, shift);
    return moved;
}

Polyhedron rotated(const Polyhedron& p, const Quat& q)
{
    Polyhedron turned = p;
    for (Vec3& v : turned.vertices) v = rotate(q, v);
    for (Plane& plane : turned.planes) plane.normal = normalized(rotate(q, plane.normal));
    return turned;
}

std::string why_not_convex(const Polyhedron& p)
{
    if (std::string why = why_lists_are_wrong(p); !why.empty()) return why;
    int edge_count = 0;
    if (std::string why = why_not_closed(p, edge_count); !why.empty()) return why;
    const int euler = static_cast<int>(p.vertices.size()) - edge_count + static_cast<int>(p.faces.size());
    if (euler != 2) return "Euler number is " + std::to_string(euler) + ", not 2";

    const double size = bounding_size(p);
    double volume = 0.0;
    for (std::size_t f = 0; f < p.faces.size(); ++f) {
        const Plane& plane = p.planes[f];
        const std::string name = describe_face(static_cast<int>(f));
        if (!(std::fabs(norm(plane.normal) - 1.0) < unit_tolerance)) return name + " has no unit normal";
        for (int v : p.faces[f])
            if (!(std::fabs(dot(plane.normal, p.vertices[static_cast<std::size_t>(v)]) - plane.offset) <=
                  planarity_tolerance * size))
                return name + " is not planar at vertex " + std::to_string(v);
        for (std::size_t v = 0; v < p.vertices.size(); ++v)
            if (dot(plane.normal, p.vertices[v]) - plane.offset > convexity_tolerance * size)
                return name + " has vertex " + std::to_string(v) + " outside: concave";
        const std::vector<Vec3> polygon = face_polygon(p, static_cast<int>(f));
        const Vec3 area = area_vector(polygon);
        if (dot(area, plane.normal) < -planarity_tolerance * size * size) return name + " is wound clockwise";
        volume += dot(area, polygon[0] - p.vertices[0]) / 3.0;
    }
    if (!(volume > volume_tolerance * size * size * size)) return "volume is not positive";
    return {};
}

Vec3 area_vector(const std::vector<Vec3>& polygon)
{
    Vec3 sum;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
        sum += cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
    return 0.5 * sum;
}

Vec3 polygon_centroid(const std::vector<Vec3>& polygon)
{
    const Vec3 n = normalized(area_vector(polygon));
    Vec3 moment, mean;
    double area = 0.0;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
        const Vec3 a = polygon[k] - polygon[0], b = polygon[k + 1] - polygon[0];
        const double twice = dot(n, cross(a, b));
        moment += twice * (a + b);
        area += twice;
    }
    if (area > 0.0) return polygon[0] + moment / (3.0 * area);
    for (const Vec3& v : polygon) mean += v;
    return polygon.empty() ? mean : mean / static_cast<double>(polygon.size());
}

std::vector<Vec3> face_polygon(const Polyhedron& p, int face)
{
    std::vector<Vec3> polygon;
    for (int v : p.faces[static_cast<std::size_t>(face)]) polygon.push_back(p.vertices[static_cast<std::size_t>(v)]);
    return polygon;
}

double surface_area(const Polyhedron& p)
{
    double area = 0.0;
    for (std::size_t f = 0; f < p.faces.size(); ++f) area += norm(area_vector(face_polygon(p, static_cast<int>(f))));
    return area;
}

double bounding_size(const Polyhedron& p)
{
    if (p.vertices.empty()) return 0.0;
    Vec3 low = p.vertices[0], high = p.vertices[0];
    for (const Vec3& v : p.vertices) {
        low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
        high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
    return norm(high - low);
}

double circumradius(const Polyhedron& p, const Vec3& from)
{
    double r = 0.0;
    for (const Vec3& v : p.vertices) r = std::max(r, norm(v - from));
    return r;
}

}  // namespace grainfrac
