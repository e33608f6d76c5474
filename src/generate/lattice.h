// SPDX-License-Identifier: GPL-3.0-or-later
// Close packings of equal spheres (docs/theory/packings.md): sites whose centre is inside a region.
#pragma once

#include "generate/sphere_region.h"

#include <vector>

namespace grainfrac {

/// Hexagonal close packing, c axis along `axis`: triangular layers at sqrt(2/3) d, as many as round(length/that), so
/// that each stands for one such length; centred in the region, a site on the line through its centre in every second
/// one (`channel`: where no layer has one, and all look alike). Rows of touching spheres run along the next axis (c
/// along z: x). In order of layer, row, place. Throws InputError (key "diameter", "region") if there is none or too
/// many.
std::vector<Vec3> hcp_sites(const SphereRegion& region, double d, int axis, bool channel = false);

/// Face-centred cubic, cube edges of sqrt(2) d along x, y, z, a site at the region's centre; in order of z, y, x.
std::vector<Vec3> fcc_sites(const SphereRegion& region, double d);

/// Throws InputError if a value of this key makes more spheres than a model can hold.
void check_count(const char* key, double spheres);

}  // namespace grainfrac
