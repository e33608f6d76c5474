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
    std::vector<double> slip;      ///< of the fibre against the matrix, along it [m]
    std::vector<double> shear;     ///< tau on the fibre against the pull [Pa]
    std::vector<double> spread;    ///< of tau about that mean: root of the mean square over the area [Pa]
    std::vector<double> stress;    ///< axial, of the fibre [Pa]
    std::vector<double> damage;    ///< [-]
};

/// Bits of PullOut::at_end.
inline constexpr char first_in_matrix = 1, last_in_matrix = 2;

Experiment set_up_pull_out(const Case& c, Model& model, State& state);

/// Interfaces of the fibres, those that slid out of the matrix too.
std::vector<int> fibre_interfaces(const PullOut& p, const State& state);
/// The body of a fibre that such an interface belongs to.
int fibre_side(const PullOut& p, const State& state, int i);
/// Of the fibre against the matrix, along the fibre; mean of the patch, whose body of the fibre is `fibre` [m].
double slip_of(const PullOut& p, const State& state, int i, int fibre);
FibreProfile fibre_profile(const PullOut& p, const State& state);
PullOutState pull_out_state(const PullOut& p, const State& state);
/// Results that the whole path tells.
std::vector<NamedResult> pull_out_results(const Experiment& e, const std::vector<CurvePoint>& curve);

}  // namespace grainfrac
