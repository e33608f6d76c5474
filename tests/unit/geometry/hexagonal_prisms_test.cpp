// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/hexagonal_prisms.h"

#include "geometry/cut.h"
#include "geometry/mass_properties.h"
#include "geometry/shared_faces.h"
#include "shapes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <stdexcept>

using namespace grainfrac;

namespace {

HexagonalPrismSpec box_spec(const Vec3& size, double side, double thickness)
{
    HexagonalPrismSpec spec;
    spec.side = side;
    spec.thickness = thickness;
    spec.region.size = size;
    spec.region.center = 0.5 * size;
    return spec;
}

HexagonalPrismSpec disc_spec(double diameter, double height, double side, double thickness)
{
    HexagonalPrismSpec spec;
    spec.side = side;
    spec.thickness = thickness;
    spec.region.shape = Region::Shape::cylinder;
    spec.region.diameter = diameter;
    spec.region.height = height;
    spec.region.center = {0.5 * diameter, 0.5 * diameter, 0.5 * height};
    return spec;
}

/// Cells are convex, not slivers, and fill the region.
void check_fill(const HexagonalPrismSpec& spec)
{
    const std::vector<Polyhedron> cells = hexagonal_prism_cells(spec);
    const double whole = 1.5 * std::numbers::sqrt3 * spec.side * spec.side * spec.thickness;
    double sum = 0.0;
    for (const Polyhedron& p : cells) {
        REQUIRE(why_not_convex(p) == "");
        const double volume = mass_properties(p).volume;
        CHECK(volume >= spec.sliver_fraction * whole * (1 - 1e-9));
        sum += volume;
    }
    const Polyhedron region = region_polyhedron(spec.region);
    CHECK(sum == Approx(mass_properties(region).volume).epsilon(1e-12));

    // surface: what is not shared is the region's
    double shared = 0.0, surface = 0.0;
    for (const SharedFace& s : find_shared_faces(cells)) shared += 2.0 * norm(area_vector(s.polygon));
    for (const Polyhedron& p : cells) surface += surface_area(p);
    CHECK(surface - shared == Approx(surface_area(region)).epsilon(1e-9));
}

}  // namespace

TEST_CASE("nominal lattices have the published numbers of grains", "[lattice]")
{
    for (const double scale : {1.0, 1e-3, 1e-6}) {
        CHECK(hexagonal_prism_cells(box_spec({5 * scale, 10 * scale, 1.3 * scale}, 0.6 * scale, 1.3 * scale)).size() ==
              44);
        CHECK(hexagonal_prism_cells(box_spec({20 * scale, 5 * scale, 1.3 * scale}, 0.6 * scale, 1.3 * scale)).size() ==
              95);
        CHECK(hexagonal_prism_cells(disc_spec(15 * scale, 5 * scale, 0.6 * scale, 5 * scale)).size() == 187);
        CHECK(hexagonal_prism_cells(disc_spec(156 * scale, 10 * scale, 6.75 * scale, 10 * scale)).size() == 160);
        CHECK(hexagonal_prism_cells(disc_spec(156 * scale, 10 * scale, 6.80 * scale, 10 * scale)).size() == 160);
    }
    const LatticeCounts n = nominal_counts({5, 10, 5}, 0.6, 5);
    CHECK(n.columns == 4);
    CHECK(n.rows == 11);
    CHECK(n.layers == 1);
    CHECK(nominal_counts({15, 15, 5.2}, 0.6, 1.3).columns == 14);
    CHECK(nominal_counts({15, 15, 5.2}, 0.6, 1.3).rows == 16);
    CHECK(nominal_counts({15, 15, 5.2}, 0.6, 1.3).layers == 4);
    CHECK(nominal_counts({15, 15, 1.0}, 0.6, 1.3).layers == 1);
}

TEST_CASE("size of the nominal tiles", "[lattice]")
{
    const auto extent = [](const std::vector<Polyhedron>& cells) {
        Vec3 low = cells[0].vertices[0], high = low;
        for (const Polyhedron& p : cells)
            for (const Vec3& v : p.vertices)
                for (int i = 0; i < 3; ++i) {
                    low[i] = std::min(low[i], v[i]);
                    high[i] = std::max(high[i], v[i]);
                }
        return high - low;
    };
    const Vec3 a = extent(hexagonal_prism_cells(box_spec({5, 10, 1.3}, 0.6, 1.3)));
    CHECK(a.x == Approx(4.677).margin(5e-4));
    CHECK(a.y == Approx(10.2).epsilon(1e-12));
    const Vec3 b = extent(hexagonal_prism_cells(box_spec({20, 5, 1.3}, 0.6, 1.3)));
    CHECK(b.x == Approx(20.265).margin(5e-4));
    CHECK(b.y == Approx(4.8).epsilon(1e-12));
}

