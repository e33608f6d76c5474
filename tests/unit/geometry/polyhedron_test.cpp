// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/polyhedron.h"

#include "geometry/mass_properties.h"
#include "shapes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <set>
#include <stdexcept>

using namespace grainfrac;

namespace {

double edge_count(const Polyhedron& p)
{
    std::size_t n = 0;
    for (const auto& face : p.faces) n += face.size();
    return 0.5 * static_cast<double>(n);
}

}  // namespace

TEST_CASE("a hexagonal prism is closed, and has the dissertation's orientation", "[polyhedron]")
{
    for (const double scale : {1.0, 1e-3, 1e-6}) {
        const double r = 0.6 * scale, t = 1.3 * scale;
        const Polyhedron p = make_hexagonal_prism(r, t, {scale, -2 * scale, 3 * scale});
        CHECK(why_not_convex(p) == "");
        CHECK(p.vertices.size() == 12);
        CHECK(edge_count(p) == 18);
        CHECK(p.faces.size() == 8);

        Vec3 sum;
        double third = 0.0;
        for (int f = 0; f < 8; ++f) {
            const std::vector<Vec3> polygon = face_polygon(p, f);
            const Vec3 area = area_vector(polygon);
            sum += area;
            third += dot(area, polygon_centroid(polygon)) / 3.0;
            CHECK(p.face_tags[static_cast<std::size_t>(f)] == f);
            CHECK(norm(normalized(area) - p.planes[static_cast<std::size_t>(f)].normal) < 1e-14);
        }
        CHECK(norm(sum) < 1e-14 * r * r);
        CHECK(third == Approx(1.5 * std::numbers::sqrt3 * r * r * t).epsilon(1e-13));
        CHECK(surface_area(p) == Approx(6 * r * t + 3 * std::numbers::sqrt3 * r * r).epsilon(1e-13));
        for (int k = 0; k < 6; ++k) {
            const double angle = k * std::numbers::pi / 3;
            CHECK(norm(p.planes[static_cast<std::size_t>(k)].normal - Vec3{std::cos(angle), std::sin(angle), 0}) <
                  1e-14);
        }
        CHECK(norm(p.planes[6].normal - Vec3{0, 0, -1}) < 1e-15);
        CHECK(norm(p.planes[7].normal - Vec3{0, 0, 1}) < 1e-15);
    }
    // flats face +-x, vertices stand on +-y
    const Polyhedron p = make_hexagonal_prism(1.0, 1.0);
    double x = 0.0, y = 0.0;
    for (const Vec3& v : p.vertices) {
        x = std::max(x, v.x);
        y = std::max(y, v.y);
    }
    CHECK(x == Approx(0.5 * std::numbers::sqrt3));
    CHECK(y == Approx(1.0));
}

TEST_CASE("adjacent lattice prisms share exactly four vertices and no volume", "[polyhedron]")
{
    const double r = 0.6, t = 1.3;
    const Polyhedron a = make_hexagonal_prism(r, t);
    for (const Vec3& shift : {Vec3{std::numbers::sqrt3 * r, 0, 0}, Vec3{0.5 * std::numbers::sqrt3 * r, 1.5 * r, 0},
                              Vec3{-0.5 * std::numbers::sqrt3 * r, 1.5 * r, 0}}) {
        const Polyhedron b = translated(a, shift);
        int shared = 0;
        for (const Vec3& v : a.vertices)
            for (const Vec3& w : b.vertices) shared += norm(v - w) < 1e-14;
        CHECK(shared == 4);
        const Polyhedron common = clip(a, b);
        CHECK((common.faces.empty() || mass_properties(common).volume < 1e-14));
    }
}

