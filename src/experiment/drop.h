// SPDX-License-Identifier: GPL-3.0-or-later
// Grains fall on a floor, with or without walls around them.
#pragma once

#include "experiment/experiment.h"

namespace grainfrac {

/// Floor "floor" drop_height below the lowest point of any grain, and with test.side_gap four plates "sides" around the
/// specimen. Gravity is control.gravity or, where that is zero, 9.81 m/s^2 along -z. The load is what the floor bears.
Experiment set_up_drop(const Case& c, Model& model, State& state);

}  // namespace grainfrac
