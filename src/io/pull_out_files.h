// SPDX-License-Identifier: GPL-3.0-or-later
// pull_out.csv, a row for each state of a pull-out; profiles.csv, what the interface does along the fibre; their plots.
#pragma once

#include "experiment/pull_out.h"
#include "io/folder_mark.h"
#include "io/growing_text.h"
#include "io/results.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grainfrac {

class PullOutFiles {
public:
    /// `profiles_at`: mean damages whose profiles are kept, each where it is first reached.
    PullOutFiles(const std::filesystem::path& folder, std::vector<double> profiles_at);
    /// Goes on from a checkpoint.
    PullOutFiles(const std::filesystem::path& folder, std::vector<double> profiles_at, const PullOutMark& mark);
    /// Each row is on disk when it returns; errors throw std::runtime_error that names the file.
    void append(const PullOutState& row, const FibreProfile& profile);
    /// The profile without damage, where none came.
    void finish();
    PullOutMark mark() const;

private:
    void put_profile(const PullOutState& row, const FibreProfile& profile);

    GrowingText rows_, profiles_;
    std::vector<double> due_;  // rising
    std::size_t next_ = 0;
    std::optional<std::pair<PullOutState, FibreProfile>> whole_;  // without damage, the last so far
};

/// Throws std::runtime_error that names the file unless both begin as the mark says.
void check_heads(const std::filesystem::path& folder, const PullOutMark& mark);

/// plots/pull_out: stress at the fibre's end against slip and displacement; plots/fibre_shear and plots/fibre_stress:
/// the profiles. From the two files in `folder`.
void write_pull_out_plots(const std::filesystem::path& folder);

}  // namespace grainfrac
