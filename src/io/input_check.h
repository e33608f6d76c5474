// SPDX-License-Identifier: GPL-3.0-or-later
// What no key can be wrong about alone: names that refer to nothing, values that contradict each other.
#pragma once

#include "model/case.h"

#include <vector>

namespace grainfrac {

/// Adds to `problems`, which holds what is wrong already: a check that looks at a wrong value is left out.
/// `c.places` tells which keys were given.
void check_case(const Case& c, std::vector<InputProblem>& problems);

}  // namespace grainfrac
