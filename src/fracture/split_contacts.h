// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts of grains that are split: their force goes on, shared between the parts.
#pragma once

#include "fracture/parting.h"

#include <vector>

namespace grainfrac {

/// A contact of a grain that is split, as it was.
struct OldContact {
    int a = 0, b = 0;
    double pressed = 0.0;  ///< without its viscous part [N]
    Vec3 shear_force;      ///< on a [N]
};

/// Ends the acting contacts of the grains that are split; what they held goes to the account of past contacts.
std::vector<OldContact> take_contacts(State& state, const std::vector<Parting>& partings);

/// The contacts of the parts share the force of the grain's contact by what their geometry alone would press. Needs
/// their geometry (find_contacts). Returns them.
std::vector<int> give_contacts(const Model& model, State& state, const std::vector<Parting>& partings,
                               const std::vector<OldContact>& old);

}  // namespace grainfrac
