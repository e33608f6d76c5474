// SPDX-License-Identifier: GPL-3.0-or-later
// summary.json: the machine-readable outcome.
#pragma once

#include "app/simulation.h"

#include <string>

namespace grainfrac {

std::string summary_json(const RunFacts& facts, const Case& c, const Built& built, const RunRecord& record,
                         const Ending& ending, const SnapshotFields& fields);

/// Gripped ones are among the others; walls are bodies of no part.
struct BodyCounts {
    int grains = 0, gripped_grains = 0, spheres = 0, gripped_spheres = 0, walls = 0;
};
BodyCounts count_bodies(const Model& model, const State& state);

/// Largest memory of this process so far [B].
std::int64_t peak_memory();

}  // namespace grainfrac
