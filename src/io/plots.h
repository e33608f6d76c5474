// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures of plots/, beside the two that results.h offers.
#pragma once

#include "io/fragments.h"
#include "io/history_csv.h"
#include "io/results.h"

namespace grainfrac {

/// Rose of the cracks' traces in the xy plane, weighted by area.
void plot_crack_orientation(const std::filesystem::path& stem, const std::vector<CrackFace>& cracks);
/// Mass fraction of fragments up to a size.
void plot_fragment_sizes(const std::filesystem::path& stem, const std::vector<Fragment>& fragments);

void plot_load_displacement(const std::filesystem::path& stem, const HistoryTable& history);
void plot_energies(const std::filesystem::path& stem, const HistoryTable& history);

/// All of them into folder/plots, the history read from folder/history.csv. Makes as many as it can, then throws
/// std::runtime_error that names those it could not.
void write_plots(const std::filesystem::path& folder, const Model& model, const State& state,
                 const SnapshotFields& fields, const std::vector<CrackFace>& cracks);

}  // namespace grainfrac
