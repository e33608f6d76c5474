// SPDX-License-Identifier: GPL-3.0-or-later
// A text file that grows line by line, can be read meanwhile, and can be cut back to where a checkpoint was written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace grainfrac {

/// The first bytes of a file and what they are.
struct TextMark {
    std::int64_t bytes = 0;
    std::uint64_t checksum = 0;
};

/// Throws std::runtime_error that names the file unless it begins as the mark says.
void check_head(const std::filesystem::path& path, const TextMark& mark);

class GrowingText {
public:
    /// A new file that begins with `head`. Errors of all members throw std::runtime_error that names the file.
    GrowingText(std::filesystem::path path, const std::string& head);
    /// Goes on behind `mark`; what came later is cut off. Throws if what is before it is not what was written.
    GrowingText(std::filesystem::path path, const TextMark& mark);

    /// On disk when it returns, as far as other programs can see.
    void append(const std::string& text);
    /// Everything so far is on disk even if the machine fails.
    TextMark mark() const;
    void close();
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    std::ofstream file_;
    TextMark written_;
};

}  // namespace grainfrac
