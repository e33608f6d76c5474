// SPDX-License-Identifier: GPL-3.0-or-later
// Cells of the CSV files.
#pragma once

#include <charconv>
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

}  // namespace grainfrac
