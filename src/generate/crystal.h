// SPDX-License-Identifier: GPL-3.0-or-later
// Hexagonal crystals: misorientation of two grains and what it does to the boundary between them.
#pragma once

#include "geometry/quat.h"

namespace grainfrac {

/// Least rotation angle between two crystals under the 12 proper rotations of group 622 [rad]; q: crystal to space.
double hexagonal_misorientation(const Quat& q_a, const Quat& q_b);

/// Boundary energy over its high-angle value: (t)(1 - ln t), t = theta/theta_m below theta_m, 1 above (Read and
/// Shockley 1950) [-].
double read_shockley(double theta, double theta_m);

/// Fracture energy of a boundary over G_0: 1 - chi gamma/gamma_m (Rice and Wang 1989); 1 for a perfect crystal [-].
double boundary_toughness_factor(double theta, double theta_m, double chi);

}  // namespace grainfrac
