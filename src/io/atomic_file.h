// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are either whole or not there: written aside, forced to disk, renamed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace grainfrac {

/// Where the new content of `path` is written before the rename: same folder, so that the rename is atomic.
std::filesystem::path aside(const std::filesystem::path& path);

/// Write `content` aside, fsync, rename to `path`, fsync the folder. On failure the file aside is removed, an older
/// `path` is kept, and std::runtime_error names the file and the reason.
void write_file(const std::filesystem::path& path, std::string_view content);

/// Throws std::runtime_error unless a file of so many bytes can be written at `path`: for libraries that do not recover
/// from a full disk. The room is free again afterwards.
void reserve_room(const std::filesystem::path& path, std::size_t bytes);

/// The second half, for a file that some library wrote to aside(path).
void commit_file(const std::filesystem::path& path);

/// What was written to the file so far is on disk, not only with the operating system.
void sync_file(const std::filesystem::path& path);

/// All of `content` to a file or a pipe; false, with errno, if it cannot be.
bool write_all(int fd, std::string_view content);

/// Whole file. Throws std::runtime_error.
std::string read_file(const std::filesystem::path& path);

}  // namespace grainfrac
