// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/sphere_formats.h"

#include "generate/sphere_file.h"
#include "io/hdf5_file.h"
#include "io/isolated_read.h"

#include <fmt/format.h>

#include <stdexcept>

namespace grainfrac {

std::vector<Ball> read_spheres_hdf5(const std::filesystem::path& file)
{
    const Hdf5File in = Hdf5File::open(file);
    for (const char* name : {"position", "radius"}) {
        if (!in.has(name)) throw std::runtime_error(fmt::format("\"{}\" has no dataset {}", file.string(), name));
    }
    const std::vector<hsize_t> p = in.extents("position"), r = in.extents("radius");
    if (p.size() != 2 || p[1] != 3 || r.size() != 1 || r[0] != p[0]) {
        throw std::runtime_error(fmt::format("\"{}\": position is [{}], radius [{}]; must be [n, 3] and [n]",
                                             file.string(), fmt::join(p, ", "), fmt::join(r, ", ")));
    }
    const std::vector<double> x = in.read<double>("position"), radius = in.read<double>("radius");
    std::vector<Ball> balls;
    for (std::size_t i = 0; i < radius.size(); ++i)
        balls.push_back({{x[3 * i], x[3 * i + 1], x[3 * i + 2]}, radius[i]});
    return balls;
}

void enter_sphere_formats()
{
    const auto by_hdf5 = [](const std::filesystem::path& file) { return read_isolated(read_spheres_hdf5, file); };
    for (const char* extension : {".h5", ".hdf5"}) add_sphere_format(extension, by_hdf5);
#ifdef GF_HAVE_VTK
    const auto by_vtk = [](const std::filesystem::path& file) { return read_isolated(read_spheres_vtk, file); };
    for (const char* extension : {".vtk", ".vtp", ".vtu"}) add_sphere_format(extension, by_vtk);
#endif
}

}  // namespace grainfrac
