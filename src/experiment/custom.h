// SPDX-License-Identifier: GPL-3.0-or-later
// A programme spelled out with [[walls]] and [[stages]].
#pragma once

#include "experiment/experiment.h"

namespace grainfrac {

/// The load is the push of the first wall that moves in the first stage of kind "load" (else of any kind); a wall that
/// comes towards it counts for displacement and load too. Nominal strain refers to the length of the box around the
/// grains along that push, nominal stress to its section, both from where that stage begins.
Experiment set_up_custom(const Case& c, Model& model, State& state);

}  // namespace grainfrac
