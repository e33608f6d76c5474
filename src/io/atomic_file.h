// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are either whole or not there: written aside, forced to disk, renamed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace grainfrac {

/// Where the new content of `path` is written before the rename: same folder, so that the rename is atomic.
std::filesystem::path aside(const std::filesystem::path& path);

/// Write `content` aside, fsync, rename to `path`, fsync the folder. On failure the file aside is removed, an older
/// `path` is kept, and std::runtime_error names the file and the reason.
void write_file(const std::filesystem::path& path, std::string_view content);

/// The second half, for a file that some library wrote to aside(path).
void commit_file(const std::filesystem::path& path);

/// Whole file. Throws std::runtime_error.
std::string read_file(const std::filesystem::path& path);

}  // namespace grainfrac
