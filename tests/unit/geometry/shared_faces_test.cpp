// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/shared_faces.h"

#include "generate/hexagonal_prisms.h"
#include "geometry/cut.h"
#include "shapes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>

using namespace grainfrac;

namespace {

std::vector<Polyhedron> lattice(Stacking stacking, double scale, BoundaryMode boundary = BoundaryMode::keep)
{
    HexagonalPrismSpec spec;
    spec.side = 0.6 * scale;
    spec.thickness = 1.3 * scale;
    spec.stacking = stacking;
    spec.boundary = boundary;
    spec.region.size = {6 * scale, 7 * scale, 3.9 * scale};
    return hexagonal_prism_cells(spec);
}

double area(const SharedFace& s)
{
    return norm(area_vector(s.polygon));
}

}  // namespace

TEST_CASE("overlap fractions of a basal face", "[shared_faces]")
{
    // columnar {1}; half {5/12, 5/12, 1/12, 1/12}; hollow {1/3, 1/3, 1/3}
    const double r = 0.6, hexagon = 1.5 * std::numbers::sqrt3 * r * r;
    const std::vector<std::pair<Stacking, std::vector<double>>> cases{
        {Stacking::columnar, {1.0}},
        {Stacking::half, {1.0 / 12, 1.0 / 12, 5.0 / 12, 5.0 / 12}},
        {Stacking::hollow, {1.0 / 3, 1.0 / 3, 1.0 / 3}}};
    for (const double scale : {1.0, 1e-6})
        for (const auto& [stacking, expected] : cases) {
            const std::vector<Polyhedron> cells = lattice(stacking, scale);
            std::map<std::pair<int, int>, std::vector<double>> parts;  // of each basal face
            for (const SharedFace& s : find_shared_faces(cells)) {
                if (std::fabs(s.normal.z) < 0.5) continue;
                parts[{s.a, s.face_a}].push_back(area(s) / (hexagon * scale * scale));
                parts[{s.b, s.face_b}].push_back(area(s) / (hexagon * scale * scale));
            }
            int interior = 0;
            for (auto& [face, fractions] : parts) {
                if (fractions.size() != expected.size()) continue;  // at the rim
                std::sort(fractions.begin(), fractions.end());
                double sum = 0.0;
                for (std::size_t k = 0; k < fractions.size(); ++k) {
                    CHECK(fractions[k] == Approx(expected[k]).epsilon(1e-12));
                    sum += fractions[k];
                }
                CHECK(sum == Approx(1.0).epsilon(1e-12));
                ++interior;
            }
            CHECK(interior >= 10);
        }
}

TEST_CASE("partners of an interior cell cover its faces", "[shared_faces]")
{
    for (const double scale : {1.0, 1e-6})
        for (const Stacking stacking : {Stacking::columnar, Stacking::half, Stacking::hollow})
            for (const BoundaryMode boundary : {BoundaryMode::keep, BoundaryMode::cut}) {
                const std::vector<Polyhedron> cells = lattice(stacking, scale, boundary);
                const std::vector<SharedFace> shared = find_shared_faces(cells);
                std::vector<std::vector<double>> covered;
                for (const Polyhedron& p : cells) covered.emplace_back(p.faces.size(), 0.0);
                for (std::size_t k = 0; k < shared.size(); ++k) {
                    const SharedFace& s = shared[k];
                    REQUIRE(s.a < s.b);
                    if (k > 0) {
                        const SharedFace& before = shared[k - 1];
                        REQUIRE(std::tuple(before.a, before.b, before.face_a, before.face_b) <
                                std::tuple(s.a, s.b, s.face_a, s.face_b));
                    }
                    const auto a = static_cast<std::size_t>(s.a), b = static_cast<std::size_t>(s.b);
                    const auto fa = static_cast<std::size_t>(s.face_a), fb = static_cast<std::size_t>(s.face_b);
                    covered[a][fa] += area(s);
                    covered[b][fb] += area(s);
                    CHECK(norm(s.normal - cells[a].planes[fa].normal) < 1e-12);
                    CHECK(dot(s.normal, area_vector(s.polygon)) == Approx(area(s)).epsilon(1e-12));
                    if (std::fabs(s.normal.z) < 0.5) CHECK(s.polygon.size() == 4);
                }
                for (std::size_t i = 0; i < cells.size(); ++i)
                    for (std::size_t f = 0; f < cells[i].faces.size(); ++f) {
                        const double whole = norm(area_vector(face_polygon(cells[i], static_cast<int>(f))));
                        if (boundary == BoundaryMode::cut) {
                            // a face is the region's or wholly covered
                            if (cells[i].face_tags[f] >= 1000)
                                CHECK(covered[i][f] == 0.0);
                            else
                                CHECK(std::fabs(covered[i][f] - whole) < 1e-12 * surface_area(cells[i]));
                        } else {
                            CHECK(covered[i][f] < whole * (1 + 1e-12));
                        }
                    }
            }
}

