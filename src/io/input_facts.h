// SPDX-License-Identifier: GPL-3.0-or-later
// What is told of a key of the input file, and how messages say what it takes.
#pragma once

#include "geometry/vec3.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace grainfrac {

/// Allowed values of a number, in the SI unit of its key.
struct Range {
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    bool above = false;  ///< `least` itself is not allowed
    bool below = false;  ///< `most` itself is not allowed
};
inline constexpr Range any_value{};
inline constexpr Range positive{.least = 0.0, .above = true};
inline constexpr Range not_negative{.least = 0.0};
inline constexpr Range share{.least = 0.0, .most = 1.0};
inline constexpr Range share_above_0{.least = 0.0, .most = 1.0, .above = true};
inline constexpr Range share_below_1{.least = 0.0, .most = 1.0, .below = true};
inline constexpr Range at_least_1{.least = 1.0};

/// Whether something holds for the table's other values, and how a message says so ("" where it is always so).
struct Condition {
    bool holds;
    const char* text = "";
};
inline constexpr Condition always{true};
inline constexpr Condition never{false};

struct Facts {
    const char* unit = "1";  ///< SI unit; "1": none
    Range range = any_value;
    const char* words = "";  ///< allowed texts: "columnar | half | AA = columnar"; "": any text
    Condition required = never;
    Condition used = always;  ///< else left out of resolved.toml and, if it has a text, refused
    const char* unset = "";   ///< optional members: what "auto" stands for
    const char* meaning = "";
    const char* source = "";
};

struct Word {
    std::string typed, meant;  ///< "AA", "columnar"; the same but for an alias
};
std::vector<Word> words_of(const Facts& facts);
bool in_range(double value, const Range& range);
/// "> 0 m", ">= 0 and <= 1", "" if all is allowed.
std::string range_text(const Facts& facts);

/// What a key takes, for messages: `a quantity > 0 m such as "1 m"`, `one of "x", "y"`.
std::string expected(const double& member, const Facts& facts);
std::string expected(const std::optional<double>& member, const Facts& facts);
std::string expected(const int& member, const Facts& facts);
std::string expected(const std::int64_t& member, const Facts& facts);
std::string expected(const std::optional<std::int64_t>& member, const Facts& facts);
std::string expected(const bool& member, const Facts& facts);
std::string expected(const std::string& member, const Facts& facts);
std::string expected(const Vec3& member, const Facts& facts);
std::string expected(const std::optional<Vec3>& member, const Facts& facts);
std::string expected(const std::vector<double>& member, const Facts& facts);
std::string expected(const std::array<std::string, 2>& member, const Facts& facts);
std::string expected(const std::vector<std::string>& member, const Facts& facts);
std::string expected(const std::vector<Vec3>& member, const Facts& facts);

}  // namespace grainfrac
