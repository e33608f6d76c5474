// SPDX-License-Identifier: GPL-3.0-or-later
// Hexagonal prism lattices (physics/grains 2.1-2.4): cells only; bodies and bonds are made of them in assemble.*
#pragma once

#include "geometry/polyhedron.h"

#include <vector>

namespace grainfrac {

enum class Stacking { columnar, half, hollow };       ///< 2.3
enum class LatticeMode { nominal, contained, fill };  ///< 2.2: the dissertation's counts; inside the box; beyond it
enum class BoundaryMode { keep, cut };                ///< whole cells with centre inside, or cut by the surface

/// Region in its own frame; placed by `center` and, for cylinders, `axis`.
struct Region {
    enum class Shape { box, cylinder } shape = Shape::box;  ///< beam is a box, disc is a cylinder
    Vec3 center;                                            ///< [m]
    Vec3 size;                                              ///< full edge lengths of the box [m]
    double diameter = 0.0;                                  ///< cylinder [m]
    double height = 0.0;                                    ///< cylinder [m]
    Vec3 axis{0, 0, 1};                                     ///< cylinder, unit [-]
    int facets = 96;                                        ///< sides of the prism that stands for the cylinder [-]
};
/// The region as a convex polyhedron, facet tags 1000 + i on curved sides and 2000/2001 on ends (box: 1000..1005).
/// The facets of a cylinder touch the circle from outside (with a multiple of four, a flat faces each of four sides),
/// so that the distance across opposite flats is the diameter.
Polyhedron region_polyhedron(const Region& region);

struct HexagonalPrismSpec {
    double side = 0.0;       ///< r, edge of the hexagon [m]
    double thickness = 0.0;  ///< t, full height of a cell [m]
    Stacking stacking = Stacking::columnar;
    LatticeMode lattice = LatticeMode::nominal;
    BoundaryMode boundary = BoundaryMode::keep;
    bool centered = false;          ///< a prism of the first layer on the region's centre; rows from the window then
    double sliver_fraction = 0.05;  ///< cut cells below this share of a whole cell give their space to their neighbours
    Region region;
};

/// A cell and the lattice site it belongs to; the distance of two sites across their face sets the bond's stiffness.
struct LatticeCell {
    Polyhedron shape;  ///< [m]
    Vec3 site;         ///< in-plane the generator of the Voronoi cell, at half the cell's height [m]
};

/// Lattice cells of the spec, in order of layer, row, column. With `keep` they are whole prisms whose centre lies
/// inside the region (`nominal` in a box: all sites of nominal_counts; `contained`: all corners inside), in as many
/// whole layers as the height holds, at least one. With `cut` the cells fill the region exactly (sum of volumes =
/// volume of region_polyhedron to 1e-12): each cell is the region within the layer's slab, cut by the bisectors to the
/// neighbouring sites of that layer; sites whose cell would be a sliver are removed, so that the neighbours grow into
/// the gap and all cells stay convex. Throws std::invalid_argument with a message that names the offending length if no
/// cell fits.
std::vector<LatticeCell> hexagonal_prism_lattice(const HexagonalPrismSpec& spec);
/// The same without sites.
std::vector<Polyhedron> hexagonal_prism_cells(const HexagonalPrismSpec& spec);

/// Site counts of the nominal lattice of the dissertation's listing (2.2) in a box a x b (columns x rows). Layers are
/// as many whole ones as fit, at least one: the listing's ceil((c + t/2)/t) would overshoot the height by up to 1.5 t.
struct LatticeCounts {
    int columns = 0, rows = 0, layers = 0;
};
LatticeCounts nominal_counts(const Vec3& box, double side, double thickness);

}  // namespace grainfrac
