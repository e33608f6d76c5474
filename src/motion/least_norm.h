// SPDX-License-Identifier: GPL-3.0-or-later
// Host only: a file that launches kernels does not see Eigen.
#pragma once

#include <array>

namespace grainfrac {

/// Of A x = r the shortest x, also where A has no inverse.
std::array<double, 3> least_norm_solution(const double (&A)[3][3], const double (&r)[3]);

}  // namespace grainfrac
