// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints: a good one that is edited is read, or refused with model and state unchanged.
#include "io/checkpoint.h"

#include "experiment/experiment.h"
#include "io/atomic_file.h"
#include "io/input.h"
#include "model/validate.h"
#include "scratch_file.h"

#include <cstdlib>
#include <stdexcept>

using namespace grainfrac;

namespace {

Built few_grains()
{
    std::map<std::string, SourcePlace> places;
    const std::vector<std::string> smaller = {"parts.bar.region.size=[\"2.5 mm\", \"4 mm\", \"1.3 mm\"]"};
    return build(read_case_text(new_case("uniaxial_tension"), "FILE", smaller, places), Device::cpu);
}

std::string good_file(const Built& built)
{
    const std::filesystem::path file = fuzz::scratch_file(nullptr, 0, ".h5");
    write_checkpoint(file, built.model, built.state, "fuzz");
    return read_file(file);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const Built built = few_grains();
    static const std::string good = good_file(built);
    static const std::uint64_t before = state_hash(built.state);
    Model model = built.model;
    State state = built.state;
    const std::string bytes = fuzz::edited(good, data, size);
    try {
        read_checkpoint(fuzz::scratch_file(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), ".h5"),
                        model, state);
    } catch (const std::runtime_error&) {
        if (state_hash(state) != before) std::abort();
    }
    return 0;
}
