// SPDX-License-Identifier: GPL-3.0-or-later
// Uniaxial compression and tension: stress = load over section, strain = change of length over length.
#pragma once

#include "experiment/experiment.h"

namespace grainfrac {

/// Ends at the two sides of the specimen along test.direction. Plates "platen_top" and "platen_bottom", touching
/// without overlap (compression), or the end grains themselves, held by "grip_top" and "grip_bottom" (tension, and
/// compression with ends = "gripped"): they move together and do not turn. Length: between the platens, or between the
/// mean centres of the gripped grains.
Experiment set_up_uniaxial(const Case& c, Model& model, State& state);

}  // namespace grainfrac
