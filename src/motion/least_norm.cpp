// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/least_norm.h"

#include <Eigen/Dense>

namespace grainfrac {

std::array<double, 3> least_norm_solution(const double (&A)[3][3], const double (&r)[3])
{
    Eigen::Matrix3d M;
    Eigen::Vector3d v;
    for (int k = 0; k < 3; ++k) {
        v[k] = r[k];
        for (int l = 0; l < 3; ++l) M(k, l) = A[k][l];
    }
    const Eigen::Vector3d x = M.completeOrthogonalDecomposition().solve(v);
    return {x[0], x[1], x[2]};
}

}  // namespace grainfrac
