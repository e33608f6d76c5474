// SPDX-License-Identifier: GPL-3.0-or-later
// Mean Cauchy stress of rigid grains.
#pragma once

#include "model/model.h"
#include "model/state.h"

#include <vector>

namespace grainfrac {

/// sigma = (1/V) [sum_k d_k (x) f_k - E A^T],  A = skew(dw/dt) + skew(w)^2, E the Euler tensor with density; gravity
/// drops out. Tension positive, symmetrised. One entry per body, zero for walls [Pa]. Needs the dyads that
/// step(..., want_stress = true) left in the slots.
/// Source: Saleme Ruiz 2016 (2.17); factor and inertia term corrected: with arms from the centroid every force counts
/// once, and the inertia term makes the result symmetric for a moving grain.
std::vector<Mat3> grain_stress(const Model& model, const State& state);

/// Volume of each body's sharp polyhedron [m^3].
double grain_volume(const Model& model, const State& state, int body);

}  // namespace grainfrac
