// SPDX-License-Identifier: GPL-3.0-or-later
// Half-space clipper for convex polyhedra. Vertices are inside, on, or outside the plane; every face that reaches the
// kept side is walked once, crossing edges get one point each, and the opening is closed by the chain of open edges, so
// that planes through vertices, edges and faces need no special case.
#include "geometry/cut.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace grainfrac {

namespace {

/// Round-off of a coordinate, in units of its last place, that classification must not see.
constexpr double roundoff_places = 8.0;
/// If welding pinches the cut polygon, the on-plane tolerance grows by this factor, up to this many times (1e-9).
constexpr double retry_growth = 10.0;
constexpr int retry_limit = 4;
/// The two halves must have the same cut polygon within this share of size^2. They have not when the plane lies in a
/// face but for round-off, with some of its vertices on the plane and others not: one half is then a film.
constexpr double section_tolerance = 1e-10;

struct Sides {
    std::vector<double> distance;  ///< n . v - d [m]
    std::vector<int> side;         ///< -1 inside, 0 on the plane, 1 outside
    bool inside = false, outside = false;
};

void classify(const Polyhedron& p, const Plane& plane, double tolerance, Sides& s)
{
    const std::size_t n = p.vertices.size();
    s.distance.resize(n);
    s.side.resize(n);
    s.inside = s.outside = false;
    for (std::size_t v = 0; v < n; ++v) {
        const double d = dot(plane.normal, p.vertices[v]) - plane.offset;
        s.distance[v] = d;
        s.side[v] = d > tolerance ? 1 : (d < -tolerance ? -1 : 0);
        s.inside |= s.side[v] < 0;
        s.outside |= s.side[v] > 0;
    }
}

/// Where the edge u-v meets the plane, the same bits from either end.
Vec3 crossing_point(const Polyhedron& p, const Sides& s, int u, int v)
{
    if (std::fabs(s.distance[static_cast<std::size_t>(v)]) < std::fabs(s.distance[static_cast<std::size_t>(u)]) ||
        (std::fabs(s.distance[static_cast<std::size_t>(v)]) == std::fabs(s.distance[static_cast<std::size_t>(u)]) &&
         v < u))
        std::swap(u, v);
    const auto a = static_cast<std::size_t>(u), b = static_cast<std::size_t>(v);
    const double t = s.distance[a] / (s.distance[a] - s.distance[b]);
    return p.vertices[a] + t * (p.vertices[b] - p.vertices[a]);
}

/// The kept half while it is built.
struct Half {
    struct Crossing {
        int u, v, index;
    };
    std::vector<int> index_of;        ///< new index of an old vertex, -1 if not used yet
    std::vector<Crossing> crossings;  ///< u < v
    std::vector<int> on_plane;        ///< new indices of vertices on the plane
    Polyhedron p;

