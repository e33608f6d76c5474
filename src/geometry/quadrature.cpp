// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/quadrature.h"

#include "geometry/polyhedron.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>

namespace grainfrac {

namespace {

/// Second moments that differ by less than this share count as equal: the first edge then gives the axes.
constexpr double isotropic_tolerance = 1e-12;
/// Newton steps for the roots of Legendre polynomials of degree <= 8; four are enough for the last bit.
constexpr int newton_steps = 20;

/// Points and weights on [-1, 1].
struct LineRule {
    std::vector<double> x, w;
};

struct Legendre {
    double value, slope;
    double previous;  ///< of degree n - 1
};

Legendre legendre(int n, double x)
{
    double before = 1.0, now = x;
    for (int k = 2; k <= n; ++k) {
        const double after = ((2 * k - 1) * x * now - (k - 1) * before) / k;
        before = now;
        now = after;
    }
    return {now, n * (x * now - before) / (x * x - 1.0), before};
}

LineRule gauss_rule(int n)
{
    LineRule rule;
    for (int i = 0; i < n; ++i) {
        double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
        for (int k = 0; k < newton_steps; ++k) {
            const Legendre p = legendre(n, x);
            x -= p.value / p.slope;
        }
        const double slope = legendre(n, x).slope;
        rule.x.push_back(x);
        rule.w.push_back(2.0 / ((1.0 - x * x) * slope * slope));
    }
    return rule;
}

/// Ends and the roots of P'_{n-1}, weights 2/(n (n-1) P_{n-1}(x)^2).
LineRule lobatto_rule(int n)
{
    LineRule rule;
    const int m = n - 1;
    for (int i = 0; i < n; ++i) {
        double x = -std::cos(std::numbers::pi * i / m);
        if (i > 0 && i < m) {
            for (int k = 0; k < newton_steps; ++k) {
                const Legendre p = legendre(m, x);
                const double curvature = (2.0 * x * p.slope - m * (m + 1) * p.value) / (1.0 - x * x);
                x -= p.slope / curvature;
            }
        } else {
            x = i == 0 ? -1.0 : 1.0;
        }
        const double value = (i == 0 || i == m) ? 1.0 : legendre(m, x).value;
        rule.x.push_back(x);
        rule.w.push_back(2.0 / (n * m * value * value));
    }
    return rule;
}

LineRule line_rule(QuadratureRule rule)
{
    switch (rule) {
        case QuadratureRule::gauss2:
            return gauss_rule(2);
        case QuadratureRule::gauss3:
            return gauss_rule(3);
        case QuadratureRule::gauss6:
            return gauss_rule(6);
        case QuadratureRule::gauss8:
            return gauss_rule(8);
        case QuadratureRule::lobatto3:
            return lobatto_rule(3);
        case QuadratureRule::lobatto4:
            return lobatto_rule(4);
        case QuadratureRule::lobatto5:
            return lobatto_rule(5);
        case QuadratureRule::lobatto6:
            return lobatto_rule(6);
        case QuadratureRule::lobatto8:
            return lobatto_rule(8);
        default:
            return gauss_rule(4);  // gauss4 and automatic
    }
}

/// x(s, t) = sum of v_k N_k(s, t) with the bilinear N_k; its Jacobian is positive on a convex quadrilateral.
std::vector<QuadraturePoint> tensor_points(const std::vector<Vec3>& quad, const LineRule& rule)
{
    const Vec3 n = normalized(area_vector(quad));
    std::vector<QuadraturePoint> points;
    for (std::size_t i = 0; i < rule.x.size(); ++i)
        for (std::size_t j = 0; j < rule.x.size(); ++j) {
            const double s0 = 0.5 * (1 - rule.x[i]), s1 = 0.5 * (1 + rule.x[i]);
            const double t0 = 0.5 * (1 - rule.x[j]), t1 = 0.5 * (1 + rule.x[j]);
            const Vec3 x = t0 * (s0 * quad[0] + s1 * quad[1]) + t1 * (s0 * quad[3] + s1 * quad[2]);
            const Vec3 along_s = 0.5 * (t0 * (quad[1] - quad[0]) + t1 * (quad[2] - quad[3]));
            const Vec3 along_t = 0.5 * (s0 * (quad[3] - quad[0]) + s1 * (quad[2] - quad[1]));
            points.push_back({x, rule.w[i] * rule.w[j] * dot(n, cross(along_s, along_t))});
        }
    return points;
}

/// Triangles (centroid, v_k, v_k+1); a point that two triangles share is listed once with both weights.
struct FanWeights {
    double corner, midside, middle;  ///< of a triangle's area
};
constexpr FanWeights midside_rule{0.0, 1.0 / 3.0, 0.0};
constexpr FanWeights seven_point_rule{1.0 / 20.0, 2.0 / 15.0, 9.0 / 20.0};

std::vector<QuadraturePoint> fan_points(const std::vector<Vec3>& polygon, const PolygonMoments& m, const FanWeights& w)
{
    const std::size_t n = polygon.size();
    std::vector<double> area(n);
    for (std::size_t k = 0; k < n; ++k)
        area[k] = 0.5 * dot(m.normal, cross(polygon[k] - m.centroid, polygon[(k + 1) % n] - m.centroid));
    std::vector<QuadraturePoint> points;
    if (w.corner > 0.0) points.push_back({m.centroid, w.corner * m.area});
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 &a = polygon[k], &b = polygon[(k + 1) % n];
        const double both = area[(k + n - 1) % n] + area[k];
        if (w.corner > 0.0) points.push_back({a, w.corner * both});
        points.push_back({0.5 * (m.centroid + a), w.midside * both});
        points.push_back({0.5 * (a + b), w.midside * area[k]});
        if (w.middle > 0.0) points.push_back({(m.centroid + a + b) / 3.0, w.middle * area[k]});
    }
    return points;
}

std::vector<QuadraturePoint> cross_points(const PolygonMoments& m)
{
    const Vec3 d1 = std::sqrt(2.0 * m.i1 / m.area) * m.axis1, d2 = std::sqrt(2.0 * m.i2 / m.area) * m.axis2;
    const double w = 0.25 * m.area;
    return {{m.centroid + d1, w}, {m.centroid - d1, w}, {m.centroid + d2, w}, {m.centroid - d2, w}};
}

/// First side that is not of zero length, in the plane.
Vec3 first_direction(const std::vector<Vec3>& polygon, const Vec3& normal)
{
    for (std::size_t k = 1; k < polygon.size(); ++k) {
        const Vec3 e = tangential(polygon[k] - polygon[0], normal);
        if (norm2(e) > 0.0) return normalized(e);
    }
    return any_perpendicular(normal);
}

}  // namespace

