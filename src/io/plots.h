// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures of plots/, beside the two that results.h offers.
#pragma once

#include "io/fragments.h"
#include "io/history_csv.h"
#include "io/results.h"

#include <array>
#include <utility>
#include <vector>

namespace grainfrac {

/// Directions of the cracks' traces in the xy plane.
struct CrackRose {
    static constexpr int sectors = 18;    ///< of 10 degrees, over half a turn: a trace has no sense of direction
    std::array<double, sectors> share{};  ///< of the traced area; sector k is centred on k 10 degrees from x [-]
    double area = 0.0;                    ///< traced: of faces not within 45 degrees of the xy plane [m^2]
};
/// Of the cracks of one mode (0 between grains, 1 through grains).
CrackRose crack_rose(const std::vector<CrackFace>& cracks, int mode);
/// A rose for each mode, weighted by area.
void plot_crack_orientation(const std::filesystem::path& stem, const std::vector<CrackFace>& cracks);

/// Mass in pieces up to a size, over the mass of all.
struct SizeDistribution {
    std::vector<double> diameter;    ///< of the ball of equal volume, rising [m]
    std::vector<double> mass_up_to;  ///< 1 at the end [-]
};
/// Of pieces given as diameter and mass; those without volume are left out.
SizeDistribution size_distribution(std::vector<std::pair<double, double>> pieces);
/// Of the bodies, and of what bonds hold together.
void plot_fragment_sizes(const std::filesystem::path& stem, const std::vector<Fragment>& fragments,
                         const std::vector<Cluster>& clusters);

/// How much of what is broken lies within grains, row by row; NaN while nothing is.
struct TransgranularShare {
    bool over_strain = true;  ///< x is the nominal strain [-]; false: the test has none, and x is the time [s]
    std::vector<double> x;
    std::vector<double> of_area, of_work;  ///< [-]
};
TransgranularShare transgranular_share(const HistoryTable& history);
void plot_transgranular_share(const std::filesystem::path& stem, const HistoryTable& history);

void plot_load_displacement(const std::filesystem::path& stem, const HistoryTable& history, bool has_platens = true);
/// Components of the forces of walls.csv over the time, the largest first; what is small beside them is left out.
void plot_wall_forces(const std::filesystem::path& stem, const HistoryTable& walls);
void plot_energies(const std::filesystem::path& stem, const HistoryTable& history);

/// All of them into folder/plots, the history read from folder/history.csv. Makes as many as it can, then throws
/// std::runtime_error that names those it could not.
void write_plots(const std::filesystem::path& folder, const Model& model, const State& state,
                 const std::vector<CrackFace>& cracks, const std::vector<Fragment>& fragments,
                 const std::vector<Cluster>& clusters);

}  // namespace grainfrac
