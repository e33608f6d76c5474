// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/quadrature.h"

#include "geometry/polyhedron.h"
#include "shapes.h"

#include <catch2/catch.hpp>

#include <stdexcept>

using namespace grainfrac;

namespace {

const std::vector<Vec3> rectangle{{-1, -0.5, 0}, {1, -0.5, 0}, {1, 0.5, 0}, {-1, 0.5, 0}};
const std::vector<Vec3> pentagon{{0, 0, 0}, {2, 0.1, 0}, {2.6, 1.1, 0}, {1.1, 2.2, 0}, {-0.3, 1.2, 0}};
const std::vector<Vec3> trapezium{{0, 0, 0}, {3, 0.2, 0}, {2.1, 1.4, 0}, {0.3, 1.0, 0}};

std::vector<Vec3> hexagon(double r)
{
    std::vector<Vec3> polygon;
    for (int k = 0; k < 6; ++k)
        polygon.push_back({r * std::cos(k * std::numbers::pi / 3), r * std::sin(k * std::numbers::pi / 3), 0});
    return polygon;
}

std::vector<Vec3> moved(std::vector<Vec3> polygon, double scale, const Quat& q, const Vec3& shift)
{
    for (Vec3& v : polygon) v = scale * (rotate(q, v) + shift);
    return polygon;
}

/// int x^i y^j dA of a polygon in the xy plane by Green's theorem with 8-point Gauss on each edge, exact to degree 14.
double exact_moment(const std::vector<Vec3>& polygon, int i, int j)
{
    const double x[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    const double w[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    double sum = 0.0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec3 a = polygon[k], b = polygon[(k + 1) % polygon.size()];
        for (int g = 0; g < 8; ++g) {
            const double s = 0.5 * (1.0 + (g < 4 ? x[g] : -x[g - 4]));
            const Vec3 p = a + s * (b - a);
            sum += 0.5 * w[g % 4] * std::pow(p.x, i + 1) / (i + 1) * std::pow(p.y, j) * (b.y - a.y);
        }
    }
    return sum;
}

void check_second_degree(const std::vector<Vec3>& polygon, QuadratureRule rule)
{
    const PolygonMoments m = polygon_moments(polygon);
    double area = 0.0, i11 = 0.0, i22 = 0.0, i12 = 0.0, polar = 0.0;
    Vec3 first;
    for (const QuadraturePoint& q : quadrature(polygon, rule)) {
        const Vec3 d = q.position - m.centroid;
        CHECK(q.weight > 0.0);
        CHECK(std::fabs(dot(d, m.normal)) < 1e-13 * std::sqrt(m.area));
        area += q.weight;
        first += q.weight * d;
        i11 += q.weight * dot(d, m.axis1) * dot(d, m.axis1);
        i22 += q.weight * dot(d, m.axis2) * dot(d, m.axis2);
        i12 += q.weight * dot(d, m.axis1) * dot(d, m.axis2);
        polar += q.weight * norm2(d);
    }
    CHECK(area == Approx(m.area).epsilon(1e-13));
    CHECK(norm(first) < 1e-13 * m.area * std::sqrt(m.area));
    CHECK(i11 == Approx(m.i1).epsilon(1e-13));
    CHECK(i22 == Approx(m.i2).epsilon(1e-13));
    CHECK(std::fabs(i12) < 1e-13 * m.area * m.area);
    CHECK(polar == Approx(m.i1 + m.i2).epsilon(1e-13));
}

}  // namespace

TEST_CASE("moments of polygons", "[quadrature]")
{
    std::mt19937_64 random(8);
    for (const double scale : {1.0, 1e-6})
        for (int i = 0; i < 10; ++i) {
            const Quat q = i == 0 ? Quat{} : test::rotation(random);
            const Vec3 shift = i == 0 ? Vec3{} : test::unit_vector(random);
            const double s2 = scale * scale, s4 = s2 * s2;

            PolygonMoments m = polygon_moments(moved(rectangle, scale, q, shift));
            CHECK(m.area == Approx(2 * s2).epsilon(1e-13));
            CHECK(norm(m.centroid - scale * shift) < 1e-13 * scale);
            CHECK(std::max(m.i1, m.i2) == Approx(8.0 / 12 * s4).epsilon(1e-13));
            CHECK(std::min(m.i1, m.i2) == Approx(2.0 / 12 * s4).epsilon(1e-13));

            const double r = 0.7;
            m = polygon_moments(moved(hexagon(r), scale, q, shift));
            CHECK(m.area == Approx(1.5 * std::numbers::sqrt3 * r * r * s2).epsilon(1e-13));
            CHECK(m.i1 / m.area == Approx(5 * r * r / 24 * s2).epsilon(1e-13));
            CHECK(m.i2 / m.area == Approx(5 * r * r / 24 * s2).epsilon(1e-13));
            CHECK(m.i1 + m.i2 == Approx(5 * std::numbers::sqrt3 * r * r * r * r / 8 * s4).epsilon(1e-13));

            m = polygon_moments(moved(pentagon, scale, q, shift));
            const double area = exact_moment(pentagon, 0, 0);
            const double cx = exact_moment(pentagon, 1, 0) / area, cy = exact_moment(pentagon, 0, 1) / area;
            const double ixx = exact_moment(pentagon, 2, 0) - area * cx * cx;
            const double iyy = exact_moment(pentagon, 0, 2) - area * cy * cy;
            const double ixy = exact_moment(pentagon, 1, 1) - area * cx * cy;
            const double half = std::hypot(0.5 * (ixx - iyy), ixy), mean = 0.5 * (ixx + iyy);
            CHECK(m.area == Approx(area * s2).epsilon(1e-13));
            CHECK(norm(m.centroid - scale * (rotate(q, {cx, cy, 0}) + shift)) < 1e-13 * scale);
            CHECK(std::max(m.i1, m.i2) == Approx((mean + half) * s4).epsilon(1e-13));
            CHECK(std::min(m.i1, m.i2) == Approx((mean - half) * s4).epsilon(1e-13));
            CHECK(norm(cross(m.axis1, m.axis2) - m.normal) < 1e-14);
            CHECK(norm(m.normal - rotate(q, {0, 0, 1})) < 1e-14);
        }
}

TEST_CASE("every rule has the exact area, centroid and second moments", "[quadrature]")
{
    using Rule = QuadratureRule;
    std::mt19937_64 random(9);
    for (const Rule rule :
         {Rule::automatic, Rule::cross, Rule::fan3, Rule::fan7, Rule::gauss2, Rule::gauss3, Rule::gauss4, Rule::gauss6,
          Rule::gauss8, Rule::lobatto3, Rule::lobatto4, Rule::lobatto5, Rule::lobatto6, Rule::lobatto8})
        for (const auto& polygon : {rectangle, pentagon, trapezium, hexagon(0.6)})
            for (const double scale : {1.0, 1e-6}) {
                // the lowest degrees here, 2-point Gauss and 3-point Lobatto, are 3: the linear Jacobian of a general
                // quadrilateral takes one of them
                check_second_degree(moved(polygon, scale, test::rotation(random), test::unit_vector(random)), rule);
            }
}

TEST_CASE("number of points and degree", "[quadrature]")
{
    using Rule = QuadratureRule;
    CHECK(quadrature(rectangle, Rule::automatic).size() == 16);
    CHECK(quadrature(pentagon, Rule::automatic).size() == 21);
    CHECK(quadrature(hexagon(1), Rule::fan7).size() == 25);
    CHECK(quadrature(hexagon(1), Rule::fan3).size() == 12);
    CHECK(quadrature(hexagon(1), Rule::cross).size() == 4);
    CHECK(quadrature(hexagon(1), Rule::gauss8).size() == 25);
    CHECK(quadrature(rectangle, Rule::lobatto6).size() == 36);
    CHECK_THROWS_AS(quadrature({{0, 0, 0}, {1, 0, 0}}, Rule::cross), std::invalid_argument);
    CHECK_THROWS_AS(quadrature({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, Rule::cross), std::invalid_argument);

    const auto check_degree = [](const std::vector<Vec3>& polygon, Rule rule, int degree) {
        for (int i = 0; i <= degree; ++i)
            for (int j = 0; i + j <= degree; ++j) {
                double sum = 0.0, size = 0.0;
                for (const QuadraturePoint& q : quadrature(polygon, rule)) {
                    const double term = q.weight * std::pow(q.position.x, i) * std::pow(q.position.y, j);
                    sum += term;
                    size += std::fabs(term);
                }
                CHECK(std::fabs(sum - exact_moment(polygon, i, j)) < 1e-13 * size);
            }
    };
    check_degree(pentagon, Rule::fan7, 3);
    check_degree(rectangle, Rule::gauss2, 3);
    check_degree(rectangle, Rule::gauss4, 7);
    check_degree(rectangle, Rule::lobatto4, 5);
    check_degree(rectangle, Rule::lobatto8, 12);
    check_degree(trapezium, Rule::gauss4, 6);
}

TEST_CASE("peak moment of a brittle rectangle in bending", "[quadrature]")
{
    // strength sigma_c at each point, stiffness equal: peak of the moment over sigma_c I/(b/2), by the order in which
    // the points of one line fail; Gauss 2..8: 1.73 1.29 1.16 1.07 1.04, Lobatto 3..8: 2.00 1.35 1.19 1.12 1.06
    using Rule = QuadratureRule;
    const std::vector<Vec3> square{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    const auto first_failure = [&](Rule rule) {
        double far = 0.0;
        for (const QuadraturePoint& q : quadrature(square, rule)) far = std::max(far, q.position.x);
        return 1.0 / far;  // moment at which the outermost point reaches the strength
    };
    CHECK(first_failure(Rule::gauss2) == Approx(1.73).margin(0.005));
    CHECK(first_failure(Rule::gauss3) == Approx(1.29).margin(0.005));
    CHECK(first_failure(Rule::gauss4) == Approx(1.16).margin(0.005));
    CHECK(first_failure(Rule::gauss6) == Approx(1.07).margin(0.005));
    CHECK(first_failure(Rule::gauss8) == Approx(1.04).margin(0.005));
    CHECK(first_failure(Rule::lobatto4) == Approx(1.0));
}
