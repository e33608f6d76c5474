// SPDX-License-Identifier: GPL-3.0-or-later
// Lattices against counts of their theta series, neighbours and the close-packed density; fibres against closed forms.
#include "generate/packings.h"

#include "generate/fibre_line.h"
#include "generate/lattice.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

using namespace grainfrac;

namespace {

RegionSpec cylinder(double diameter, double height, const char* axis = "z")
{
    RegionSpec r;
    r.shape = "cylinder";
    r.diameter = diameter;
    r.height = height;
    r.axis = axis;
    return r;
}
RegionSpec box_at(const Vec3& center, const Vec3& size)
{
    RegionSpec r;
    r.center = center;
    r.size = size;
    return r;
}
RegionSpec ball(double diameter, const Vec3& center = {})
{
    RegionSpec r;
    r.shape = "sphere";
    r.center = center;
    r.diameter = diameter;
    return r;
}

/// How many sites lie nearer than `reach` to the site nearest to x, itself left out.
int neighbours(const std::vector<Vec3>& sites, const Vec3& x, double reach)
{
    const Vec3 c = *std::min_element(sites.begin(), sites.end(),
                                     [&](const Vec3& a, const Vec3& b) { return norm(a - x) < norm(b - x); });
    return static_cast<int>(
               std::count_if(sites.begin(), sites.end(), [&](const Vec3& s) { return norm(s - c) < reach; })) -
           1;
}

/// Smallest distance of two sites.
double nearest(const std::vector<Vec3>& sites)
{
    double d = 1e300;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) d = std::min(d, norm(sites[i] - sites[j]));
    }
    return d;
}

/// A case of one packing and one fibre.
Case fibre_case()
{
    Case c;
    c.materials = {{.name = "matrix", .density = 1.0}, {.name = "steel", .density = 1.0}};
    PartSpec m;
    m.name = "m";
    m.kind = "spheres";
    m.material = "matrix";
    m.generator = "hcp";
    m.diameter = 1.0;
    m.region = cylinder(12.0, 30.0);
    PartSpec f = m;
    f.name = "f";
    f.material = "steel";
    f.generator = "chain";
    f.inside = "m";
    f.fibre.from = {0, 0, -18.0 * std::sqrt(2.0 / 3.0)};
    f.fibre.to = -f.fibre.from;
    f.fibre.spacing = std::sqrt(2.0 / 3.0);
    f.fibre.radius = 1.0;
    c.parts = {m, f};
    return c;
}

std::map<int, int> count_by_group(const std::vector<SphereSpec>& spheres)
{
    std::map<int, int> n;
    for (const SphereSpec& s : spheres) ++n[s.group];
    return n;
}

}  // namespace

TEST_CASE("hexagonal close packing in a cylinder: levels and places", "[packings]")
{
    // Within R of a site of the triangular lattice: i^2 + i j + j^2 <= R^2; of a hollow: i^2 + i j + j^2 + i + j + 1/3.
    const int R = 6;
    int on_site = 0, on_hollow = 0;
    for (int i = -9; i <= 9; ++i) {
        for (int j = -9; j <= 9; ++j) {
            const int q = i * i + i * j + j * j;
            on_site += q <= R * R ? 1 : 0;
            on_hollow += 3 * (q + i + j) + 1 <= 3 * R * R ? 1 : 0;
        }
    }
    REQUIRE(on_site == 127);  // 1 + 6 (1 + 1 + 1 + 2 + ...) of the hexagonal theta series, rim included
    for (const char* const axis : {"x", "y", "z"}) {
        const int k = axis_index(axis);
        std::vector<Vec3> sites = hcp_sites(SphereRegion(cylinder(12.0, 30.0, axis)), 1.0, k);
        const double h = std::sqrt(2.0 / 3.0);
        std::map<int, int> levels;
        for (const Vec3& x : sites) {
            const double level = x[k] / h + 18.0;
            CHECK(std::fabs(level - std::round(level)) < 1e-12);
            ++levels[static_cast<int>(std::lround(level))];
        }
        REQUIRE(levels.size() == 37);  // round(30/0.8165)
        for (const auto& [level, count] : levels) CHECK(count == (level % 2 == 0 ? on_site : on_hollow));
        CHECK(levels.begin()->first == 0);
        CHECK(neighbours(sites, {0, 0, 0}, 1.0 + 1e-9) == 12);
        CHECK(neighbours(sites, {0, 0, 0}, 1.0 - 1e-9) == 0);
        CHECK(neighbours(sites, {0, 0, 0}, std::sqrt(2.0) + 1e-9) == 18);        // HCP: 12, then 6
        CHECK(neighbours(sites, {0, 0, 0}, std::sqrt(8.0 / 3.0) + 1e-9) == 20);  // 2 at sqrt(8/3); FCC has none there
    }
}

