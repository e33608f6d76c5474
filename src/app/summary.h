// SPDX-License-Identifier: GPL-3.0-or-later
// summary.json: the machine-readable outcome.
#pragma once

#include "app/simulation.h"

#include <string>

namespace grainfrac {

std::string summary_json(const RunFacts& facts, const Case& c, const Built& built, const RunRecord& record,
                         const Ending& ending, const SnapshotFields& fields);

/// Largest memory of this process so far [B].
std::int64_t peak_memory();

}  // namespace grainfrac
