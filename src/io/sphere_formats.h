// SPDX-License-Identifier: GPL-3.0-or-later
// Files of spheres whose formats need a library.
#pragma once

#include "generate/ball.h"

#include <filesystem>
#include <vector>

namespace grainfrac {

/// Lets `generator = "file"` read HDF5 and, where VTK is built in, its files.
void enter_sphere_formats();

/// Datasets position [n, 3] and radius [n].
std::vector<Ball> read_spheres_hdf5(const std::filesystem::path& file);
/// Points with an array "radius": .vtu, .vtp, .vtk (legacy).
std::vector<Ball> read_spheres_vtk(const std::filesystem::path& file);

}  // namespace grainfrac