    int add(const Vec3& x)
    {
        p.vertices.push_back(x);
        return static_cast<int>(p.vertices.size()) - 1;
    }
    int add_on_plane(const Vec3& x, double weld)
    {
        for (int i : on_plane)
            if (norm2(p.vertices[static_cast<std::size_t>(i)] - x) <= weld * weld) return i;
        on_plane.push_back(add(x));
        return on_plane.back();
    }
};

int vertex_index(Half& half, const Polyhedron& p, const Sides& s, int v, double weld)
{
    int& index = half.index_of[static_cast<std::size_t>(v)];
    if (index < 0) {
        const Vec3& x = p.vertices[static_cast<std::size_t>(v)];
        index = s.side[static_cast<std::size_t>(v)] == 0 ? half.add_on_plane(x, weld) : half.add(x);
    }
    return index;
}

int crossing_index(Half& half, const Polyhedron& p, const Sides& s, int u, int v, double weld)
{
    if (u > v) std::swap(u, v);
    for (const auto& c : half.crossings)
        if (c.u == u && c.v == v) return c.index;
    half.crossings.push_back({u, v, half.add_on_plane(crossing_point(p, s, u, v), weld)});
    return half.crossings.back().index;
}

/// Part of one face on the kept side; empty if only an edge or a vertex of it is left.
std::vector<int> clip_face(Half& half, const Polyhedron& p, const Sides& s, const std::vector<int>& face, int keep,
                           double weld)
{
    const auto side = [&](int v) { return s.side[static_cast<std::size_t>(v)] * keep; };
    std::vector<int> loop;
    if (std::none_of(face.begin(), face.end(), [&](int v) { return side(v) > 0; })) return loop;
    const auto push = [&](int v) {
        if (loop.empty() || loop.back() != v) loop.push_back(v);
    };
    for (std::size_t k = 0; k < face.size(); ++k) {
        const int u = face[k], v = face[k + 1 < face.size() ? k + 1 : 0];
        if (side(u) >= 0) push(vertex_index(half, p, s, u, weld));
        if (side(u) * side(v) < 0) push(crossing_index(half, p, s, u, v, weld));
    }
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    if (loop.size() < 3) loop.clear();
    return loop;
}

/// The polygon that closes the half: open edges between on-plane vertices, backwards. Empty if they are no single loop.
std::vector<int> cap_loop(const Half& half)
{
    struct Edge {
        int from, to;
        bool operator==(const Edge&) const = default;
    };
    std::vector<char> on(half.p.vertices.size(), 0);
    for (int v : half.on_plane) on[static_cast<std::size_t>(v)] = 1;
    std::vector<Edge> edges;
    for (const auto& face : half.p.faces)
        for (std::size_t k = 0; k < face.size(); ++k) {
            const int u = face[k], v = face[k + 1 < face.size() ? k + 1 : 0];
            if (on[static_cast<std::size_t>(u)] && on[static_cast<std::size_t>(v)]) edges.push_back({u, v});
        }
    std::vector<Edge> open;
    for (const Edge& e : edges)
        if (std::find(edges.begin(), edges.end(), Edge{e.to, e.from}) == edges.end()) open.push_back({e.to, e.from});
    if (open.size() < 3) return {};

    std::vector<int> next(half.p.vertices.size(), -1);
    for (const Edge& e : open) {
        int& after = next[static_cast<std::size_t>(e.from)];
        if (after >= 0) return {};  // pinched: two loops meet in a vertex
        after = e.to;
    }
    std::vector<int> loop;
    int v = open.front().from;
    do {
        loop.push_back(v);
        v = next[static_cast<std::size_t>(v)];
    } while (v >= 0 && v != loop.front() && loop.size() <= open.size());
    if (v != loop.front() || loop.size() != open.size()) loop.clear();
    return loop;
}

void drop_unused_vertices(Polyhedron& p)
{
    std::vector<int> index(p.vertices.size(), -1);
    for (const auto& face : p.faces)
        for (int v : face) index[static_cast<std::size_t>(v)] = 0;
    int n = 0;
    for (std::size_t v = 0; v < index.size(); ++v)
        if (index[v] == 0) {
            p.vertices[static_cast<std::size_t>(n)] = p.vertices[v];
            index[v] = n++;
        }
    if (n == static_cast<int>(p.vertices.size())) return;
    p.vertices.resize(static_cast<std::size_t>(n));
    for (auto& face : p.faces)
        for (int& v : face) v = index[static_cast<std::size_t>(v)];
}

/// The half of p on the side `keep` (-1 inside, 1 outside); false if it cannot be closed.
bool build_half(const Polyhedron& p, const Plane& plane, const Sides& s, int keep, double weld, int tag,
                Polyhedron& out)
{
    Half half;
    half.index_of.assign(p.vertices.size(), -1);
    for (std::size_t f = 0; f < p.faces.size(); ++f) {
        std::vector<int> loop = clip_face(half, p, s, p.faces[f], keep, weld);
        if (loop.empty()) continue;
        half.p.faces.push_back(std::move(loop));
        half.p.planes.push_back(p.planes[f]);
        half.p.face_tags.push_back(p.face_tags[f]);
    }
    std::vector<int> cap = cap_loop(half);
    if (cap.empty() || half.p.faces.size() < 3) return false;
    half.p.faces.push_back(std::move(cap));
    half.p.planes.push_back(keep < 0 ? plane : Plane{-plane.normal, -plane.offset});
    half.p.face_tags.push_back(tag);
    drop_unused_vertices(half.p);
    out = std::move(half.p);
    return true;
}

Vec3 last_area(const Polyhedron& p)
{
    return area_vector(face_polygon(p, static_cast<int>(p.faces.size()) - 1));
}

/// p := its part inside the plane.
void clip_in_place(Polyhedron& p, const Plane& plane, int tag, Sides& s)
{
    double tolerance = on_plane_distance(p);
    for (int attempt = 0; attempt < retry_limit; ++attempt, tolerance *= retry_growth) {
        classify(p, plane, tolerance, s);
        if (!s.outside) return;
        if (!s.inside) {
            p = {};
            return;
        }
        Polyhedron kept;
        if (build_half(p, plane, s, -1, tolerance, tag, kept)) {
            p = std::move(kept);
            return;
        }
    }
    CutResult exact = cut_exact(p, plane, tag);
    if (exact.status == CutStatus::degenerate)
        throw std::runtime_error("clip: the polyhedron cannot be cut; is it convex?");
    p = std::move(exact.inside);
}

}  // namespace

