// SPDX-License-Identifier: GPL-3.0-or-later
// What run and resume have in common: from a model and a folder to the end of the run.
#pragma once

#include "app/simulation.h"

namespace grainfrac {

RunFacts run_facts(const Case& c, const std::string& resolved, Device device);

/// Simulates, writes the summary, says how it ended; returns the exit code.
int carry_out(const Case& c, const Options& o, const RunFacts& facts, const RunOrigin& origin, Built& built,
              ResultFolder& folder, RunRecord& record, const Restart* restart = nullptr);

}  // namespace grainfrac
