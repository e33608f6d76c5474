// SPDX-License-Identifier: GPL-3.0-or-later
// Closest points of convex cores against a search over all features.
#include "geometry/gjk.h"

#include "support/assembly.h"

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

Vec3 on_segment(const Vec3& p, const Vec3& a, const Vec3& b)
{
    const double t = std::clamp(dot(p - a, b - a) / norm2(b - a), 0.0, 1.0);
    return a + t * (b - a);
}

double point_to_face(const Vec3& p, const std::vector<Vec3>& polygon)
{
    const Vec3 n = normalized(area_vector(polygon));
    const Vec3 foot = p - dot(p - polygon[0], n) * n;
    bool inside = true;
    double best = 1e300;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        if (dot(cross(b - a, foot - a), n) < 0) inside = false;
        best = std::min(best, norm(p - on_segment(p, a, b)));
    }
    return inside ? norm(p - foot) : best;
}

double segment_to_segment(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
    double best = std::min({norm(a - on_segment(a, c, d)), norm(b - on_segment(b, c, d)), norm(c - on_segment(c, a, b)),
                            norm(d - on_segment(d, a, b))});
    const Vec3 u = b - a, v = d - c, w = c - a;
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), den = uu * vv - uv * uv;
    if (den > 1e-14 * uu * vv) {
        const double s = (dot(w, u) * vv - dot(w, v) * uv) / den, t = (dot(w, u) * uv - dot(w, v) * uu) / den;
        if (s >= 0 && s <= 1 && t >= 0 && t <= 1) best = std::min(best, norm(w + t * v - s * u));
    }
    return best;
}

/// Least distance of two disjoint polyhedra.
double by_features(const Polyhedron& a, const Polyhedron& b)
{
    double best = 1e300;
    for (std::size_t f = 0; f < a.faces.size(); ++f) {
        for (const Vec3& v : b.vertices) best = std::min(best, point_to_face(v, face_polygon(a, static_cast<int>(f))));
    }
    for (std::size_t f = 0; f < b.faces.size(); ++f) {
        for (const Vec3& v : a.vertices) best = std::min(best, point_to_face(v, face_polygon(b, static_cast<int>(f))));
    }
    for (const auto& fa : a.faces) {
        for (const auto& fb : b.faces) {
            for (std::size_t i = 0; i < fa.size(); ++i) {
                for (std::size_t j = 0; j < fb.size(); ++j) {
                    const auto at = [](const Polyhedron& p, int k) { return p.vertices[static_cast<std::size_t>(k)]; };
                    best = std::min(best, segment_to_segment(at(a, fa[i]), at(a, fa[(i + 1) % fa.size()]), at(b, fb[j]),
                                                             at(b, fb[(j + 1) % fb.size()])));
                }
            }
        }
    }
    return best;
}

double by_gjk(const Polyhedron& a, const Polyhedron& b)
{
    const PlacedCore x{a.vertices.data(), static_cast<int>(a.vertices.size()), {}, {}},
        y{b.vertices.data(), static_cast<int>(b.vertices.size()), {}, {}};
    const ClosestPoints c = closest_points(x, y, {1, 0, 0});
    CHECK(norm(c.b - c.a) == Approx(c.distance).margin(1e-15));
    return c.distance;
}

}  // namespace

TEST_CASE("closest points of random prisms agree with the feature search")
{
    int draw = 0, tried = 0;
    while (tried < 2000) {
        const Polyhedron a = rotated(make_hexagonal_prism(0.5, 1.0 + random_vector(draw).x * 0.5),
                                     from_axis_angle(normalized(random_vector(draw)), 3 * random_vector(draw).x));
        const Vec3 way = normalized(random_vector(draw));
        const double far = 1.05 + 0.5 * random_vector(draw).x;
        const Polyhedron b =
            translated(rotated(make_box({0.7, 1.1, 0.4}),
                               from_axis_angle(normalized(random_vector(draw)), 3 * random_vector(draw).x)),
                       far * way);
        if (!clip(a, b).faces.empty()) continue;  // overlapping
        ++tried;
        CHECK(by_gjk(a, b) == Approx(by_features(a, b)).epsilon(1e-9).margin(1e-12));
    }
}

