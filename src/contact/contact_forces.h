// SPDX-License-Identifier: GPL-3.0-or-later
// The contact law over all contacts.
#pragma once

#include "model/model.h"
#include "model/state.h"

namespace grainfrac {

/// Forces of all contacts into their slots; histories and dissipation advance by one step of dt. A contact that takes
/// over from a bond starts with the force that the bond ended with.
void contact_forces(const Model& model, State& state, double dt);

}  // namespace grainfrac
