// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the input as spheres in space.
#pragma once

#include "generate/assemble.h"
#include "generate/spheres.h"
#include "model/case.h"

#include <vector>

namespace grainfrac {

/// Spheres of all parts of kind "spheres", part by part; without those that a fibre takes the place of. Throws
/// InputError for a packing that cannot be made, naming the key.
std::vector<SphereSpec> generate_spheres(const Case& c);

/// Grains of the part that a chain is `inside` of, whose site is nearer to its line than the fibre's radius, go.
void make_room_for_fibres(const Case& c, std::vector<GrainSpec>& grains);

}  // namespace grainfrac
