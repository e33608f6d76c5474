// SPDX-License-Identifier: GPL-3.0-or-later
// Notches and starter cracks: faces across a plane that carry no bond.
#pragma once

#include "generate/assemble.h"
#include "model/case.h"

#include <vector>

namespace grainfrac {

/// Part of a plane along two axes. Two grains are on different sides of it if their sites are; the face between them
/// lies in the crack if the middle of their sites does. The crack so follows faces, and is connected.
struct Precrack {
    int normal = 0;          ///< axis across the plane
    double place = 0.0;      ///< of the plane along `normal` [m]
    int along = 1;           ///< axis of growth
    double limit = 0.0;      ///< the crack is where the coordinate along `along` is below this [m]
    double tolerance = 0.0;  ///< sites this near the plane are below it, so that round-off does not decide [m]

    bool cuts(const Vec3& site_a, const Vec3& site_b) const;
};

/// The notch or crack of the test, none if it has none. Extents are those of the sharp grains.
std::vector<Precrack> precracks(const Case& c, const std::vector<GrainSpec>& grains);

}  // namespace grainfrac
