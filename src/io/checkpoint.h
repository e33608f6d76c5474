// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints: the whole state, bit for bit, with a checksum on every array.
#pragma once

#include "model/model.h"
#include "model/state.h"

#include <filesystem>
#include <string>
#include <vector>

namespace grainfrac {

/// Rises when a checkpoint can no longer be read by older programs or older ones no longer by this.
inline constexpr std::int64_t checkpoint_schema = 1;

/// Everything in `state`, and of `model` what a stage sets (wall motion, local damping, whether bonds may break),
/// written aside and renamed. Throws std::runtime_error.
void write_checkpoint(const std::filesystem::path& path, const Model& model, const State& state,
                      const std::string& version);

/// The reverse. `model` must be the one built from the same input: only what a stage sets is replaced. Throws
/// std::runtime_error for a file that is damaged, of another schema, or does not fit the model; both are then
/// unchanged.
void read_checkpoint(const std::filesystem::path& path, Model& model, State& state);

/// The checkpoints of a folder (step_N.h5), newest first.
std::vector<std::filesystem::path> list_checkpoints(const std::filesystem::path& folder);

/// Write folder/step_N.h5 and remove all but the newest two.
void write_next_checkpoint(const std::filesystem::path& folder, const Model& model, const State& state,
                           const std::string& version);

}  // namespace grainfrac
