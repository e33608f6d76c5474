// SPDX-License-Identifier: GPL-3.0-or-later
// Bonds of the input between spheres.
#pragma once

#include "experiment/laws.h"
#include "generate/spheres.h"
#include "model/case.h"
#include "model/model.h"
#include "model/state.h"

#include <vector>

namespace grainfrac {

/// A bond for each pair of spheres that the table bonds with law parallel or spring and that touch, and for neighbours
/// in a chain. `first_body`: of the first sphere. Throws InputError where "auto" cannot mean anything.
void bond_spheres(const Case& c, Model& model, State& state, const std::vector<SphereSpec>& spheres, int first_body,
                  const BondTable& table);

}  // namespace grainfrac