TEST_CASE("face-centred cubic: counts, neighbours, density", "[packings]")
{
    RegionSpec box = box_at({1, 2, 3}, {});
    for (const int m : {3, 4, 9}) {  // planes on either side of the middle; the outermost lie on the surface
        box.size = std::sqrt(2.0) * 0.3 * m * Vec3{1, 1, 1};
        const std::vector<Vec3> sites = fcc_sites(SphereRegion(box), 0.3);
        const int n = 2 * m + 1, odd = m % 2 == 0 ? 1 : -1;  // sum of (-1)^i over -m..m
        CHECK(static_cast<int>(sites.size()) == (n * n * n + odd) / 2);
        CHECK(neighbours(sites, box.center, 0.3 * (1.0 + 1e-9)) == 12);
        CHECK(neighbours(sites, box.center, 0.3 * (std::sqrt(2.0) + 1e-9)) == 18);
        CHECK(neighbours(sites, box.center, 0.3 * (std::sqrt(3.0) + 1e-9)) == 42);
        CHECK(norm(*std::min_element(sites.begin(), sites.end(), [&](const Vec3& a, const Vec3& b) {
                  return norm(a - box.center) < norm(b - box.center);
              }) - box.center) == 0.0);
    }
    // pi/(3 sqrt 2) of the volume, but for the skin: a sphere of radius R holds 4/3 pi R^3 sqrt(2)/d^3 sites to ~ R/d
    const double expected = 4.0 / 3.0 * std::numbers::pi * 8000.0 * std::sqrt(2.0);
    CHECK(static_cast<double>(fcc_sites(SphereRegion(ball(40.0)), 1.0).size()) == Approx(expected).epsilon(2e-3));
    CHECK(static_cast<double>(hcp_sites(SphereRegion(ball(40.0)), 1.0, 1).size()) == Approx(expected).epsilon(2e-3));
}

TEST_CASE("close packings have no two spheres that overlap, in any region", "[packings]")
{
    for (const RegionSpec& r : {box_at({}, {3, 4, 5}), cylinder(5.0, 4.0, "x"), ball(5.0, {-1, 0, 2})}) {
        const SphereRegion region(r);
        for (int axis = 0; axis < 3; ++axis) CHECK(nearest(hcp_sites(region, 0.7, axis)) == Approx(0.7).epsilon(1e-12));
        CHECK(nearest(fcc_sites(region, 0.7)) == Approx(0.7).epsilon(1e-12));
    }
}

TEST_CASE("the shift that brings a sphere into a region", "[packings]")
{
    const SphereRegion box(box_at({1, 0, 0}, {2, 4, 6}));
    CHECK(box.shift_inside({5, -3, 1}, 0.5) == Vec3{-3.5, 1.5, 0});
    CHECK(box.volume() == 48.0);
    CHECK(box.surface() == 88.0);
    const SphereRegion can(cylinder(4.0, 6.0, "y"));
    CHECK(norm(can.shift_inside({3, 9, 4}, 0.5) - Vec3{-2.1, -6.5, -2.8}) < 1e-14);
    CHECK(can.shift_inside({0.1, 2.75, 0.2}, 0.5) == Vec3{0, -0.25, 0});
    CHECK(can.surface() == Approx(32.0 * std::numbers::pi));
    const SphereRegion round(ball(4.0));
    CHECK(norm(round.shift_inside({0, 3, 4}, 1.0) - Vec3{0, -2.4, -3.2}) < 1e-14);
    CHECK(round.shift_inside({0.1, 0.2, 0.3}, 1.0) == Vec3{});
    CHECK(round.contains({0, 0, 2}));
    CHECK_FALSE(round.contains({0, 0, 2.0001}));
}

TEST_CASE("a straight chain: equal pieces from end to end", "[packings]")
{
    FibreSpec f;
    f.from = {1, 2, 3};
    f.to = {1, 2, 13};
    const FibreNodes nodes = fibre_nodes(f, 0.7);  // 10/0.7 = 14.3: 14 pieces
    REQUIRE(nodes.position.size() == 15);
    CHECK(nodes.piece == Approx(10.0 / 14).epsilon(1e-15));
    CHECK(nodes.position.front() == f.from);
    CHECK(nodes.position.back() == f.to);
    for (std::size_t i = 0; i < 15; ++i)
        CHECK(norm(nodes.position[i] - Vec3{1, 2, 3.0 + 10.0 * static_cast<double>(i) / 14}) < 1e-14);
}