double on_plane_distance(const Polyhedron& p)
{
    double reach = 0.0;
    for (const Vec3& v : p.vertices) reach = std::max({reach, std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    return std::max(on_plane_tolerance * bounding_size(p),
                    roundoff_places * std::numeric_limits<double>::epsilon() * reach);
}

CutResult cut(const Polyhedron& p, const Plane& plane, int tag)
{
    CutResult result;
    Sides s;
    const double size = bounding_size(p);
    double tolerance = on_plane_distance(p);
    for (int attempt = 0; attempt < retry_limit && result.status == CutStatus::degenerate;
         ++attempt, tolerance *= retry_growth) {
        classify(p, plane, tolerance, s);
        if (!s.outside) {
            result = {CutStatus::all_inside, p, {}, {}};
        } else if (!s.inside) {
            result = {CutStatus::all_outside, {}, p, {}};
        } else if (build_half(p, plane, s, -1, tolerance, tag, result.inside) &&
                   build_half(p, plane, s, 1, tolerance, tag, result.outside)) {
            result.status = CutStatus::ok;
            result.section = face_polygon(result.inside, static_cast<int>(result.inside.faces.size()) - 1);
        }
    }
    // a film, or a chip so small that the parent's round-off bends its faces, is no polyhedron to go on with
    if (result.status == CutStatus::ok &&
        (norm(last_area(result.inside) + last_area(result.outside)) > section_tolerance * size * size ||
         !why_not_convex(result.inside).empty() || !why_not_convex(result.outside).empty()))
        result.status = CutStatus::degenerate;
    if (result.status == CutStatus::degenerate) result = {};
    return result;
}

Polyhedron clip(const Polyhedron& p, const std::vector<Plane>& planes, int first_tag)
{
    Polyhedron kept = p;
    Sides s;
    for (std::size_t i = 0; i < planes.size() && !kept.faces.empty(); ++i)
        clip_in_place(kept, planes[i], first_tag + static_cast<int>(i), s);
    return kept;
}

Polyhedron clip(const Polyhedron& p, const Polyhedron& region, int tag_shift)
{
    Polyhedron kept = p;
    Sides s;
    for (std::size_t f = 0; f < region.planes.size() && !kept.faces.empty(); ++f)
        clip_in_place(kept, region.planes[f], region.face_tags[f] + tag_shift, s);
    return kept;
}

Polyhedron erode(const Polyhedron& p, double radius)
{
    Polyhedron core = p;
    Sides s;
    for (std::size_t f = 0; f < p.planes.size() && !core.faces.empty(); ++f)
        clip_in_place(core, {p.planes[f].normal, p.planes[f].offset - radius}, p.face_tags[f], s);
    return core;
}

}  // namespace grainfrac
