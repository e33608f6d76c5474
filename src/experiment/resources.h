// SPDX-License-Identifier: GPL-3.0-or-later
// How large a model will be, before anything of it is made.
#pragma once

#include "model/case.h"

#include <filesystem>

namespace grainfrac {

/// Grains or spheres of a part, about; those of a file by its size, those that are taken from another part 0 [-].
/// `folder`: where files are searched.
double expected_bodies(const PartSpec& part, const std::filesystem::path& folder);
/// Of all parts.
double expected_bodies(const Case& c);
/// Of a run of this case, about [B].
double expected_memory(const Case& c);
/// What this process may still take: free memory of the machine, within the limits of its control group and of those
/// that this is in [B].
double available_memory();

/// What the control groups of this process leave it [B]. `list`: /proc/self/cgroup, `mounted`: where the groups are.
double room_of_own_group(const std::filesystem::path& list, const std::filesystem::path& mounted);

/// Throws InputError where a part has more bodies than indices reach, and std::runtime_error where memory does not
/// suffice.
void check_resources(const Case& c);

}  // namespace grainfrac
