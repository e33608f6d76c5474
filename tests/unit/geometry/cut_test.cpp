// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/cut.h"

#include "geometry/mass_properties.h"
#include "shapes.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace grainfrac;
using namespace grainfrac::test;

namespace {

/// Both halves are convex, add up to the whole, and meet in the section.
void check_halves(const Polyhedron& whole, const CutResult& c, const Plane& plane, double tolerance = 1e-12)
{
    REQUIRE(c.status == CutStatus::ok);
    REQUIRE(why_not_convex(c.inside) == "");
    REQUIRE(why_not_convex(c.outside) == "");
    const double volume = mass_properties(whole).volume, size = bounding_size(whole);
    REQUIRE(std::fabs(mass_properties(c.inside).volume + mass_properties(c.outside).volume - volume) <
            tolerance * volume);
    for (const Vec3& v : c.section) REQUIRE(std::fabs(dot(plane.normal, v) - plane.offset) < 1e-11 * size);
    const Vec3 area = area_vector(c.section);
    REQUIRE(norm(area - norm(area) * plane.normal) < 1e-9 * size * size);
    REQUIRE(norm(area_vector(face_polygon(c.outside, static_cast<int>(c.outside.faces.size()) - 1)) + area) <
            1e-10 * size * size);
}

void check_both_routes(const Polyhedron& p, const Plane& plane)
{
    const CutResult a = cut(p, plane, 77), b = cut_exact(p, plane, 77);
    REQUIRE(a.status == b.status);
    if (a.status != CutStatus::ok) return;
    check_halves(p, a, plane);
    check_halves(p, b, plane);
    const double volume = mass_properties(p).volume;
    CHECK(std::fabs(mass_properties(a.inside).volume - mass_properties(b.inside).volume) < 1e-12 * volume);
    CHECK(a.inside.vertices.size() == b.inside.vertices.size());
    CHECK(a.outside.vertices.size() == b.outside.vertices.size());
    CHECK(a.inside.faces.size() == b.inside.faces.size());
    auto tags_a = a.outside.face_tags, tags_b = b.outside.face_tags;
    std::sort(tags_a.begin(), tags_a.end());
    std::sort(tags_b.begin(), tags_b.end());
    CHECK(tags_a == tags_b);
}

Plane through(const Vec3& a, const Vec3& b, const Vec3& c)
{
    const Vec3 n = normalized(cross(b - a, c - a));
    return {n, dot(n, a)};
}

}  // namespace

TEST_CASE("both ways of cutting agree on random polyhedra", "[cut]")
{
    std::mt19937_64 random(4);
    for (const double scale : {1.0, 1e-6})
        for (int i = 0; i < 200; ++i) {
            const Polyhedron p = test::convex_polyhedron(random, scale);
            REQUIRE(why_not_convex(p) == "");
            check_both_routes(p, {test::unit_vector(random), scale * test::uniform(random, -0.5, 0.5)});
        }
}

TEST_CASE("both ways of cutting agree on planes through vertices, edges and faces", "[cut]")
{
    std::mt19937_64 random(5);
    for (const double scale : {1.0, 1e-6})
        for (int i = 0; i < 100; ++i) {
            const Polyhedron p = test::convex_polyhedron(random, scale);
            const auto vertex = [&] { return p.vertices[random() % p.vertices.size()]; };
            // one vertex
            const Vec3 n = test::unit_vector(random);
            check_both_routes(p, {n, dot(n, vertex())});
            // an edge and an inner point
            const auto& face = p.faces[random() % p.faces.size()];
            const Vec3 a = p.vertices[static_cast<std::size_t>(face[0])],
                       b = p.vertices[static_cast<std::size_t>(face[1])];
            check_both_routes(p, through(a, b, 0.1 * scale * test::unit_vector(random)));
            // two vertices, and three if they are not in line
            const Vec3 c = vertex(), d = vertex(), e = vertex();
            if (norm(c - d) > 1e-3 * scale) {
                check_both_routes(p, through(c, d, 0.1 * scale * test::unit_vector(random)));
                if (norm(cross(d - c, e - c)) > 1e-3 * scale * scale) check_both_routes(p, through(c, d, e));
            }
            // along a face, from both sides, and just inside it
            const Plane plane = p.planes[random() % p.planes.size()];
            CHECK(cut(p, plane).status == CutStatus::all_inside);
            CHECK(cut_exact(p, plane).status == CutStatus::all_inside);
            CHECK(cut(p, {-plane.normal, -plane.offset}).status == CutStatus::all_outside);
            CHECK(cut_exact(p, {-plane.normal, -plane.offset}).status == CutStatus::all_outside);
            check_both_routes(p, {plane.normal, plane.offset - 1e-6 * scale});
        }
}

