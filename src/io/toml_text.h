// SPDX-License-Identifier: GPL-3.0-or-later
// Values as TOML.
#pragma once

#include "geometry/vec3.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace grainfrac {

/// Shortest text that reads back as the same double, as a TOML float.
inline std::string toml_text(double x)
{
    std::string text = fmt::format("{}", x);
    if (text.find_first_of(".en") == text.npos) text += ".0";  // n: inf, nan
    return text;
}
inline std::string toml_text(std::int64_t x)
{
    return fmt::format("{}", x);
}
inline std::string toml_text(int x)
{
    return fmt::format("{}", x);
}
inline std::string toml_text(bool x)
{
    return x ? "true" : "false";
}
inline std::string toml_text(const std::string& s)
{
    std::string out = "\"";
    for (const char c : s) {
        if (c == '"' || c == '\\') {
            out += {'\\', c};
        } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
            out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
        } else {
            out += c;
        }
    }
    return out + '"';
}
inline std::string toml_text(const Vec3& v);
template <class Range>
std::string toml_list(const Range& values)
{
    std::string out;
    for (const auto& value : values) out += (out.empty() ? "" : ", ") + toml_text(value);
    return '[' + out + ']';
}
inline std::string toml_text(const Vec3& v)
{
    return toml_list(std::array{v.x, v.y, v.z});
}
inline std::string toml_text(const std::vector<double>& v)
{
    return toml_list(v);
}
inline std::string toml_text(const std::vector<std::string>& v)
{
    return toml_list(v);
}
inline std::string toml_text(const std::vector<Vec3>& v)
{
    return toml_list(v);
}
inline std::string toml_text(const std::array<std::string, 2>& v)
{
    return toml_list(v);
}
template <class T>
std::string toml_text(const std::optional<T>& x)
{
    return x ? toml_text(*x) : "\"auto\"";
}

}  // namespace grainfrac
