// SPDX-License-Identifier: GPL-3.0-or-later
// The contact law over all contacts.
#pragma once

#include "model/model.h"
#include "model/state.h"

#include <vector>

namespace grainfrac {

/// Forces of all contacts into their slots; histories and dissipation advance by one step of dt. A contact that takes
/// over from a bond starts with the force that the bond ended with.
void contact_forces(const Model& model, State& state, double dt);
/// The same for some contacts, one after the other on the host.
void contact_forces(const Model& model, State& state, const std::vector<int>& contacts, double dt = 0.0);

}  // namespace grainfrac
