// SPDX-License-Identifier: GPL-3.0-or-later
// Fragments: the bonded clusters of a snapshot as bodies of their own.
#pragma once

#include "io/results.h"

#include <vector>

namespace grainfrac {

struct Fragment {
    std::int32_t cluster = 0;  ///< as in SnapshotFields
    std::int32_t grains = 0;   ///< how many
    double mass = 0.0;         ///< [kg]
    double volume = 0.0;       ///< of solid [m^3]
    Vec3 center;               ///< of mass [m]
    Vec3 velocity;             ///< of the centre of mass [m/s]
};

/// One entry per cluster, in the order of their numbers.
std::vector<Fragment> collect_fragments(const Model& model, const State& state, const SnapshotFields& fields);

}  // namespace grainfrac
