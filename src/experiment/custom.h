// SPDX-License-Identifier: GPL-3.0-or-later
// A programme spelled out with [[walls]] and [[stages]].
#pragma once

#include "experiment/experiment.h"

namespace grainfrac {

/// The load and displacement are those of the first wall that any stage moves; nominal strain refers to the specimen's
/// extent along that motion, nominal stress to its bounding section across it.
Experiment set_up_custom(const Case& c, Model& model, State& state);

}  // namespace grainfrac
