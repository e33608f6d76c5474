// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "model/case.h"
#include "model/model.h"
#include "model/state.h"

namespace grainfrac {

/// Throws InputError with the key to blame if bodies that no bond joins lie in each other at the start.
void check_nothing_overlaps(const Case& c, const Model& model, State state);

}  // namespace grainfrac
