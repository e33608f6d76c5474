// SPDX-License-Identifier: GPL-3.0-or-later
// What output tells of a bond, whatever its kind: where its face is now, what it carries, and why it failed. Bonds are
// named by their slots; see State::for_each_bond_kind.
#pragma once

#include "geometry/mat3.h"
#include "model/state.h"

#include <cstdint>
#include <vector>

namespace grainfrac {

enum class BondKind { interface = 0, parallel = 1, sphere = 2 };
enum class CrackCause { none = -1, tension = 0, shear = 1, mixed = 2 };
enum class BondStage { whole = 0, damaged = 1, broken = 2, retired = 3 };

struct BondFacts {
    BondKind kind = BondKind::interface;
    std::int32_t a = 0, b = 0;  ///< bodies
    BondStage stage = BondStage::whole;
    /// Of an interface that failed: the share of mode II in its damage, averaged over the face, below 1/3 is tension,
    /// above 2/3 shear. `none` before.
    CrackCause cause = CrackCause::none;
    double area = 0.0;                                     ///< as made [m^2]
    double radius = 0.0;                                   ///< of a circular section; 0: an interface [m]
    double damage = 0.0;                                   ///< [-]
    double normal_stiffness = 0.0, shear_stiffness = 0.0;  ///< per area [Pa/m]
    double stored_energy = 0.0, fracture_work = 0.0;       ///< [J]
    double first_damage_time = -1.0, failure_time = -1.0;  ///< -1 before; what breaks at once has one time [s]
    bool transgranular = false;                            ///< within what was one grain
    double K_I = 0.0, K_II = 0.0;                          ///< of the flaw that split the grain [Pa sqrt(m)]
};
BondFacts bond_facts(const State& state, int slot);
/// Of all bonds, by slot.
std::vector<BondFacts> all_bond_facts(const State& state);

/// The face of a bond in space, mean of its two sides.
struct BondFace {
    std::vector<Vec3> polygon;  ///< counter-clockwise seen from b; a circular bond's disc is a 16-gon [m]
    Vec3 center;                ///< of the polygon; contact point of a circular bond [m]
    Vec3 normal;                ///< unit, from a to b [-]
    double opening = 0.0;       ///< area mean of the normal jump, positive where the sides part [m]
    double area = 0.0;          ///< of the bond as made [m^2]
};
BondFace bond_face(const State& state, int slot);

/// What b does to a through a bond, dashpots included; tension is positive.
struct BondLoad {
    double normal_force = 0.0, shear_force = 0.0;              ///< [N]
    double bending_moment = 0.0, twisting_moment = 0.0;        ///< about the centre of the face [N m]
    double normal_stress = 0.0, shear_stress = 0.0;            ///< means [Pa]
    double peak_normal_stress = 0.0, peak_shear_stress = 0.0;  ///< at the rim of a circular section, else NaN [Pa]
};
BondLoad bond_load(const State& state, int slot, const BondFacts& facts, const BondFace& face);

/// Area-weighted mean damage of the bonds of each body, 0 for bodies without [-].
std::vector<double> mean_bond_damage(const State& state);

}  // namespace grainfrac