TEST_CASE("planes at round-off distance from vertices do not break the clipper", "[cut]")
{
    // vertices moved out of the plane by 1e-16 to 1e-8 of the size: on it, or apart from it, but never half of each
    std::mt19937_64 random(6);
    for (int i = 0; i < 2000; ++i) {
        const Polyhedron p = test::convex_polyhedron(random);
        const auto vertex = [&] { return p.vertices[random() % p.vertices.size()]; };
        const Vec3 a = vertex(), b = vertex(), c = vertex();
        if (norm(cross(b - a, c - a)) < 1e-3) continue;
        Plane plane = through(a, b, c);
        plane.offset += test::uniform(random, -1, 1) * std::pow(10.0, test::uniform(random, -16, -8));
        plane.normal =
            normalized(plane.normal + std::pow(10.0, test::uniform(random, -16, -8)) * test::unit_vector(random));
        const double volume = mass_properties(p).volume;
        const Polyhedron below = clip(p, {plane}), above = clip(p, {{-plane.normal, -plane.offset}});
        const double v_below = mass_properties(below).volume, v_above = mass_properties(above).volume;
        REQUIRE(std::fabs(v_below + v_above - volume) < 1e-11 * volume);
        const CutResult r = cut(p, plane);
        if (r.status == CutStatus::ok)
            check_halves(p, r, plane, 1e-11);
        else  // one part is a chip or a film of round-off
            REQUIRE(std::min(v_below, v_above) < 1e-6 * volume);
    }
}

TEST_CASE("recursive cuts keep every fragment closed", "[cut]")
{
    std::mt19937_64 random(7);
    std::vector<Polyhedron> pieces{make_hexagonal_prism(0.6e-6, 1.3e-6, {1e-6, 0, 0})};
    const double volume = mass_properties(pieces[0]).volume;
    for (int generation = 0; generation < 9; ++generation) {
        std::vector<Polyhedron> next;
        for (const Polyhedron& p : pieces) {
            const Vec3 n = test::unit_vector(random);
            CutResult c = cut(p, {n, dot(n, mass_properties(p).centroid)}, generation);
            REQUIRE(c.status == CutStatus::ok);
            next.push_back(std::move(c.inside));
            next.push_back(std::move(c.outside));
        }
        pieces = std::move(next);
    }
    double sum = 0.0;
    for (const Polyhedron& p : pieces) {
        REQUIRE(why_not_convex(p) == "");
        sum += mass_properties(p).volume;
    }
    CHECK(pieces.size() == 512);
    CHECK(sum == Approx(volume).epsilon(1e-12));
}

TEST_CASE("cuts report where everything lies on one side", "[cut]")
{
    const Polyhedron box = make_box({1, 1, 1});
    CHECK(cut(box, {{1, 0, 0}, 2.0}).status == CutStatus::all_inside);
    CHECK(cut(box, {{1, 0, 0}, 2.0}).inside.faces.size() == 6);
    CHECK(cut(box, {{1, 0, 0}, -2.0}).status == CutStatus::all_outside);
    CHECK(cut(box, {{1, 0, 0}, -2.0}).inside.faces.empty());
    CHECK(cut(box, {{1, 0, 0}, -2.0}).outside.faces.size() == 6);
    CHECK(std::string(to_string(CutStatus::degenerate)) == "degenerate");
}

TEST_CASE("clips keep tags and find the common part", "[cut]")
{
    const Polyhedron a = make_box({2, 2, 2}), b = make_box({2, 2, 2}, {1, 1, 1});
    const Polyhedron common = clip(a, b, 10);
    CHECK(why_not_convex(common) == "");
    CHECK(mass_properties(common).volume == Approx(1.0).epsilon(1e-14));
    auto tags = common.face_tags;
    std::sort(tags.begin(), tags.end());
    CHECK(tags == std::vector<int>{1, 3, 5, 10, 12, 14});
    CHECK(clip(a, make_box({1, 1, 1}, {5, 0, 0})).faces.empty());
    const Polyhedron corner = clip(a, {{{1, 0, 0}, 0.5}, {{0, 1, 0}, 0.5}}, 20);
    CHECK(std::count(corner.face_tags.begin(), corner.face_tags.end(), 20) == 1);
    CHECK(std::count(corner.face_tags.begin(), corner.face_tags.end(), 21) == 1);
}

