// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the input as grains in space, and the file that `grainfrac generate` writes.
#pragma once

#include "generate/assemble.h"
#include "model/case.h"

#include <filesystem>
#include <vector>

namespace grainfrac {

/// Grains of all parts, part by part. Group g is part g. Throws InputError for geometry that cannot be (no cell fits
/// the region, dilation radius too large, unreadable file), naming the key.
std::vector<GrainSpec> generate_grains(const Case& c);

/// Microstructure file (JSON, SI units): per grain its vertices, faces, site, crystal orientation, dilation radius.
void write_microstructure(const std::filesystem::path& file, const std::vector<GrainSpec>& grains,
                          const std::string& title);
/// Throws std::runtime_error that says what is wrong with the file and where.
std::vector<GrainSpec> read_microstructure(const std::filesystem::path& file);

}  // namespace grainfrac
