// SPDX-License-Identifier: GPL-3.0-or-later
// Spheres from HDF5, a good file that is edited, by the process of its own that reads it.
#include "generate/sphere_file.h"
#include "io/atomic_file.h"
#include "io/hdf5_file.h"
#include "io/sphere_formats.h"
#include "scratch_file.h"

#include <stdexcept>

using namespace grainfrac;

namespace {

std::string good_file()
{
    enter_sphere_formats();
    const std::filesystem::path file = fuzz::scratch_file(nullptr, 0, ".h5");
    Hdf5File out = Hdf5File::create(file);
    const std::vector<double> position = {0, 0, 0, 1, 0, 0, 0, 1, 0}, radius = {0.5, 0.5, 0.4};
    out.write("position", {3, 3}, position.data());
    out.write("radius", {3}, radius.data());
    out.close();
    return read_file(file);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const std::string good = good_file();
    const std::string bytes = fuzz::edited(good, data, size);
    try {
        read_spheres(fuzz::scratch_file(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), ".h5"),
                     "part");
    } catch (const std::runtime_error&) {
    }
    return 0;
}
