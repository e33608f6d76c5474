// SPDX-License-Identifier: GPL-3.0-or-later
// The line along which the spheres of a chain stand: straight, a sine, hooked, or from point to point.
#pragma once

#include "model/case.h"

#include <vector>

namespace grainfrac {

/// Spheres at equal arc length, from the first to the last.
struct FibreNodes {
    std::vector<Vec3> position;        ///< [m]
    double piece = 0.0;                ///< arc length between two [m]
    double before = 0.0, after = 0.0;  ///< fibre beyond the first and the last one, half a piece at most [m]

    /// Length of fibre that a node stands for: half-way to its neighbours, and to where the fibre ends [m].
    double length_of(std::size_t k) const
    {
        return (k == 0 ? before : 0.5 * piece) + (k + 1 == position.size() ? after : 0.5 * piece);
    }
};

/// `spacing` is adjusted so that whole pieces fit. Throws InputError (keys below the fibre: "spacing", "wavelength",
/// ...) for a line that is shorter than a piece or bends more sharply than the spheres can follow.
FibreNodes fibre_nodes(const FibreSpec& fibre, double spacing);

/// Corners of the line; of a sine points so dense that the chords are off by less than 1e-4 of the amplitude.
std::vector<Vec3> fibre_polyline(const FibreSpec& fibre);

/// Distance of a point from a line of two corners or more; its ends are round [m].
double distance_to_polyline(const Vec3& x, const std::vector<Vec3>& corners);

}  // namespace grainfrac
