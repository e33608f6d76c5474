// SPDX-License-Identifier: GPL-3.0-or-later
// Any bond law over all bonds of its kind: forces into slots, damage, breakage, energy.
#pragma once

#include "model/model.h"
#include "model/state.h"

#include <vector>

namespace grainfrac {

/// Bonds of all kinds at the present positions; damage, dissipation and retirement advance by one step of dt.
void bond_forces(const Model& model, State& state, double dt);
/// The same for some of them, without a step in time, on the host.
void bond_forces(const Model& model, State& state, const std::vector<int>& interfaces,
                 const std::vector<int>& parallels, const std::vector<int>& sphere_bonds);

/// The kind between spheres: sphere_bond_forces.cpp; all of them, or some, one after the other on the host.
void sphere_bond_forces(const Model& model, State& state, double dt);
void sphere_bond_forces(const Model& model, State& state, const std::vector<int>& bonds, double dt = 0.0);

/// Incremental bonds need a first normal; call once when bonds are made.
void start_bonds(const Model& model, State& state);

}  // namespace grainfrac
