// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes of a fuzzer as a file, for readers that take a name.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace grainfrac::fuzz {

/// In memory where the system has such a folder; the same name again and again.
inline std::filesystem::path scratch_file(const std::uint8_t* data, std::size_t size, const std::string& extension)
{
    static const std::filesystem::path folder = [] {
        const bool in_memory = std::filesystem::is_directory("/dev/shm");
        return in_memory ? std::filesystem::path("/dev/shm") : std::filesystem::temp_directory_path();
    }();
    const std::filesystem::path file = folder / ("grainfrac_fuzz_" + std::to_string(getpid()) + extension);
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    static const std::filesystem::path last = file;
    [[maybe_unused]] static const int removed = std::atexit([] {
        std::error_code ignored;
        std::filesystem::remove(last, ignored);
    });
    return file;
}

/// A good file with what the fuzzer's bytes change in it: four bytes an edit, place and new value, the first of all
/// cuts the file where it is not zero. Libraries' formats are too rigid to be hit by chance.
inline std::string edited(std::string good, const std::uint8_t* data, std::size_t size)
{
    const auto place = [&](std::size_t i) {
        return static_cast<std::size_t>(data[i] | data[i + 1] << 8 | data[i + 2] << 16) % good.size();
    };
    for (std::size_t i = 4; i + 4 <= size && !good.empty(); i += 4) good[place(i)] = static_cast<char>(data[i + 3]);
    if (size >= 4 && data[3] != 0) good.resize(place(0));
    return good;
}

}  // namespace grainfrac::fuzz
