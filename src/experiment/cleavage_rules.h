// SPDX-License-Identifier: GPL-3.0-or-later
// From [materials.NAME.cleavage] to the rules by which the grains of each part split.
#pragma once

#include "fracture/cleave.h"
#include "model/case.h"

#include <vector>

namespace grainfrac {

/// Rules of every group (walls: none). `spacing`: mean inscribed diameter of each group's grains [m]. Adds the laws of
/// the new surfaces to the model.
std::vector<CleavageRules> make_cleavage_rules(const Case& c, const std::vector<double>& spacing, Model& model);

}  // namespace grainfrac