TEST_CASE("a wavy chain: arc length of the sine is an elliptic integral", "[packings]")
{
    FibreSpec f;
    f.shape = "wavy";
    f.from = {0, 0, 1};
    f.to = {0, 0, 9};
    f.amplitude = 0.5;
    f.wavelength = 4.0;
    f.sideways = {0, 2, 7};  // only its part across the fibre counts
    const double slope = f.amplitude * 2.0 * std::numbers::pi / f.wavelength, b = std::sqrt(1.0 + slope * slope);
    const double wave = 2.0 / std::numbers::pi * f.wavelength * b * std::comp_ellint_2(slope / b);
    const FibreNodes nodes = fibre_nodes(f, wave / 16.0);
    REQUIRE(nodes.position.size() == 33);
    CHECK(nodes.piece == Approx(wave / 16.0).epsilon(1e-12));
    for (std::size_t i = 0; i <= 32; i += 4) {  // crests, nodes and troughs are whole quarters of a wave
        const double quarter = static_cast<double>(i) / 4;
        const Vec3 expected{0, 0.5 * std::sin(0.5 * std::numbers::pi * quarter), 1.0 + quarter};
        CHECK(norm(nodes.position[i] - expected) < 1e-7);  // a crest is found to the root of round-off
    }
    for (const Vec3& x : nodes.position) CHECK(distance_to_polyline(x, fibre_polyline(f)) < 1e-4 * f.amplitude);
}

TEST_CASE("a hooked chain and one from point to point", "[packings]")
{
    FibreSpec f;
    f.shape = "hooked";
    f.from = {0, 0, 0};
    f.to = {10, 0, 0};
    f.sideways = {3, 1, 0};
    f.hook_length = 2.0;
    f.hook_angle = std::numbers::pi / 6.0;
    const double c = std::sqrt(3.0), s = 1.0;  // 2 cos, 2 sin
    const std::vector<Vec3> line = fibre_polyline(f);
    REQUIRE(line.size() == 4);
    CHECK(norm(line[0] - Vec3{-2.0 - c, s, 0}) < 1e-15);
    CHECK(norm(line[1] - Vec3{-c, s, 0}) < 1e-15);
    const FibreNodes nodes = fibre_nodes(f, 0.5);
    REQUIRE(nodes.position.size() == 29);  // 14 m
    CHECK(norm(nodes.position[4] - line[1]) < 1e-14);
    CHECK(norm(nodes.position[8] - f.from) < 1e-14);
    CHECK(norm(nodes.position[28] - f.to) < 1e-14);

    f.shape = "points";
    f.points = {{0, 0, 0}, {3, 0, 0}, {3, 4, 0}};
    const FibreNodes bent = fibre_nodes(f, 1.0);
    REQUIRE(bent.position.size() == 8);
    CHECK(norm(bent.position[3] - Vec3{3, 0, 0}) < 1e-14);
    CHECK(norm(bent.position[5] - Vec3{3, 2, 0}) < 1e-14);
}

TEST_CASE("the matrix makes room for a fibre", "[packings]")
{
    Case c = fibre_case();
    const std::vector<SphereSpec> alone = [&] {
        Case matrix = c;
        matrix.parts.pop_back();
        return generate_spheres(matrix);
    }();
    const std::vector<SphereSpec> all = generate_spheres(c);
    // d = a = 1: a level with a site on the axis loses it (the next lie on the surface, and stay), one with a hollow
    // there loses 3. 19 and 18 levels.
    std::map<int, int> n = count_by_group(all);
    CHECK(n[0] == static_cast<int>(alone.size()) - 19 - 3 * 18);
    REQUIRE(n[1] == 37);
    for (int i = 0; i < 37; ++i) {
        const SphereSpec& s = all[all.size() - 37 + static_cast<std::size_t>(i)];
        CHECK(norm(s.position - Vec3{0, 0, (i - 18) * std::sqrt(2.0 / 3.0)}) < 1e-12);
        CHECK(s.chain == 0);
        CHECK(s.material == 1);
        CHECK(s.section_radius == 1.0);
        // the fibre ends at its first and last node
        CHECK(s.piece == Approx((i % 36 == 0 ? 0.5 : 1.0) * std::sqrt(2.0 / 3.0)).epsilon(1e-12));
    }
    CHECK(all.front().chain == -1);
    CHECK(all.front().piece == 0.0);

    SECTION("only where it is, and its spheres' radius where no section is told")
    {
        c.parts[1].fibre.from.z = 0.0;
        c.parts[1].fibre.radius.reset();
        n = count_by_group(generate_spheres(c));
        CHECK(n[0] == static_cast<int>(alone.size()) - 10);  // sites on the axis at levels 0, 2, ..., 18; radius 0.5
        CHECK(n[1] == 19);
    }
    SECTION("copies are chains of their own")
    {
        c.parts[1].copies = {{3, 0, 0}, {-3, 0, 0}};
        const std::vector<SphereSpec> three = generate_spheres(c);
        n = count_by_group(three);
        CHECK(n[0] == static_cast<int>(alone.size()) - 3 * (19 + 3 * 18));
        CHECK(n[1] == 3 * 37);
        CHECK(three.back().chain == 2);
        CHECK(three.back().position.x == -3.0);
        CHECK(three[three.size() - 38].chain == 1);
    }
    SECTION("a fibre of the lattice itself is taken from it")
    {
        c.parts[1].generator = "taken";
        c.parts[1].region = cylinder(1.9, 40.0);
        const std::vector<SphereSpec> lattice = generate_spheres(c);
        CHECK(lattice.size() == alone.size());
        n = count_by_group(lattice);
        CHECK(n[1] == 19 + 3 * 18);
        CHECK(lattice.back().material == 1);
        CHECK(lattice.back().radius == 0.5);
        CHECK(lattice.back().chain == -1);
        std::swap(c.parts[0], c.parts[1]);  // order of the file
        CHECK(generate_spheres(c).front().group == 0);
        CHECK(count_by_group(generate_spheres(c))[0] == 19 + 3 * 18);
    }
}