double least_width(const PolygonMoments& m)
{
    return std::sqrt(12.0 * std::min(m.i1, m.i2) / m.area);
}

PolygonMoments polygon_moments(const std::vector<Vec3>& polygon)
{
    PolygonMoments m;
    const Vec3 area = area_vector(polygon);
    m.area = norm(area);
    m.normal = normalized(area);
    m.centroid = polygon_centroid(polygon);
    const Vec3 e1 = first_direction(polygon, m.normal), e2 = cross(m.normal, e1);

    // triangles (0, a, b) about the centroid: int x_i x_j = A/12 (a_i a_j + b_i b_j + (a_i + b_i)(a_j + b_j))
    double i11 = 0.0, i22 = 0.0, i12 = 0.0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec3 a = polygon[k] - m.centroid, b = polygon[(k + 1) % polygon.size()] - m.centroid;
        const double a1 = dot(a, e1), a2 = dot(a, e2), b1 = dot(b, e1), b2 = dot(b, e2);
        const double w = (a1 * b2 - a2 * b1) / 24.0;
        i11 += w * (a1 * a1 + b1 * b1 + (a1 + b1) * (a1 + b1));
        i22 += w * (a2 * a2 + b2 * b2 + (a2 + b2) * (a2 + b2));
        i12 += w * (a1 * a2 + b1 * b2 + (a1 + b1) * (a2 + b2));
    }
    double angle = 0.0;
    if (std::max(std::fabs(i12), 0.5 * std::fabs(i11 - i22)) > isotropic_tolerance * (i11 + i22))
        angle = 0.5 * std::atan2(2.0 * i12, i11 - i22);
    const double c = std::cos(angle), s = std::sin(angle);
    m.axis1 = c * e1 + s * e2;
    m.axis2 = c * e2 - s * e1;
    m.i1 = c * c * i11 + 2.0 * c * s * i12 + s * s * i22;
    m.i2 = s * s * i11 - 2.0 * c * s * i12 + c * c * i22;
    return m;
}

std::vector<QuadraturePoint> quadrature(const std::vector<Vec3>& polygon, QuadratureRule rule)
{
    if (polygon.size() < 3) throw std::invalid_argument("quadrature: a polygon needs three vertices");
    const PolygonMoments m = polygon_moments(polygon);
    if (!(m.area > 0.0)) throw std::invalid_argument("quadrature: the polygon has zero area");
    if (rule == QuadratureRule::centroid) return {{m.centroid, m.area}};
    if (rule == QuadratureRule::cross) return cross_points(m);
    if (rule == QuadratureRule::fan3) return fan_points(polygon, m, midside_rule);
    if (rule == QuadratureRule::fan7 || polygon.size() != 4) return fan_points(polygon, m, seven_point_rule);
    return tensor_points(polygon, line_rule(rule));
}

}  // namespace grainfrac
