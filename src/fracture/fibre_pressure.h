// SPDX-License-Identifier: GPL-3.0-or-later
// The pressure of the matrix on a fibre, which gets thinner where it is pulled.
#pragma once

#include "model/model.h"
#include "model/state.h"

namespace grainfrac {

/// k_p in p = p_0 - k_p sigma_f: the fibre alone contracts by nu_f sigma_f/E_f, and a wide matrix follows by
/// p (1 + nu_m)/E_m; k_p = nu_f E_m/((1 - nu_f) E_m + (1 + nu_m) E_f) [-].
double contraction_of(const Material& fibre, const Material& matrix);

/// Interfaces that are told so get p = max(0, p_0 - k_p sigma_f), with the stress of the fibre at their node, the mean
/// of its bonds before and after, where the bodies are now.
void fibre_pressures(const Model& model, State& state);

}  // namespace grainfrac
