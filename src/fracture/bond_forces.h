// SPDX-License-Identifier: GPL-3.0-or-later
// Any bond law over all bonds of its kind: forces into slots, damage, breakage, energy.
#pragma once

#include "model/model.h"
#include "model/state.h"

#include <vector>

namespace grainfrac {

/// A dead interface goes over to general contact once it has slid this share of its diameter [-]: by then its points no
/// longer lie face to face. Larger keeps stale points, smaller hands over while the old law is still the better one.
inline constexpr double retirement_slip = 0.2;

/// Interface and parallel bonds at the present positions; damage, dissipation and retirement advance by one step of dt.
void bond_forces(const Model& model, State& state, double dt);
/// The same for some of them, without a step in time, on the host.
void bond_forces(const Model& model, State& state, const std::vector<int>& interfaces,
                 const std::vector<int>& parallels);

/// Incremental parallel bonds need a first normal; call once when bonds are made.
void start_bonds(const Model& model, State& state);

}  // namespace grainfrac
