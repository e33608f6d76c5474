// SPDX-License-Identifier: GPL-3.0-or-later
// The shared-face search that turns a tiling of polyhedra into grain boundaries (physics/grains 4.5).
#pragma once

#include "geometry/polyhedron.h"

namespace grainfrac {

struct SharedFace {
    int a = 0, b = 0;            ///< polyhedra, a < b
    int face_a = 0, face_b = 0;  ///< their faces
    std::vector<Vec3> polygon;   ///< common polygon in space, counter-clockwise seen from b (normal from a to b) [m]
    Vec3 normal;                 ///< unit, from a to b [-]
};

struct SharedFaceOptions {
    double normal_tolerance = 1e-9;  ///< n_a . n_b < -1 + this [-]
    double plane_tolerance = 1e-9;   ///< distance of the planes over the mean size of the polyhedra [-]
    double plane_distance = 0.0;     ///< or this distance, if it is more [m]
    double area_tolerance = 1e-6;    ///< least overlap over the mean face area [-]
};

/// All pairs of faces of different polyhedra that lie against each other, sorted by (a, b, face_a, face_b). One face
/// may have several partners. Cost is near linear in the number of polyhedra (grid over bounding boxes).
std::vector<SharedFace> find_shared_faces(const std::vector<Polyhedron>& polyhedra,
                                          const SharedFaceOptions& options = {});

/// Common part of two convex polygons in one plane (Sutherland-Hodgman), wound like the first; empty if there is none.
std::vector<Vec3> intersect_polygons(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const Vec3& normal);

}  // namespace grainfrac
