// SPDX-License-Identifier: GPL-3.0-or-later
// history.csv: one row per history interval, for people, spreadsheets and scripts.
#pragma once

#include "io/results.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace grainfrac {

/// The growing file. Each row is on disk when append returns; errors throw std::runtime_error that names the file.
class HistoryCsv {
public:
    /// Starts a new file with its `#` lines and the header. These hold nothing about the device or the threads: equal
    /// runs give equal files.
    HistoryCsv(std::filesystem::path path, const RunFacts& facts);
    void append(const HistoryRow& row);
    void close();

private:
    void put(const std::string& text);

    std::filesystem::path path_;
    std::ofstream file_;
};

/// history.csv read back.
struct HistoryTable {
    std::vector<std::string> names;
    std::vector<std::vector<double>> columns;

    /// Throws std::runtime_error if there is no such column.
    const std::vector<double>& column(const std::string& name) const;
    std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
};
/// Leaves out a last line that is not whole, as a killed run may leave one.
HistoryTable read_history_csv(const std::filesystem::path& path);

}  // namespace grainfrac
