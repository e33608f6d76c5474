// SPDX-License-Identifier: GPL-3.0-or-later
// How much of the growing files of a result folder there is at a checkpoint.
#pragma once

#include "experiment/pull_out.h"
#include "io/growing_text.h"
#include "io/hdf5_skeleton.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grainfrac {

/// What results.h5 is at a checkpoint, and what the file itself does not tell.
struct Hdf5Mark {
    Hdf5Skeleton skeleton;
    std::vector<std::int64_t> extents;  ///< of all datasets, one after the other
    std::vector<double> bond_failure;   ///< that of the file is written over [s]
    std::vector<std::int32_t> bond_cause;
    double last_crack = -1.0;     ///< [s]
    std::int64_t last_step = -1;  ///< of the last snapshot

    template <class Visit>
    void for_each_member(Visit&& visit)
    {
        auto& [a, b, c, d, e, f] = *this;
        visit("skeleton", a);
        visit("extents", b);
        visit("bond_failure", c);
        visit("bond_cause", d);
        visit("last_crack", e);
        visit("last_step", f);
    }
};

/// pull_out.csv and profiles.csv.
struct PullOutMark {
    TextMark rows, profiles;
    std::int64_t next_profile = 0;
    std::optional<std::pair<PullOutState, FibreProfile>> whole;  ///< that without damage, until it is written

    template <class Visit>
    void for_each_member(Visit&& visit)
    {
        auto& [a, b, c, d] = *this;
        visit("rows", a);
        visit("profiles", b);
        visit("next_profile", c);
        bool there = d.has_value();
        visit("has_whole", there);
        if (!there) return d.reset();
        if (!d) d.emplace();
        visit("whole_state", d->first);
        auto& [position, slip, shear, spread, stress, damage] = d->second;
        visit("whole_position", position);
        visit("whole_slip", slip);
        visit("whole_shear", shear);
        visit("whole_spread", spread);
        visit("whole_stress", stress);
        visit("whole_damage", damage);
    }
};

struct FolderMark {
    TextMark history;
    std::optional<TextMark> walls;        ///< from its first row on
    std::optional<PullOutMark> pull_out;  ///< from its first row on
    Hdf5Mark results;
    std::map<std::string, std::string> series;  ///< paraview/, per kind: the DataSet lines of its .pvd
    std::int64_t frame = 0;                     ///< next one of the series

    template <class Visit>
    void for_each_member(Visit&& visit)
    {
        auto& [a, b, c, d, e, f] = *this;  // a new member does not compile until it stands here
        visit("history", a);
        visit("walls", b);
        visit("pull_out", c);
        visit("results", d);
        visit("series", e);
        visit("frame", f);
    }
};

}  // namespace grainfrac
