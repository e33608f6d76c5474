// SPDX-License-Identifier: GPL-3.0-or-later
// Geometry of all candidate pairs: overlap, normal, centre of pressure.
#pragma once

#include "model/model.h"
#include "model/state.h"

#include <vector>

namespace grainfrac {

/// Fill Contacts::point at the present positions; pairs that touch for the first time get a contact, those whose bonds
/// still act none.
void find_contacts(const Model& model, State& state);
/// The same within a step: pairs that were too far apart to have met since, as State::travel tells, are not looked at.
void follow_contacts(const Model& model, State& state);
/// The same for some pairs, on the host.
void find_contacts(const Model& model, State& state, const std::vector<int>& pairs);

/// Pair whose cores penetrate (an error state), or -1. Looks at the points of the last find_contacts.
int penetrating_pair(const Model& model, const State& state);

}  // namespace grainfrac
