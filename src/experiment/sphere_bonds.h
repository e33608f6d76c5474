// SPDX-License-Identifier: GPL-3.0-or-later
// Bonds of the input between spheres, and the interfaces of fibres.
#pragma once

#include "experiment/laws.h"
#include "generate/spheres.h"
#include "geometry/shared_faces.h"
#include "model/case.h"
#include "model/model.h"
#include "model/state.h"

#include <vector>

namespace grainfrac {

/// A bond for each pair of spheres that the table bonds with law parallel or spring and that touch, and for neighbours
/// in a chain. `first_body`: of the first sphere. Throws InputError where "auto" cannot mean anything.
void bond_spheres(const Case& c, Model& model, State& state, const std::vector<SphereSpec>& spheres, int first_body,
                  const BondTable& table);

/// Patches of the interfaces of all fibres that the table bonds.
std::vector<SharedFace> fibre_patches(const Case& c, const Model& model, const State& state,
                                      const std::vector<SphereSpec>& spheres, int first_body, const BondTable& table);

/// What an interface of a fibre has besides: the pressure on it, and how far it can slide before it has left the
/// matrix. After the interfaces are made.
void finish_fibre_interfaces(const Case& c, State& state, const std::vector<SphereSpec>& spheres, int first_body,
                             const BondTable& table);

}  // namespace grainfrac