TEST_CASE("a gap, a tilt and a touch along an edge are no shared faces", "[shared_faces]")
{
    const Polyhedron a = make_box({1, 1, 1});
    const auto count = [&](const Polyhedron& b) { return find_shared_faces({a, b}).size(); };
    CHECK(count(translated(a, {1, 0, 0})) == 1);
    CHECK(count(translated(a, {1 + 1e-10, 0, 0})) == 1);
    CHECK(count(translated(a, {1 + 1e-7, 0, 0})) == 0);
    CHECK(count(translated(a, {1, 1, 0})) == 0);
    CHECK(count(translated(a, {1, 0.25, 0.5})) == 1);
    CHECK(count(translated(rotated(a, from_axis_angle({0, 0, 1}, 1e-3)), {1, 0, 0})) == 0);
    CHECK(area(find_shared_faces({a, translated(a, {1, 0.25, 0.5})})[0]) == Approx(0.375).epsilon(1e-14));
    CHECK(find_shared_faces({}).empty());
    SharedFaceOptions loose;
    loose.plane_tolerance = 1e-3;
    CHECK(find_shared_faces({a, translated(a, {1 + 1e-4, 0, 0})}, loose).size() == 1);
}

TEST_CASE("halves of a cut share the section", "[shared_faces]")
{
    std::mt19937_64 random(10);
    for (int i = 0; i < 200; ++i) {
        const double scale = i % 2 ? 1.0 : 1e-6;
        const Polyhedron p = test::convex_polyhedron(random, scale);
        const CutResult c = cut(p, {test::unit_vector(random), scale * test::uniform(random, -0.2, 0.2)});
        REQUIRE(c.status == CutStatus::ok);
        const std::vector<SharedFace> shared = find_shared_faces({c.inside, c.outside});
        REQUIRE(shared.size() == 1);
        CHECK(area(shared[0]) == Approx(norm(area_vector(c.section))).epsilon(1e-12));
        CHECK(shared[0].polygon.size() == c.section.size());
    }
}

TEST_CASE("common part of polygons", "[shared_faces]")
{
    const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    std::vector<Vec3> turned{{0.5, 0, 0}, {0.5, 1, 0}, {1.5, 1, 0}, {1.5, 0, 0}};  // clockwise
    const Vec3 up{0, 0, 1};
    CHECK(area_vector(intersect_polygons(square, turned, up)).z == Approx(0.5).epsilon(1e-14));
    CHECK(area_vector(intersect_polygons(turned, square, up)).z == Approx(-0.5).epsilon(1e-14));
    CHECK(intersect_polygons(square, square, up).size() == 4);
    const std::vector<Vec3> diamond{{0.5, -0.25, 0}, {1.25, 0.5, 0}, {0.5, 1.25, 0}, {-0.25, 0.5, 0}};
    CHECK(area_vector(intersect_polygons(square, diamond, up)).z == Approx(1 - 4 * 0.5 * 0.0625).epsilon(1e-14));
    for (Vec3& v : turned) v.x += 1.0;
    CHECK(intersect_polygons(square, turned, up).empty());
}
