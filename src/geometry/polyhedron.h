// SPDX-License-Identifier: GPL-3.0-or-later
// Convex polyhedra with planar polygonal faces: the sharp shape of a grain and the core of a dilated contact body.
#pragma once

#include "geometry/mat3.h"
#include "geometry/quat.h"

#include <string>
#include <vector>

namespace grainfrac {

/// Half-space {x : normal . x <= offset}.
struct Plane {
    Vec3 normal;          ///< unit outward normal [-]
    double offset = 0.0;  ///< normal . x on the plane [m]
};

/// Closed convex polyhedron. Face loops run counter-clockwise seen from outside; no three-vertex collinearity needed.
struct Polyhedron {
    std::vector<Vec3> vertices;           ///< [m]
    std::vector<std::vector<int>> faces;  ///< vertex indices of each face, counter-clockwise from outside
    std::vector<Plane> planes;            ///< plane of each face, unit outward normal
    std::vector<int> face_tags;           ///< where each face comes from; kept by cuts, new faces get the cut's tag
};

/// Result of a cut: hard geometry is reported, not thrown; the caller decides and nothing is lost.
enum class CutStatus {
    ok,           ///< both parts are closed convex polyhedra
    all_inside,   ///< nothing lies outside the plane: `inside` is the input
    all_outside,  ///< nothing lies inside: `inside` is empty
    degenerate,   ///< the result would not be a closed convex polyhedron of positive volume
};
const char* to_string(CutStatus status);

/// The two parts of a cut polyhedron and the polygon between them.
struct CutResult {
    CutStatus status = CutStatus::degenerate;
    Polyhedron inside;          ///< the part with normal . x <= offset
    Polyhedron outside;         ///< the part with normal . x >= offset
    std::vector<Vec3> section;  ///< the polygon between them, counter-clockwise seen along -normal [m]
};

/// Polyhedron from vertex positions and face loops; computes the planes (Newell's normal) and gives every face `tag`.
/// Throws std::invalid_argument if an index is out of range, a face has fewer than three vertices or zero area.
Polyhedron make_polyhedron(std::vector<Vec3> vertices, std::vector<std::vector<int>> faces, int tag = -1);
/// Box with the given full edge lengths, centred at `center`. Face tags 0..5 are -x +x -y +y -z +z.
Polyhedron make_box(const Vec3& size, const Vec3& center = {});
/// Regular hexagonal prism (physics/grains 2.1): flats face +-x, vertices at +-y, axis z; `side` is the edge length of
/// the hexagon, `thickness` the full height [m]. 12 vertices, 6 quads (tags 0..5 at 0, 60, ... deg), 2 hexagons
/// (tag 6 at -z, tag 7 at +z).
Polyhedron make_hexagonal_prism(double side, double thickness, const Vec3& center = {});
/// Upright prism over a convex polygon given counter-clockwise in the xy plane, from z0 to z1. Side i (tag i) starts at
/// polygon[i]; tag n is at z0, tag n + 1 at z1.
Polyhedron make_prism(const std::vector<Vec3>& polygon, double z0, double z1);

Polyhedron translated(const Polyhedron& p, const Vec3& shift);
Polyhedron rotated(const Polyhedron& p, const Quat& q);

/// Why p is not a closed convex polyhedron (open edge, Euler number, non-planar face, concave edge, zero volume); empty
/// if it is. Tolerances are relative to the polyhedron's size: 1e-9 for planarity and convexity.
std::string why_not_convex(const Polyhedron& p);

/// Area vector (area times outward normal) of a planar polygon [m^2].
Vec3 area_vector(const std::vector<Vec3>& polygon);
/// Area centroid of a planar polygon [m].
Vec3 polygon_centroid(const std::vector<Vec3>& polygon);
std::vector<Vec3> face_polygon(const Polyhedron& p, int face);
double surface_area(const Polyhedron& p);
/// Diagonal of the bounding box [m]: the length that tolerances refer to.
double bounding_size(const Polyhedron& p);
/// Radius of the largest inscribed ball [m] and its centre (Chebyshev centre).
struct InscribedBall {
    Vec3 center;
    double radius = 0.0;
};
InscribedBall inscribed_ball(const Polyhedron& p);
/// Largest distance of a vertex from `from` [m].
double circumradius(const Polyhedron& p, const Vec3& from);

}  // namespace grainfrac
