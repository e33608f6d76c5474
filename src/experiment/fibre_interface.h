// SPDX-License-Identifier: GPL-3.0-or-later
// The interface between fibres and their matrix: its patches by the input's bonds, and what they need to know of the
// fibre.
#pragma once

#include "experiment/laws.h"
#include "generate/fibre_surface.h"
#include "generate/spheres.h"
#include "geometry/shared_faces.h"
#include "model/case.h"
#include "model/model.h"
#include "model/state.h"

#include <vector>

namespace grainfrac {

/// Chains of a part, as bodies at their start; they follow each other in the order of its copies.
std::vector<FibreChain> fibre_chains(const Case& c, const State& state, int group);

/// Distance of the layers along the axis in which the bodies of a group lie; 0 if they do not [m].
double even_levels(const State& state, int group, int axis);

/// Patches between fibres and their matrix, by the entries of [[bonds]] with law interface. `first_body`: that of the
/// first sphere. Throws InputError for fibres that have no surface.
std::vector<SharedFace> fibre_patches(const Case& c, const Model& model, const State& state,
                                      const std::vector<SphereSpec>& spheres, int first_body, const BondTable& table);

/// What only these interfaces know: pressure and how it falls, and how far they can slide. Once all bonds are made.
void finish_fibre_interfaces(const Case& c, Model& model, State& state, const BondTable& table);

/// Spheres of one packing touch across the surface of a fibre that is taken from it, and grains that made no room for a
/// chain reach into it. The interface is all that joins them: as contacts they would lock the fibre in, or throw it
/// out. Leaves pairs alone that an entry of [[contacts]] names.
void part_fibres(const Case& c, Model& model, const State& state, const BondTable& table);

}  // namespace grainfrac
