// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mass_properties.h"

#include "geometry/cut.h"
#include "shapes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>

using namespace grainfrac;

namespace {

double largest(const Mat3& m)
{
    double a = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) a = std::max(a, std::fabs(m[i][j]));
    return a;
}

void check_moments(const MassProperties& m, const Vec3& expected)
{
    // expected: inertia per unit mass about the own centroid, in the prism's axes
    const Vec3 got = Vec3{m.inertia[0].x, m.inertia[1].y, m.inertia[2].z} / m.volume;
    for (int i = 0; i < 3; ++i) CHECK(got[i] == Approx(expected[i]).margin(5e-7));
}

}  // namespace

TEST_CASE("mass properties of the hexagonal prism", "[mass]")
{
    // m = 3.769289e-9 t at 3.10e-9 t/mm^3
    const MassProperties m = mass_properties(make_hexagonal_prism(0.6, 1.3));
    CHECK(m.volume == Approx(1.2158997).epsilon(1e-7));
    CHECK(3.10e-9 * m.volume == Approx(3.769289e-9).epsilon(1e-6));
    CHECK(m.inertia[2].z / m.volume == Approx(0.15).epsilon(1e-13));
    CHECK(m.inertia[0].x / m.volume == Approx(5 * 0.36 / 24 + 1.69 / 12).epsilon(1e-13));
    CHECK(m.inertia[1].y / m.volume == Approx(0.2158333).epsilon(1e-6));
    CHECK(m.principal_axes == Quat{});
    CHECK(norm(m.centroid) < 1e-15);

    const MassProperties small = mass_properties(make_hexagonal_prism(0.6e-6, 1.3e-6, {1e-6, 2e-6, 3e-6}));
    CHECK(small.volume == Approx(1e-18 * m.volume).epsilon(1e-13));
    CHECK(small.inertia[2].z == Approx(1e-30 * m.inertia[2].z).epsilon(1e-13));
    CHECK(small.principal_axes == Quat{});
    CHECK(norm(small.centroid - Vec3{1e-6, 2e-6, 3e-6}) < 1e-21);
}

TEST_CASE("mass properties do not depend on place and orientation", "[mass]")
{
    std::mt19937_64 random(3);
    for (int i = 0; i < 100; ++i) {
        const Polyhedron p = test::convex_polyhedron(random);
        const MassProperties m = mass_properties(p);
        const Quat q = test::rotation(random);
        const Vec3 shift{test::uniform(random, -1, 1), test::uniform(random, -1, 1), test::uniform(random, -1, 1)};
        const MassProperties moved = mass_properties(translated(rotated(p, q), shift));
        const double size = trace(m.inertia);
        CHECK(moved.volume == Approx(m.volume).epsilon(1e-13));
        CHECK(norm(moved.centroid - rotate(q, m.centroid) - shift) < 1e-13);
        const Mat3 r = to_matrix(q);
        CHECK(largest(moved.euler - r * m.euler * transpose(r)) < 1e-13 * size);
        CHECK(norm(moved.principal_inertia - m.principal_inertia) < 1e-13 * size);

        // the principal frame makes the tensor diagonal again, and is a rotation
        const Mat3 axes = to_matrix(m.principal_axes);
        CHECK(largest(axes * Mat3::diagonal(m.principal_inertia) * transpose(axes) - m.inertia) < 1e-13 * size);
        CHECK(dot(cross(axes[0], axes[1]), axes[2]) == Approx(1.0).epsilon(1e-13));
    }
}

