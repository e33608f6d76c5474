// SPDX-License-Identifier: GPL-3.0-or-later
// Cells of the CSV files.
#pragma once

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace grainfrac {

/// Appends the shortest text that reads back as the same number, after a comma if the line has begun.
template <class Number>
void append_cell(std::string& line, Number value)
{
    char text[40];  // a double has at most 24 characters
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    if (!line.empty()) line += ',';
    line.append(text, end);
}

/// Text that is on disk when this returns; an error throws std::runtime_error that names the file.
inline void append_text(std::ofstream& file, const std::filesystem::path& path, const std::string& text)
{
    errno = 0;
    if (!(file << text << std::flush))
        throw std::runtime_error(path.string() + ": cannot write: " + std::strerror(errno != 0 ? errno : EIO));
}

}  // namespace grainfrac
