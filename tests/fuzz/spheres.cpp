// SPDX-License-Identifier: GPL-3.0-or-later
// Spheres from a CSV table.
#include "generate/sphere_file.h"
#include "scratch_file.h"

#include <stdexcept>

using namespace grainfrac;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        read_spheres(fuzz::scratch_file(data, size, ".csv"), "part");
    } catch (const std::runtime_error&) {
    }
    return 0;
}
