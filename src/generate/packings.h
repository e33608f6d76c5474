// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the input as spheres in space.
#pragma once

#include "generate/spheres.h"
#include "model/case.h"

#include <vector>

namespace grainfrac {

/// Spheres of all parts of kind "spheres", part by part; without those that a fibre takes the place of. Throws
/// InputError for a packing that cannot be made, naming the key.
std::vector<SphereSpec> generate_spheres(const Case& c);

}  // namespace grainfrac
