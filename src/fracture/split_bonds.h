// SPDX-License-Identifier: GPL-3.0-or-later
// Bonds of grains that are split: boundary interfaces are shared out between the parts, new surfaces join the parts.
#pragma once

#include "fracture/parting.h"
#include "geometry/quadrature.h"

#include <vector>

namespace grainfrac {

/// The surface that a split makes: n from part 2 (a) to part 1 (b), so that its traction acts on part 2.
struct CutSurface {
    int a = 0, b = 0;
    std::vector<Vec3> polygon;            ///< in space [m]
    Vec3 normal;                          ///< [-]
    std::vector<QuadraturePoint> points;  ///< in space
    SplitRules rules;
    double K_I = 0.0, K_II = 0.0;  ///< of the flaw that ran [Pa sqrt(m)]
    int interface = -1;            ///< its index, once it is there
};
CutSurface surface_of(const Parting& parting);

/// Hands every interface of a split grain to the part that it touches, cut where it touches both, and adds the new
/// surfaces, which carry nothing yet. Placements of the bodies must be those of the parts. Returns, for each interface,
/// which it was before; -1 for what was shared out or is new.
std::vector<int> divide_interfaces(const Model& model, State& state, const std::vector<Parting>& partings,
                                   std::vector<CutSurface>& surfaces);

/// Lets a new surface begin with the tractions on part 2 at its points [Pa]: offsets, onset there, energy inserted.
void load_surface(const Model& model, State& state, const CutSurface& surface, const std::vector<Vec3>& traction);

/// Parallel bonds go whole to the part where their centre lies. Returns, for each, which it was before.
std::vector<int> divide_parallel_bonds(State& state, const std::vector<Parting>& partings);

}  // namespace grainfrac
