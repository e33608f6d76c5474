// SPDX-License-Identifier: GPL-3.0-or-later
// Quadrature points on a planar convex polygon (physics/grains 7.3).
#pragma once

#include "geometry/vec3.h"

#include <string>
#include <vector>

namespace grainfrac {

enum class QuadratureRule {
    automatic,  ///< 4x4 Gauss on quadrilaterals, 7-point fans on other polygons
    cross,      ///< equimomental cross: centroid +- sqrt(2) rho_k e_k, weights A/4; exact to degree 2
    fan3,       ///< fan triangles, 3 midside points, shared points merged; degree 2
    fan7,       ///< fan triangles, vertices 1/20, midsides 2/15, centroid 9/20, shared points merged; degree 3
    centroid,   ///< one point, exact to degree 1: a patch of a fibre's surface, whose centre does not tilt
    gauss2,
    gauss3,
    gauss4,
    gauss6,
    gauss8,  ///< tensor Gauss on (bilinear) quadrilaterals; others fall back to fan7
    lobatto3,
    lobatto4,
    lobatto5,
    lobatto6,
    lobatto8,
};

struct QuadraturePoint {
    Vec3 position;        ///< [m]
    double weight = 0.0;  ///< part of the area [m^2]
};

/// First and second moments of a planar polygon about its centroid.
struct PolygonMoments {
    double area = 0.0;  ///< [m^2]
    Vec3 centroid;      ///< [m]
    Vec3 normal;        ///< unit, right-handed with the loop [-]
    Vec3 axis1, axis2;  ///< principal directions in the plane, axis1 x axis2 = normal [-]
    double i1 = 0.0;    ///< int xi1^2 dA, xi1 along axis1 [m^4]
    double i2 = 0.0;    ///< int xi2^2 dA [m^4]
};
PolygonMoments polygon_moments(const std::vector<Vec3>& polygon);
/// Short side of the rectangle with these moments [m].
double least_width(const PolygonMoments& m);

/// Points and weights of `rule` on the polygon. Throws std::invalid_argument for fewer than three vertices or zero
/// area.
std::vector<QuadraturePoint> quadrature(const std::vector<Vec3>& polygon, QuadratureRule rule);

}  // namespace grainfrac
