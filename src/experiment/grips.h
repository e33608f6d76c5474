// SPDX-License-Identifier: GPL-3.0-or-later
// Grips: walls that are made of a part's own bodies.
#pragma once

#include "model/case.h"
#include "model/model.h"
#include "model/state.h"

namespace grainfrac {

/// New wall of this name whose bodies are those of the part that the grip takes. Held in all axes they are driven, with
/// free rotation they are pins; held in some, they move freely along the others. Throws InputError, with the key below
/// `key`, if there are none or if one is driven already.
void add_grip(Model& model, State& state, const GripSpec& spec, const std::string& key);

/// The bodies of a wall that is a grip are free from now on, at the speed they have; what that speed is worth counts as
/// work from outside. Does nothing to walls with bodies of their own.
void release_grip(const Model& model, State& state, int wall);

}  // namespace grainfrac
