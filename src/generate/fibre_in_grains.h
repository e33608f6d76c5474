// SPDX-License-Identifier: GPL-3.0-or-later
// Which grains a fibre sees around it.
#pragma once

#include "generate/fibre_surface.h"

namespace grainfrac {

/// One patch for each grain around each node of the fibre. The surface of a node's piece is sampled; a sample belongs
/// to the nearest grain that the way outwards runs into within the fibre's radius, whatever the shape of the hole.
/// Patches lie on the fibre's surface at the node, in the mean direction of their samples, with their share of the
/// area.
std::vector<SharedFace> grain_patches(const Model& model, const State& state, const FibreChain& chain,
                                      const std::vector<int>& grains);

/// Whether one of the grains reaches into what the balls of the nodes sweep on the way to the next one.
bool grains_reach_in(const Model& model, const State& state, const FibreChain& chain, const std::vector<int>& grains);

}  // namespace grainfrac
