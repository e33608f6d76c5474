// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/history_csv.h"

#include "io/atomic_file.h"
#include "io/csv_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <stdexcept>

namespace grainfrac {

namespace {

std::vector<std::string> split(const std::string& line)
{
    std::vector<std::string> cells;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    return cells;
}

double to_number(const std::string& text, const std::filesystem::path& path)
{
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        throw std::runtime_error(fmt::format("{}: \"{}\" is not a number", path.string(), text));
    return value;
}

std::string head(const RunFacts& facts)
{
    std::vector<std::string> names;
    HistoryRow{}.for_each_column([&](const char* name, auto) { names.emplace_back(name); });
    return fmt::format(
        "# grainfrac {}\n# test: {}\n# seed: {}\n# input: {}\n"
        "# signs: tension and opening are positive; the load and the displacement of a compression test are\n"
        "# magnitudes. SI units, named at the end of each column; no unit: pure number.\n"
        "# energies: external_work + gravity_work + inserted_energy + initial energy = kinetic + elastic +\n"
        "# friction + damping + fracture + error; energy_error is relative to the largest of them.\n{}\n",
        facts.version, facts.test_kind, facts.seed, facts.input_hash, fmt::join(names, ","));
}

}  // namespace

HistoryCsv::HistoryCsv(std::filesystem::path path, const RunFacts& facts) : file_(std::move(path), head(facts)) {}

void HistoryCsv::append(const HistoryRow& row)
{
    std::string line;
    row.for_each_column([&](const char*, auto value) { append_cell(line, value); });
    file_.append(line + '\n');
}

const std::vector<double>& HistoryTable::column(const std::string& name) const
{
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw std::runtime_error("history.csv has no column " + name);
    return columns[static_cast<std::size_t>(found - names.begin())];
}

HistoryTable read_history_csv(const std::filesystem::path& path)
{
    const std::string text = read_file(path);
    HistoryTable table;
    for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
        const std::string line = text.substr(begin, end - begin);
        if (line.empty() || line.front() == '#') continue;
        const std::vector<std::string> cells = split(line);
        if (table.names.empty()) {
            table.names = cells;
            table.columns.resize(cells.size());
            continue;
        }
        if (cells.size() != table.names.size())
            throw std::runtime_error(
                fmt::format("{}: a row has {} columns instead of {}", path.string(), cells.size(), table.names.size()));
        for (std::size_t c = 0; c < cells.size(); ++c) table.columns[c].push_back(to_number(cells[c], path));
    }
    if (table.names.empty()) throw std::runtime_error(path.string() + ": no header line");
    return table;
}

}  // namespace grainfrac
