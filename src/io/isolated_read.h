// SPDX-License-Identifier: GPL-3.0-or-later
// Libraries that read foreign formats crash on some damaged files, or ask for all memory. A process of its own bears
// that.
#pragma once

#include "generate/sphere_file.h"

namespace grainfrac {

/// What `reader` finds in the file, read by a child of this process. Throws std::runtime_error with its message, or
/// that it crashed, took too long or wanted too much memory.
std::vector<Ball> read_isolated(SphereReader reader, const std::filesystem::path& file);

}  // namespace grainfrac
