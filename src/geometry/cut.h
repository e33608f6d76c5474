// SPDX-License-Identifier: GPL-3.0-or-later
// Cutting, clipping and eroding convex polyhedra.
//
// Two independent routes (design 11): `cut` is the working route for thousands of lattice cells, a half-space clipper
// in double precision; `cut_exact` classifies with CGAL's exact predicates and rebuilds both halves as convex hulls.
// The tests hold each against the other.
#pragma once

#include "geometry/polyhedron.h"

namespace grainfrac {

/// Vertices closer to the cutting plane than this share of the polyhedron's size count as lying on it. Smaller lets
/// round-off make slivers; larger moves volume visibly (volumes add up to about this, relative).
inline constexpr double on_plane_tolerance = 1e-12;
/// That tolerance as a length for one polyhedron, never below the round-off of its coordinates [m].
double on_plane_distance(const Polyhedron& p);

/// Cut p by a plane; faces made by the cut get `tag`. `degenerate` if a part is so small (about 1e-3 of p's size or
/// less, as a chip; 1e-15 in volume, as a film) that round-off makes it no convex polyhedron; both parts are then
/// empty.
CutResult cut(const Polyhedron& p, const Plane& plane, int tag = -1);
/// The same with CGAL: exact orientation of every vertex, edge intersections, convex_hull_3 with coplanar triangles
/// merged back to polygons. Slower by two orders, robust for planes through vertices, edges and faces.
CutResult cut_exact(const Polyhedron& p, const Plane& plane, int tag = -1);

/// Part of p inside all planes; the new faces of planes[i] get tag first_tag + i. Empty (no faces) if nothing is left.
Polyhedron clip(const Polyhedron& p, const std::vector<Plane>& planes, int first_tag = -1);
/// Common part of two convex polyhedra; faces from `region` get region's tags plus `tag_shift`.
Polyhedron clip(const Polyhedron& p, const Polyhedron& region, int tag_shift = 0);
/// Core of a dilated body (2.4): {x : n_f . x <= d_f - radius for all faces}. Small faces may vanish; empty if nothing
/// is left. Tags of surviving faces are kept.
Polyhedron erode(const Polyhedron& p, double radius);

}  // namespace grainfrac
