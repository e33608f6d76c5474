// SPDX-License-Identifier: GPL-3.0-or-later
// history.csv: one row per history interval, for people, spreadsheets and scripts.
#pragma once

#include "io/growing_text.h"
#include "io/results.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace grainfrac {

/// The growing file. Each row is on disk when append returns; errors throw std::runtime_error that names the file.
class HistoryCsv {
public:
    /// Starts a new file with its `#` lines and the header. These hold nothing about the device or the threads: equal
    /// runs give equal files.
    HistoryCsv(std::filesystem::path path, const RunFacts& facts);
    /// Goes on from a checkpoint.
    HistoryCsv(std::filesystem::path path, const TextMark& mark) : file_(std::move(path), mark) {}
    void append(const HistoryRow& row);
    TextMark mark() const { return file_.mark(); }
    void close() { file_.close(); }

private:
    GrowingText file_;
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