TEST_CASE("points of the lattice in the section of a fibre", "[packings]")
{
    // Fibre of radius 1 m in the HCP matrix of the pull-out, c along it: 7 or 3 points a level at d = 1 m, 7 at 0.7 m,
    // 19 or, without those on the surface, 13 at 0.5 m.
    const auto levels = [](double d, double radius) {
        Case c = fibre_case();
        c.parts[0].diameter = d;
        c.parts[1].generator = "taken";
        c.parts[1].region = cylinder(2.0 * radius, 30.0);
        std::map<int, int> count;  // by the number of the level
        const double h = std::sqrt(2.0 / 3.0) * d;
        const std::vector<SphereSpec> spheres = generate_spheres(c);
        const double bottom = spheres[0].position.z;  // of the matrix: that level has spheres left
        for (const SphereSpec& s : spheres) {
            if (s.group == 1) ++count[static_cast<int>(std::lround((s.position.z - bottom) / h))];
        }
        return std::pair(count[0], count[1]);
    };
    CHECK(levels(1.0, 1.0) == std::pair(7, 3));
    CHECK(levels(0.7, 1.0).first == 7);
    CHECK(levels(0.5, 1.0).first == 19);
    CHECK(levels(0.5, 0.999).first == 13);
}

TEST_CASE("a wavy fibre takes just the spheres that are near to it", "[packings]")
{
    Case c = fibre_case();
    PartSpec &m = c.parts[0], &f = c.parts[1];
    m.generator = "random_dense";
    m.region = cylinder(8.0, 12.0);
    m.size_ratio = 2.0;
    m.solid_fraction = 0.5;
    f.fibre.shape = "wavy";
    f.fibre.from = {0, 0, -4};
    f.fibre.to = {0, 0, 4};
    f.fibre.amplitude = 0.6;
    f.fibre.wavelength = 5.0;
    const Vec3 shift{0.5, 2.1, 0};
    f.copies = {shift};
    const auto distance = [&](const Vec3& x) {  // from the sine itself, in steps of 0.4 mm
        double least = 1e300;
        for (int k = 0; k <= 20000; ++k) {
            const double u = 8.0 * k / 20000;
            const Vec3 p{0.6 * std::sin(2.0 * std::numbers::pi * u / 5.0), 0, u - 4.0};
            least = std::min({least, norm2(x - p), norm2(x - p - shift)});
        }
        return std::sqrt(least);
    };
    std::vector<SphereSpec> with = generate_spheres(c);
    std::erase_if(with, [](const SphereSpec& s) { return s.group == 1; });
    c.parts.pop_back();
    const std::vector<SphereSpec> without = generate_spheres(c);
    std::size_t left = 0;
    for (const SphereSpec& s : without) {
        const double d = distance(s.position);
        const bool stays = left < with.size() && with[left].position == s.position;
        if (std::fabs(d - 1.0) > 1e-4)
            CHECK(stays == (d > 1.0));  // chords of the sine are off by 1e-4 of its amplitude
        left += stays ? 1 : 0;
    }
    CHECK(left == with.size());
    CHECK(without.size() > with.size() + 40);
}
