// SPDX-License-Identifier: GPL-3.0-or-later
// Moments of the points of interfaces, for faces without damage.
#pragma once

#include "model/state.h"

namespace grainfrac {

/// Of interface i; area 0 where its points are no plane patch that both bodies see alike (fibres, pre-stressed cuts).
FaceMoments face_moments(const State& state, int i);

/// InterfaceBonds::moments of all interfaces.
void find_face_moments(State& state);

}  // namespace grainfrac
