// SPDX-License-Identifier: GPL-3.0-or-later
// Pull-out of fibres from a matrix: grip at the exit, support of the matrix' far face, what is measured along the
// fibre.
#pragma once

#include "experiment/experiment.h"

#include <vector>

namespace grainfrac {

/// Along the fibre, at the levels of its spheres: means over the fibres and around them.
struct FibreProfile {
    std::vector<double> position;  ///< from the embedded end [m]
    std::vector<double> slip;      ///< of the fibre against the matrix, along the pull [m]
    std::vector<double> shear;     ///< tau on the fibre against the pull [Pa]
    std::vector<double> stress;    ///< of the fibre, from the shear between the embedded end and here [Pa]
    std::vector<double> damage;    ///< [-]
};

Experiment set_up_pull_out(const Case& c, Model& model, State& state);

/// Interfaces of the fibres, those that slid out of the matrix too.
std::vector<int> fibre_interfaces(const PullOut& p, const State& state);
FibreProfile fibre_profile(const PullOut& p, const State& state);
PullOutState pull_out_state(const PullOut& p, const State& state);

}  // namespace grainfrac
