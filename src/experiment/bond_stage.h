// SPDX-License-Identifier: GPL-3.0-or-later
// Bonds made in the course of a run, between faces of grains that have come to lie against each other.
#pragma once

#include "experiment/experiment.h"
#include "motion/energy.h"

namespace grainfrac {

struct BondsMade {
    int number = 0;
    double area = 0.0;            ///< [m^2]
    double removed_energy = 0.0;  ///< kinetic, and elastic of contacts [J]
    Momentum before;              ///< what the grains moved with [kg m/s]
};

/// Bond all faces of two grains that look at each other across a gap or overlap within `plan.distance`, unless bonds
/// between the two still act; over their common polygon, half-way between them, with the present positions as those
/// without stress. All grains and walls come to rest, all contacts are free of force as they are. Forces are brought up
/// to date; the energy that goes is booked as inserted, negative. Bonds from before keep what they carry.
/// Throws InputError if a bond could not soften (check_snap_back).
BondsMade make_bonds(Model& model, State& state, const BondsToMake& plan, std::int64_t seed);

}  // namespace grainfrac
