// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints: what a run needs to go on, bit for bit. Written aside and renamed, sealed with a checksum over the whole
// file, so that a damaged one is known before anything in it is looked at.
#pragma once

#include "io/archive.h"
#include "model/model.h"
#include "model/state.h"

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace grainfrac {

/// Rises when a checkpoint can no longer be read by older programs or older ones no longer by this.
inline constexpr std::int64_t checkpoint_schema = 5;

/// A checkpoint that nothing can go on from; the message names the file and the reason.
struct CheckpointError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Visits everything that belongs into the checkpoint, for both directions.
using CheckpointContent = std::function<void(Archive&)>;

/// All of the state.
void transfer(Archive& archive, const std::string& name, State& state);
/// All numbers of the model: stages set some, splits add shapes. Names come from the input, and have to be there when
/// it is loaded: how many there are is checked.
void transfer(Archive& archive, const std::string& name, Model& model);

/// Throws std::runtime_error.
void write_checkpoint(const std::filesystem::path& path, const std::string& version, const CheckpointContent& content);

/// Throws CheckpointError for a file that is damaged, of another version or schema, or does not fit. What is wrong with
/// the file itself is known before `content` is called; what does not fit leaves it half read.
void read_checkpoint(const std::filesystem::path& path, const std::string& version, const CheckpointContent& content);

/// The checkpoints of a folder (step_N.h5), newest first.
std::vector<std::filesystem::path> list_checkpoints(const std::filesystem::path& folder);

/// Write folder/step_N.h5 and remove all but the newest two.
void write_next_checkpoint(const std::filesystem::path& folder, std::int64_t step, const std::string& version,
                           const CheckpointContent& content);

/// Out of the way of the others, as FILE.refused.
void set_aside(const std::filesystem::path& checkpoint);

}  // namespace grainfrac
