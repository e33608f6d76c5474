// SPDX-License-Identifier: GPL-3.0-or-later
// Where the faces of bonds are now, and why those that failed did: shared by the bond layer, the crack layer and the
// tables.
#pragma once

#include "geometry/mat3.h"
#include "model/state.h"

#include <vector>

namespace grainfrac {

/// The face of a bond in space, mean of its two sides.
struct BondFace {
    std::vector<Vec3> polygon;  ///< counter-clockwise seen from b [m]
    Vec3 normal;                ///< unit, from a to b [-]
    double opening = 0.0;       ///< area mean of the normal jump, positive where the sides part [m]
    double area = 0.0;          ///< of the bond as made [m^2]
};
BondFace interface_face(const State& state, int i);
/// The disc of a parallel bond as a 16-gon.
BondFace parallel_face(const State& state, int i);

enum class CrackCause { none = -1, tension = 0, shear = 1, mixed = 2 };
/// Of an interface that failed: the share of mode II in its damage, averaged over the face, below 1/3 is tension, above
/// 2/3 shear. `none` before.
CrackCause interface_cause(const InterfaceBonds& bonds, int i);
CrackCause parallel_cause(const ParallelBonds& bonds, int i);

enum class BondStage { whole = 0, damaged = 1, broken = 2, retired = 3 };
BondStage interface_stage(const InterfaceBonds& bonds, int i);
BondStage parallel_stage(const ParallelBonds& bonds, int i);

/// Area-weighted mean damage of the bonds of each body, 0 for bodies without [-].
std::vector<double> mean_bond_damage(const State& state);

}  // namespace grainfrac
