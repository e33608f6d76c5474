// SPDX-License-Identifier: GPL-3.0-or-later
// Files of spheres: a table of centres and radii, in metres (docs/theory/packings.md).
#pragma once

#include "generate/ball.h"
#include "generate/spheres.h"
#include "model/case.h"

#include <filesystem>
#include <string>
#include <vector>

namespace grainfrac {

/// Throws std::runtime_error that says what is wrong with the file.
using SphereReader = std::vector<Ball> (*)(const std::filesystem::path& file);

/// Formats that need a library are read in io, which enters them here; .csv is there from the start. `extension` as
/// ".h5".
void add_sphere_format(const std::string& extension, SphereReader reader);

/// By the ending of the file's name. Of a table with a column `part` only the rows of this part. Throws
/// std::runtime_error with file and line or number of the sphere.
std::vector<Ball> read_spheres(const std::filesystem::path& file, const std::string& part);

/// CSV with the columns x_m, y_m, z_m, radius_m, part; `read_spheres` gives back the same bits.
void write_spheres(const std::filesystem::path& file, const std::vector<SphereSpec>& spheres,
                   const std::vector<PartSpec>& parts);

}  // namespace grainfrac