TEST_CASE("eroding a prism leaves the smaller prism", "[cut]")
{
    for (const double scale : {1.0, 1e-6}) {
        const double r = 0.6 * scale, t = 1.3 * scale, rho = 0.05 * scale;
        const Polyhedron core = erode(make_hexagonal_prism(r, t), rho);
        const Polyhedron expected = make_hexagonal_prism(r - 2 * rho / std::numbers::sqrt3, t - 2 * rho);
        CHECK(r - 2 * rho / std::numbers::sqrt3 == Approx(0.54226 * scale).epsilon(1e-5));
        CHECK(why_not_convex(core) == "");
        REQUIRE(core.vertices.size() == 12);
        REQUIRE(core.faces.size() == 8);
        for (const Vec3& v : core.vertices) {
            double nearest = scale;
            for (const Vec3& w : expected.vertices) nearest = std::min(nearest, norm(v - w));
            CHECK(nearest < 1e-15 * scale);
        }
        auto tags = core.face_tags;
        std::sort(tags.begin(), tags.end());
        CHECK(tags == std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7});
        CHECK(erode(make_hexagonal_prism(r, t), 0.55 * scale).faces.empty());
    }
    // four faces meet in the apex and must do so after erosion; a small face vanishes
    const Polyhedron pyramid = make_polyhedron({{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {0, 0, 1}},
                                               {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    const Polyhedron core = erode(pyramid, 0.1);
    CHECK(why_not_convex(core) == "");
    CHECK(core.vertices.size() == 5);
    const Polyhedron chipped = clip(make_box({2, 2, 2}), {{normalized(Vec3{1, 1, 1}), 1.7}}, 9);
    CHECK(chipped.faces.size() == 7);
    CHECK(erode(chipped, 0.1).faces.size() == 6);
}

TEST_CASE("a hundred thousand cuts with CGAL: planes through vertices, edges and faces and nearly so among them",
          "[cut][slow]")
{
    std::mt19937_64 random(12);
    int cut_clean = 0, refused = 0, missed = 0;
    for (int body = 0; body < 10000; ++body) {
        const Polyhedron p = convex_polyhedron(random);
        const double size = bounding_size(p), volume = mass_properties(p).volume;
        for (int k = 0; k < 10; ++k) {
            const auto vertex = [&] { return p.vertices[random() % p.vertices.size()]; };
            Plane plane{unit_vector(random), 0.0};
            plane.offset = dot(plane.normal, vertex()) * uniform(random, -1.0, 1.0);
            if (k % 5 == 1) plane.offset = dot(plane.normal, vertex());  // through a vertex
            if (k % 5 == 2) {  // through three vertices: edges, faces, diagonals
                const Vec3 a = vertex(), b = vertex(), c = vertex();
                const Vec3 n = cross(b - a, c - a);
                if (norm(n) > 1e-6 * size * size) plane = through(a, b, c);
            }
            if (k % 5 == 3) {  // a face, and beside it by anything from round-off to a chip
                const std::size_t f = random() % p.planes.size();
                plane = p.planes[f];
                plane.offset -= size * std::pow(10.0, uniform(random, -16.0, -2.0));
            }
            if (k % 5 == 4) {  // a face tilted a little about one of its vertices
                const std::size_t f = random() % p.planes.size();
                const Vec3 x = p.vertices[static_cast<std::size_t>(p.faces[f][0])];
                plane.normal =
                    normalized(p.planes[f].normal + std::pow(10.0, uniform(random, -14.0, -1.0)) * unit_vector(random));
                plane.offset = dot(plane.normal, x);
            }
            const CutResult c = cut_exact(p, plane);
            if (c.status == CutStatus::all_inside || c.status == CutStatus::all_outside) {
                ++missed;
                continue;
            }
            if (c.status != CutStatus::ok) {
                ++refused;
                continue;
            }
            ++cut_clean;
            const double sum = mass_properties(c.inside).volume + mass_properties(c.outside).volume;
            if (std::fabs(sum - volume) >= 1e-12 * volume) CHECK(std::fabs(sum - volume) < 1e-12 * volume);
            const std::string why = why_not_convex(c.inside) + why_not_convex(c.outside);
            if (!why.empty()) CHECK(why == "");
        }
    }
    CAPTURE(cut_clean, refused, missed);
    CHECK(cut_clean > 80000);
    CHECK(refused <= 10);
    WARN("clean cuts " << cut_clean << ", refused " << refused << ", planes that miss " << missed);
}
