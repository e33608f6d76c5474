// SPDX-License-Identifier: GPL-3.0-or-later
// How large a model will be, before anything of it is made.
#pragma once

#include "model/case.h"

namespace grainfrac {

/// Grains or spheres of a part, about; of files 0 [-].
double expected_bodies(const PartSpec& part);
/// Of a run of this case, about [B].
double expected_memory(const Case& c);
/// What this process may still take: free memory of the machine, within the limit of its control group [B].
double available_memory();

/// Throws InputError where a part has more bodies than indices reach, and std::runtime_error where memory does not
/// suffice.
void check_resources(const Case& c);

}  // namespace grainfrac
