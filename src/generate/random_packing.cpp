// SPDX-License-Identifier: GPL-3.0-or-later
#include "generate/random_packing.h"

#include <cmath>

namespace grainfrac {

double densest_random_packing(double size_ratio)
{
    const double deviation = (size_ratio - 1.0) / (size_ratio + 1.0) / std::sqrt(3.0);
    return 0.634 + 0.0658 * deviation;
}

}  // namespace grainfrac
