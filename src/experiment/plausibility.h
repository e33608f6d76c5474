// SPDX-License-Identifier: GPL-3.0-or-later
// Values that are allowed and yet hardly meant: units forgotten, scales that do not fit each other, loading that cannot
// do what the test is for. Each warning says with which numbers.
#pragma once

#include "experiment/experiment.h"

#include <vector>

namespace grainfrac {

/// What only the input is needed for.
std::vector<InputProblem> implausible_input(const Case& c);
/// What the built model is needed for. `dt`: time step of the run; `critical`: stability limit [s].
std::vector<InputProblem> implausible_model(const Case& c, const Built& built, double dt, double critical);

}  // namespace grainfrac
