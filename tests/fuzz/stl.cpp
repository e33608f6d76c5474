// SPDX-License-Identifier: GPL-3.0-or-later
// STL, ASCII and binary, and what is made of its triangles.
#include "geometry/stl.h"

#include "scratch_file.h"

#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    constexpr int most_corners = 16;
    try {
        const grainfrac::TriangleMesh mesh = grainfrac::read_stl(grainfrac::fuzz::scratch_file(data, size, ".stl"));
        grainfrac::why_not_closed(mesh);
        grainfrac::convex_facets(mesh, most_corners);
    } catch (const std::runtime_error&) {
    }
    return 0;
}