TEST_CASE("contained lattice stays inside", "[lattice]")
{
    HexagonalPrismSpec spec = box_spec({5, 10, 2.6}, 0.6, 1.3);
    spec.lattice = LatticeMode::contained;
    CHECK(hexagonal_prism_cells(spec).size() == 80);
    spec.region.size.z = 1.3;
    CHECK(hexagonal_prism_cells(spec).size() == 40);
    spec.stacking = Stacking::hollow;
    spec.region.size.z = 2.6;
    spec.region.center.z = 1.3;
    for (const Polyhedron& p : hexagonal_prism_cells(spec))
        for (const Vec3& v : p.vertices) {
            CHECK(std::fabs(v.x - 2.5) < 2.5 + 1e-9);
            CHECK(std::fabs(v.y - 5.0) < 5.0 + 1e-9);
            CHECK(std::fabs(v.z - 1.3) < 1.3 + 1e-9);
        }
    HexagonalPrismSpec disc = disc_spec(15, 1.3, 0.6, 1.3);
    disc.lattice = LatticeMode::contained;
    for (const Polyhedron& p : hexagonal_prism_cells(disc))
        for (const Vec3& v : p.vertices) CHECK(std::hypot(v.x - 7.5, v.y - 7.5) < 7.5 + 1e-7);
}

TEST_CASE("a centred lattice has a prism on the region's centre", "[lattice]")
{
    for (const BoundaryMode boundary : {BoundaryMode::keep, BoundaryMode::cut}) {
        HexagonalPrismSpec spec = disc_spec(15, 2.6, 0.7, 1.3);
        spec.boundary = boundary;
        spec.lattice = boundary == BoundaryMode::cut ? LatticeMode::fill : LatticeMode::nominal;
        spec.centered = true;
        double nearest = 1e300, volume = 0.0;
        for (const LatticeCell& c : hexagonal_prism_lattice(spec)) {
            nearest = std::min(nearest, std::hypot(c.site.x - 7.5, c.site.y - 7.5));
            volume += mass_properties(c.shape).volume;
        }
        CHECK(nearest < 1e-12);
        if (boundary == BoundaryMode::cut)
            CHECK(volume == Approx(mass_properties(region_polyhedron(spec.region)).volume).epsilon(1e-12));
    }
    // symmetric about the centre: what is kept comes in pairs
    HexagonalPrismSpec spec = disc_spec(15, 1.3, 0.6, 1.3);
    spec.centered = true;
    const std::vector<LatticeCell> cells = hexagonal_prism_lattice(spec);
    for (const LatticeCell& c : cells) {
        CHECK(std::any_of(cells.begin(), cells.end(), [&](const LatticeCell& o) {
            return std::hypot(o.site.x + c.site.x - 15.0, o.site.y + c.site.y - 15.0) < 1e-9;
        }));
    }
}

TEST_CASE("layers follow the stacking", "[lattice]")
{
    const double r = 0.6, t = 1.3;
    HexagonalPrismSpec spec = box_spec({5, 10, 3 * t}, r, t);
    const std::vector<std::pair<Stacking, Vec3>> cases{{Stacking::columnar, {0, 0, t}},
                                                       {Stacking::half, {0.5 * std::numbers::sqrt3 * r, 0, t}},
                                                       {Stacking::hollow, {0.5 * std::numbers::sqrt3 * r, 0.5 * r, t}}};
    for (const auto& [stacking, shift] : cases) {
        spec.stacking = stacking;
        const std::vector<Polyhedron> cells = hexagonal_prism_cells(spec);
        REQUIRE(cells.size() == 3 * 44);
        const Vec3 c0 = mass_properties(cells[0]).centroid;
        CHECK(norm(c0 - Vec3{std::numbers::sqrt3 * r, r, 0.5 * t}) < 1e-12);
        CHECK(norm(mass_properties(cells[44]).centroid - c0 - shift) < 1e-12);
        CHECK(norm(mass_properties(cells[88]).centroid - c0 - Vec3{0, 0, 2 * t}) < 1e-12);
    }
}

TEST_CASE("cut lattices fill the region", "[lattice]")
{
    for (const double scale : {1.0, 1e-6})
        for (const Stacking stacking : {Stacking::columnar, Stacking::half, Stacking::hollow}) {
            HexagonalPrismSpec box = box_spec({5 * scale, 10 * scale, 3.3 * scale}, 0.6 * scale, 1.3 * scale);
            box.boundary = BoundaryMode::cut;
            box.stacking = stacking;
            check_fill(box);
            HexagonalPrismSpec disc = disc_spec(15 * scale, 2.6 * scale, 0.6 * scale, 1.3 * scale);
            disc.boundary = BoundaryMode::cut;
            disc.stacking = stacking;
            check_fill(disc);
            disc.region.facets = 97;
            disc.region.axis = {0, 1, 0};
            disc.region.diameter = 6 * scale;
            disc.region.height = 4 * scale;
            check_fill(disc);
            disc.region.axis = normalized(Vec3{1, 2, 3});
            disc.region.center = {0.1 * scale, 0.2 * scale, 0.3 * scale};
            check_fill(disc);
        }
}