TEST_CASE("closest points of parallel faces and edges, the rule in a tiling")
{
    int draw = 0;
    for (int k = 0; k < 2000; ++k) {
        const double gap = std::pow(10.0, -1.0 - 3.0 * std::fabs(random_vector(draw).x)),
                     tilt = 1e-3 * random_vector(draw).y;
        const Vec3 slide{0.9 * random_vector(draw).x, 0, 0.3 * random_vector(draw).x};
        const Polyhedron a = make_hexagonal_prism(1.0, 5.0);
        Polyhedron b = rotated(make_box({1.4, 0.7, 6.0}), from_axis_angle({0, 0, 1}, tilt));
        double low = 1e300;
        for (const Vec3& v : b.vertices) low = std::min(low, v.y);
        b = translated(b, slide + Vec3{0, 1.0 - low + gap, 0});
        if (!clip(a, b).faces.empty()) continue;
        CHECK(by_gjk(a, b) == Approx(by_features(a, b)).epsilon(1e-9).margin(1e-12));
    }
}

TEST_CASE("closest points do not depend on the first guess, prisms beside a plate")
{
    // Found in a Brazilian test: all differences of vertices lie in two planes, so that simplices are flat.
    int draw = 0;
    for (int k = 0; k < 5000; ++k) {
        const Vec3 r = random_vector(draw);
        const Polyhedron a =
            translated(rotated(make_hexagonal_prism(0.577e-3, 4.96e-3), from_axis_angle({0, 0, 1}, 1e-3 * r.x)),
                       {1e-3 * r.y, -6.8979925710503636e-3, 0});
        const Polyhedron b = make_box({1.425e-3, 0.675e-3, 5.925e-3}, {0, -7.8613938e-3 - 2e-4 * std::fabs(r.z), 0});
        if (!clip(a, b).faces.empty()) continue;
        const PlacedCore x{a.vertices.data(), 12, {}, {}}, y{b.vertices.data(), 8, {}, {}};
        const double expected = by_features(a, b);
        for (const Vec3& guess :
             {Vec3{-1, -1.2, 0}, Vec3{0, -1, 0}, Vec3{1, 0, 0}, random_vector(draw), random_vector(draw)}) {
            CHECK(closest_points(x, y, guess).distance == Approx(expected).epsilon(1e-9));
        }
    }
}

TEST_CASE("closest points do not depend on where the last search ended")
{
    int draw = 0;
    for (int k = 0; k < 2000; ++k) {
        const Polyhedron a = make_hexagonal_prism(1.0, 3.0);
        const Quat q = from_axis_angle(normalized(random_vector(draw)), 3.0 * random_vector(draw).x);
        const Polyhedron b = translated(rotated(make_box({1.4, 0.7, 6.0}), q), 4.0 * normalized(random_vector(draw)));
        if (!clip(a, b).faces.empty()) continue;
        const PlacedCore x{a.vertices.data(), 12, {}, {}}, y{b.vertices.data(), 8, {}, {}};
        ClosestCorners corners;  // any, also one that there is not
        corners.count = static_cast<std::int16_t>(draw % 4);
        for (int i = 0; i < corners.count; ++i) {
            corners.a[i] = static_cast<std::int16_t>(12.9 * std::fabs(random_vector(draw).x));
            corners.b[i] = static_cast<std::int16_t>(8.9 * std::fabs(random_vector(draw).x));
        }
        const double expected = closest_points(x, y, {1, 0, 0}).distance;
        CHECK(closest_points(x, y, {1, 0, 0}, corners).distance == Approx(expected).epsilon(1e-12));
        CHECK(corners.count > 0);
        CHECK(closest_points(x, y, {1, 0, 0}, corners).distance == Approx(expected).epsilon(1e-12));
    }
}

TEST_CASE("overlapping cores are reported as distance zero")
{
    CHECK(by_gjk(make_box({1, 1, 1}), make_box({1, 1, 1}, {0.3, 0.2, 0.1})) == 0.0);
}