TEST_CASE("slabs of the prism", "[mass][cut]")
{
    // r = t = 1; e points to a vertex, m to a flat; numbers of the closed forms
    const Polyhedron prism = make_hexagonal_prism(1.0, 1.0);
    const double volume = mass_properties(prism).volume;
    for (int variant = 0; variant < 3; ++variant) {
        const Quat back = from_axis_angle({0, 0, 1}, -variant * std::numbers::pi / 3);
        const double vertex_angle = std::numbers::pi / 2 + variant * std::numbers::pi / 3;
        const Vec3 e{std::cos(vertex_angle), std::sin(vertex_angle), 0};

        const CutResult high = cut(prism, {e, 0.5}, 50);
        const CutResult low = cut(high.inside, {-e, 0.5}, 51);
        REQUIRE(high.status == CutStatus::ok);
        REQUIRE(low.status == CutStatus::ok);
        const std::array<const Polyhedron*, 3> pieces{&high.outside, &low.inside, &low.outside};
        const double fraction[3] = {1.0 / 6, 2.0 / 3, 1.0 / 6}, place[3] = {2.0 / 3, 0.0, -2.0 / 3};
        // axes (e, e_perp, z) lie along (y, -x, z) once turned back
        const Vec3 triangle{0.097222, 0.208333, 0.138889}, rectangle{0.166667, 0.333333, 0.333333};
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(why_not_convex(*pieces[k]) == "");
            const MassProperties m = mass_properties(rotated(*pieces[k], back));
            CHECK(m.volume == Approx(fraction[k] * volume).epsilon(1e-12));
            CHECK(dot(mass_properties(*pieces[k]).centroid, e) == Approx(place[k]).margin(1e-12));
            check_moments(m, k == 1 ? rectangle : triangle);
        }
        CHECK(pieces[0]->faces.size() == 5);
        CHECK(pieces[1]->faces.size() == 6);
        CHECK(norm(area_vector(high.section)) == Approx(std::numbers::sqrt3).epsilon(1e-12));
        CHECK(norm(normalized(area_vector(high.section)) - e) < 1e-12);

        const double flat_angle = variant * std::numbers::pi / 3;
        const Vec3 flat{std::cos(flat_angle), std::sin(flat_angle), 0};
        const CutResult halves = cut(prism, {flat, 0.0}, 50);
        REQUIRE(halves.status == CutStatus::ok);
        CHECK(norm(area_vector(halves.section)) == Approx(2.0).epsilon(1e-12));
        for (const Polyhedron* half : {&halves.inside, &halves.outside}) {
            CHECK(why_not_convex(*half) == "");
            CHECK(half->faces.size() == 6);
            const MassProperties m = mass_properties(*half);
            CHECK(m.volume == Approx(0.5 * volume).epsilon(1e-12));
            CHECK(std::fabs(dot(m.centroid, flat)) == Approx(2.0 / (3.0 * std::numbers::sqrt3)).epsilon(1e-12));
            check_moments(mass_properties(rotated(*half, back)), {0.291667, 0.143519, 0.268519});
        }
    }
    check_moments(mass_properties(prism), {0.291667, 0.291667, 0.416667});

    // parallel axes: pieces add up to the prism
    const CutResult high = cut(prism, {{0, 1, 0}, 0.5});
    const CutResult low = cut(high.inside, {{0, -1, 0}, 0.5});
    Mat3 euler;
    for (const Polyhedron* piece : {&high.outside, &low.inside, &low.outside}) {
        const MassProperties m = mass_properties(*piece);
        euler = euler + m.euler + m.volume * Mat3::outer(m.centroid, m.centroid);
    }
    CHECK(largest(euler - mass_properties(prism).euler) < 1e-12 * volume);
}

TEST_CASE("Steiner's volume of a dilated core", "[mass]")
{
    CHECK(dilated_volume(make_hexagonal_prism(0.5, 1.0), 0.05) == Approx(0.884630).margin(5e-7));
    CHECK(dilated_volume(make_hexagonal_prism(0.5e-6, 1e-6), 0.05e-6) == Approx(0.884630e-18).epsilon(1e-6));
    CHECK(mass_properties(make_hexagonal_prism(0.5 + 0.1 / std::numbers::sqrt3, 1.1)).volume ==
          Approx(0.888997).margin(5e-7));
    // box a b c: abc + 2 rho (ab + bc + ca) + pi rho^2 (a + b + c) + 4/3 pi rho^3
    const double rho = 0.3;
    CHECK(dilated_volume(make_box({1, 2, 3}), rho) ==
          Approx(6 + 22 * rho + std::numbers::pi * rho * rho * 6 + 4.0 / 3 * std::numbers::pi * rho * rho * rho)
              .epsilon(1e-14));
}