TEST_CASE("cut lattices of many sizes fill the region", "[lattice]")
{
    // the surface meets the lattice in every way, along flats and vertices too
    std::mt19937_64 random(11);
    for (int i = 0; i < 40; ++i) {
        const Vec3 size{test::uniform(random, 0.5, 6), test::uniform(random, 0.5, 6), test::uniform(random, 0.3, 4)};
        HexagonalPrismSpec spec = box_spec(size, 0.6, 1.3);
        spec.boundary = BoundaryMode::cut;
        spec.stacking = static_cast<Stacking>(i % 3);
        spec.sliver_fraction = i % 4 == 0 ? 0.0 : test::uniform(random, 0.01, 0.4);
        if (i % 5 == 0) spec.region.size.x = std::numbers::sqrt3 * 0.6 * 3;
        if (i % 5 == 1) spec.region.size.y = 0.6 * 3.5;
        double sum = 0.0;
        for (const Polyhedron& p : hexagonal_prism_cells(spec)) {
            REQUIRE(why_not_convex(p) == "");
            sum += mass_properties(p).volume;
        }
        CHECK(sum == Approx(spec.region.size.x * spec.region.size.y * spec.region.size.z).epsilon(1e-12));
    }
}

TEST_CASE("a thin last slab joins the one below", "[lattice]")
{
    HexagonalPrismSpec spec = box_spec({5, 5, 2.65}, 0.6, 1.3);
    spec.boundary = BoundaryMode::cut;
    const std::vector<Polyhedron> cells = hexagonal_prism_cells(spec);
    double high = 0.0;
    for (const Polyhedron& p : cells) {
        Vec3 low = p.vertices[0], top = low;
        for (const Vec3& v : p.vertices) {
            low.z = std::min(low.z, v.z);
            top.z = std::max(top.z, v.z);
        }
        high = std::max(high, top.z - low.z);
    }
    CHECK(high == Approx(1.35).epsilon(1e-12));
    check_fill(spec);
}

TEST_CASE("tags tell the region's faces from grain boundaries", "[lattice]")
{
    HexagonalPrismSpec spec = disc_spec(15, 1.3, 0.6, 1.3);
    spec.boundary = BoundaryMode::cut;
    double curved = 0.0, ends = 0.0;
    for (const Polyhedron& p : hexagonal_prism_cells(spec))
        for (std::size_t f = 0; f < p.faces.size(); ++f) {
            const double area = norm(area_vector(face_polygon(p, static_cast<int>(f))));
            const int tag = p.face_tags[f];
            CHECK(((tag >= 0 && tag <= 8) || (tag >= 1000 && tag < 1096) || tag == 2000 || tag == 2001));
            curved += tag >= 1000 && tag < 1096 ? area : 0.0;
            ends += tag >= 2000 ? area : 0.0;
        }
    const double n = 96, tangent = std::tan(std::numbers::pi / n);
    CHECK(curved == Approx(n * 15 * tangent * 1.3).epsilon(1e-11));
    CHECK(ends == Approx(2 * n * 7.5 * 7.5 * tangent).epsilon(1e-11));
}

TEST_CASE("impossible lattices are refused with the length at fault", "[lattice]")
{
    HexagonalPrismSpec spec = box_spec({5, 10, 1.3}, -0.6, 1.3);
    CHECK_THROWS_WITH(hexagonal_prism_cells(spec), Catch::Contains("side"));
    spec.side = 6.0;
    CHECK_THROWS_WITH(hexagonal_prism_cells(spec), Catch::Contains("side 6 m"));
    spec.side = 0.6;
    spec.thickness = 0.0;
    CHECK_THROWS_AS(hexagonal_prism_cells(spec), std::invalid_argument);
    CHECK_THROWS_WITH(hexagonal_prism_cells(spec), Catch::Contains("thickness"));
    spec.thickness = 1.3;
    spec.region.size.y = 0.0;
    CHECK_THROWS_WITH(hexagonal_prism_cells(spec), Catch::Contains("size y"));
}

TEST_CASE("a specimen of three thousand cut cells is filled", "[lattice]")
{
    // takes a quarter of a second; any cost that grows with the square of the cells would show here
    HexagonalPrismSpec spec = disc_spec(33.3, 5.2, 0.6, 1.3);
    spec.boundary = BoundaryMode::cut;
    spec.stacking = Stacking::hollow;
    const std::vector<Polyhedron> cells = hexagonal_prism_cells(spec);
    CHECK(cells.size() > 3000);
    check_fill(spec);
}
