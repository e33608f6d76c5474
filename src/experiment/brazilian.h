// SPDX-License-Identifier: GPL-3.0-or-later
// The Brazilian test: a disc between two platens, split by the tension across the loaded diameter,
// sigma_t = 2 P/(pi D t) at its centre.
#pragma once

#include "experiment/experiment.h"

namespace grainfrac {

/// Platens "platen_top" and "platen_bottom" at the poles of the first part's disc, touching it without overlap, and one
/// loading stage. Flat platens are 2 contact_half_width wide; curved ones are chains of plates around a circle of
/// platen_radius.
Experiment set_up_brazilian(const Case& c, Model& model, State& state);

}  // namespace grainfrac