TEST_CASE("boxes and prisms carry their tags", "[polyhedron]")
{
    const Polyhedron box = make_box({1, 2, 3}, {4, 5, 6});
    CHECK(why_not_convex(box) == "");
    CHECK(box.face_tags == std::vector<int>{0, 1, 2, 3, 4, 5});
    for (std::size_t f = 0; f < 6; ++f) {
        Vec3 n;
        n[static_cast<int>(f / 2)] = f % 2 ? 1.0 : -1.0;
        CHECK(norm(box.planes[f].normal - n) < 1e-15);
    }
    CHECK(box.planes[1].offset == Approx(4.5));
    CHECK(bounding_size(box) == Approx(std::sqrt(14.0)));
    CHECK(circumradius(box, {4, 5, 6}) == Approx(0.5 * std::sqrt(14.0)));
    CHECK(norm(polygon_centroid(face_polygon(box, 5)) - Vec3{4, 5, 7.5}) < 1e-14);

    const Polyhedron wedge = make_prism({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0.0, 2.0);
    CHECK(why_not_convex(wedge) == "");
    CHECK(wedge.face_tags == std::vector<int>{0, 1, 2, 3, 4});
    CHECK(wedge.planes[0].normal.y == Approx(-1.0));
    CHECK(wedge.planes[3].normal.z == Approx(-1.0));
}

TEST_CASE("moves keep vertices on their planes", "[polyhedron]")
{
    std::mt19937_64 random(1);
    for (int i = 0; i < 20; ++i) {
        const Polyhedron p = test::convex_polyhedron(random);
        const Polyhedron q = translated(rotated(p, test::rotation(random)), {3, -2, 1});
        CHECK(why_not_convex(q) == "");
        CHECK(mass_properties(q).volume == Approx(mass_properties(p).volume).epsilon(1e-13));
    }
}

TEST_CASE("faults of a polyhedron are named", "[polyhedron]")
{
    const Polyhedron good = make_box({1, 1, 1});
    Polyhedron p = good;
    p.faces.pop_back();
    p.planes.pop_back();
    p.face_tags.pop_back();
    CHECK_THAT(why_not_convex(p), Catch::Contains("open"));
    p = good;
    std::reverse(p.faces[2].begin(), p.faces[2].end());
    CHECK_THAT(why_not_convex(p), Catch::Contains("one direction"));
    p = good;
    p.vertices[0] = p.vertices[0] + Vec3{0.1, 0.05, 0.02};
    CHECK_THAT(why_not_convex(p), Catch::Contains("not planar"));
    p = good;
    p.vertices.push_back({});
    CHECK_THAT(why_not_convex(p), Catch::Contains("no face"));
    p = good;
    for (auto& face : p.faces) std::reverse(face.begin(), face.end());
    CHECK_THAT(why_not_convex(p), Catch::Contains("clockwise"));
    CHECK_THAT(why_not_convex({}), Catch::Contains("four faces"));
    // a dented box: L-shaped prism
    const Polyhedron dented = make_prism({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, 0.0, 1.0);
    CHECK_THAT(why_not_convex(dented), Catch::Contains("concave"));

    CHECK_THROWS_AS(make_polyhedron({{0, 0, 0}, {1, 0, 0}}, {{0, 1}}), std::invalid_argument);
    CHECK_THROWS_AS(make_polyhedron({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}), std::invalid_argument);
    CHECK_THROWS_AS(make_polyhedron({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 3}}), std::invalid_argument);
}

TEST_CASE("largest inscribed ball", "[polyhedron]")
{
    // unique: cube, regular tetrahedron; not unique: plate and needle keep the centre they start from
    CHECK(inscribed_ball(make_box({2, 2, 2}, {1, 2, 3})).radius == Approx(1.0).epsilon(1e-12));
    CHECK(norm(inscribed_ball(make_box({2, 2, 2}, {1, 2, 3})).center - Vec3{1, 2, 3}) < 1e-12);
    CHECK(norm(inscribed_ball(make_box({5, 4, 1}, {1, 2, 3})).center - Vec3{1, 2, 3}) < 1e-12);
    CHECK(inscribed_ball(make_hexagonal_prism(0.6e-6, 1.3e-6)).radius ==
          Approx(0.3e-6 * std::numbers::sqrt3).epsilon(1e-12));
    CHECK(inscribed_ball(make_hexagonal_prism(0.6, 0.4)).radius == Approx(0.2).epsilon(1e-12));
    const Polyhedron tetrahedron =
        make_polyhedron({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
    // r = 3 V / S
    const double r = 0.5 / (1.5 + 0.5 * std::numbers::sqrt3);
    CHECK(inscribed_ball(tetrahedron).radius == Approx(r).epsilon(1e-12));
    CHECK(norm(inscribed_ball(tetrahedron).center - Vec3{r, r, r}) < 1e-12);

    // against erosion, which leaves something just below the radius and nothing just above
    std::mt19937_64 random(2);
    for (const double scale : {1.0, 1e-6})
        for (int i = 0; i < 200; ++i) {
            const Polyhedron p = test::convex_polyhedron(random, scale);
            const InscribedBall ball = inscribed_ball(p);
            for (const Plane& plane : p.planes)
                REQUIRE(plane.offset - dot(plane.normal, ball.center) >= ball.radius * (1 - 1e-12));
            CHECK(!erode(p, ball.radius * (1 - 1e-9)).faces.empty());
            CHECK(erode(p, ball.radius * (1 + 1e-9)).faces.empty());
        }
}
