// SPDX-License-Identifier: GPL-3.0-or-later
// The four models that the speed of a step is measured on, built from bench/cases/*.toml, any size.
#pragma once

#include "experiment/experiment.h"

#include <string>

namespace grainfrac::bench {

enum class Kind {
    honeycomb,       ///< bonded hexagonal prisms under compression
    prisms,          ///< loose hexagonal prisms at rest in a box
    bonded_spheres,  ///< hexagonal close packing with total parallel bonds, loaded along the axis
    loose_spheres,   ///< spheres at rest in a box
};
inline constexpr const char* name_of(Kind k)
{
    constexpr const char* names[] = {"honeycomb", "prisms", "bonded_spheres", "loose_spheres"};
    return names[static_cast<int>(k)];
}

struct Loaded {
    Built built;
    double dt = 0.0;   ///< [s]
    int bodies = 0;    ///< that move
    int bonds = 0;     ///< that act
    int touching = 0;  ///< pairs in contact
    int rebuilds = 0;  ///< of the neighbour list in the last `watched` steps
    int watched = 0;
    double memory = 0.0;  ///< of all arrays [B]
    double traffic =
        0.0;  ///< that a step cannot avoid as it is laid out, if no cache holds anything between stages [B]

    /// What the time of a step is divided by: bonds, or pairs in contact where there are none.
    int interactions() const { return bonds > 0 ? bonds : touching; }
};

/// Model of about `bodies` bodies after some hundred steps of loading, or settled; made once, then kept.
Loaded& loaded(Kind kind, int bodies);

}  // namespace grainfrac::bench
