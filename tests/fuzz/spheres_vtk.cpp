// SPDX-License-Identifier: GPL-3.0-or-later
// Spheres from VTK files, by the process of its own that reads them; the first byte says which kind.
#include "generate/sphere_file.h"
#include "io/sphere_formats.h"
#include "scratch_file.h"

#include <stdexcept>

using namespace grainfrac;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    [[maybe_unused]] static const bool entered = (enter_sphere_formats(), true);
    if (size == 0) return 0;
    static constexpr const char* endings[] = {".vtk", ".vtp", ".vtu"};
    try {
        read_spheres(fuzz::scratch_file(data + 1, size - 1, endings[data[0] % 3]), "part");
    } catch (const std::runtime_error&) {
    }
    return 0;
}
