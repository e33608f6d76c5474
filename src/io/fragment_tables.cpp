// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/atomic_file.h"
#include "io/csv_row.h"
#include "io/fragments.h"

#include <fmt/format.h>

#include <string>

namespace grainfrac {

namespace {

/// "m^3" -> "_m3", "m/s" -> "_m_per_s", "1" -> "".
std::string suffix(const std::string& unit)
{
    if (unit == "1") return "";
    std::string text = "_";
    for (const char c : unit) text += c == '/' ? std::string("_per_") : c == '^' ? std::string() : std::string(1, c);
    return text;
}

template <class Row>
std::string table(const char* what, const RunFacts& facts, const std::vector<Row>& rows)
{
    std::string header;
    const auto name = [&](const std::string& text) { header += (header.empty() ? "" : ",") + text; };
    Row{}.for_each_column([&](const char* column, const char* unit, const auto& value) {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Vec3>) {
            for (const char* component : {"_x", "_y", "_z"}) name(column + std::string(component) + suffix(unit));
        } else {
            name(column + suffix(unit));
        }
    });
    std::string text =
        fmt::format("# grainfrac {}: {}\n# input: {}\n{}\n", facts.version, what, facts.input_hash, header);
    for (const Row& row : rows) {
        std::string line;
        row.for_each_column([&](const char*, const char*, const auto& value) {
            if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Vec3>) {
                for (const double component : {value.x, value.y, value.z}) append_cell(line, component);
            } else {
                append_cell(line, value);
            }
        });
        text += line + '\n';
    }
    return text;
}

}  // namespace

void write_fragment_tables(const std::filesystem::path& folder, const RunFacts& facts,
                           const std::vector<Fragment>& fragments, const std::vector<Cluster>& clusters)
{
    write_file(folder / "fragments.csv", table("grains and parts of grains at the end", facts, fragments));
    write_file(folder / "clusters.csv", table("what bonds hold together at the end", facts, clusters));
}

}  // namespace grainfrac
