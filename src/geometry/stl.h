// SPDX-License-Identifier: GPL-3.0-or-later
// Triangulated surfaces from STL files, and the flat convex facets that they consist of.
#pragma once

#include "geometry/vec3.h"

#include <array>
#include <string>
#include <vector>

namespace grainfrac {

struct TriangleMesh {
    std::vector<Vec3> vertices;                 ///< welded: no two are closer than weld_tolerance [unit of the file]
    std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise from outside
};

/// Vertices closer than this share of the surface's size are one: STL repeats every corner, with six digits or so.
inline constexpr double weld_tolerance = 1e-6;

/// ASCII or binary, told apart by what they hold. Throws std::runtime_error that says why the file is none.
TriangleMesh read_stl(const std::string& file);

/// Why a surface has a border ("3 edges belong to one triangle only"); empty if every edge joins two triangles.
std::string why_not_closed(const TriangleMesh& mesh);

/// Polygons that make up the surface: neighbours in one plane are one polygon where that is convex and has no more than
/// `most_corners` corners, so that nothing is felt of the edges between them; else as few convex ones as a greedy merge
/// leaves. Counter-clockwise from outside. Triangles without area are left out.
std::vector<std::vector<Vec3>> convex_facets(const TriangleMesh& mesh, int most_corners);

}  // namespace grainfrac
