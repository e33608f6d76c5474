// SPDX-License-Identifier: GPL-3.0-or-later
// Grains from a file (JSON), as far as bodies with mass and a core.
#include "generate/microstructure.h"

#include "scratch_file.h"

#include <stdexcept>

using namespace grainfrac;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        const std::vector<GrainSpec> grains = read_microstructure(fuzz::scratch_file(data, size, ".json"));
        Model model;
        State state;
        model.materials.push_back({"m", 1000.0, 1e9, 0.2});
        model.groups.push_back({"g", 0, false});
        for (const GrainSpec& grain : grains) add_grain(model, state, grain);
    } catch (const std::runtime_error&) {
    } catch (const std::invalid_argument&) {  // a dilation radius too large for its grain
    }
    return 0;
}
