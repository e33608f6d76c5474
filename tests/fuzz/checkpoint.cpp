// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints: a good one that is edited is read, or refused with a message. Sealed anew, or no edit would pass the
// seal.
#include "io/checkpoint.h"

#include "experiment/experiment.h"
#include "io/atomic_file.h"
#include "io/input.h"
#include "model/checksum.h"
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

CheckpointContent content_of(Model& model, State& state)
{
    return [&](Archive& archive) {
        transfer(archive, "model", model);
        transfer(archive, "state", state);
    };
}

std::string good_file(Built built)
{
    const std::filesystem::path file = fuzz::scratch_file(nullptr, 0, ".h5");
    write_checkpoint(file, "fuzz", content_of(built.model, built.state));
    return read_file(file);
}

/// Length and checksum, the last 16 bytes, of what is before the seal of 24.
constexpr std::size_t seal_bytes = 24;

std::string sealed(std::string content, const std::string& mark)
{
    const std::uint64_t numbers[] = {content.size(), checksum(content.data(), content.size())};
    content += mark;
    return content.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
}

/// A last byte alone, behind the edits, tells to leave the seal as it was.
std::string edited_checkpoint(const std::string& good, const std::uint8_t* data, std::size_t size)
{
    if (size % 4 == 1) return fuzz::edited(good, data, size);
    const std::size_t end = good.size() - seal_bytes;
    return sealed(fuzz::edited(good.substr(0, end), data, size), good.substr(end, 8));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const Built built = few_grains();
    static const std::string good = good_file(built);
    Model model = built.model;
    State state = built.state;
    const std::string bytes = edited_checkpoint(good, data, size);
    try {
        read_checkpoint(fuzz::scratch_file(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), ".h5"),
                        "fuzz", content_of(model, state));
    } catch (const CheckpointError&) {
    }
    return 0;
}
