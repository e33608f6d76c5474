// SPDX-License-Identifier: GPL-3.0-or-later
// A face that is held in the mean: its bodies bear a stress along a direction that varies linearly over the face, each
// in proportion to its share of the area, so that the mean place of the face along it and its mean tilt stay as they
// are. The stress on the face is uniform under a central pull, its shape free.
#pragma once

#include "model/model.h"
#include "model/state.h"

namespace grainfrac {

/// Adds the shared forces of Model::spread_bodies to Bodies::force; call after gather_forces. They do no work.
void spread_support_forces(const Model& model, State& state);

}  // namespace grainfrac
