// SPDX-License-Identifier: GPL-3.0-or-later
// The live progress line.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace grainfrac {

struct ProgressState {
    std::string stage;
    std::int64_t step = 0;
    double time = 0.0;  ///< simulated [s]
    double done = 0.0;  ///< share of the run that is done, as far as can be told [-]
    std::int64_t broken = 0, fragments = 0;
    double load = 0.0;  ///< [N]
};

/// On a terminal one line rewritten in place, else a plain line every few seconds; nothing if quiet.
class Progress {
public:
    explicit Progress(bool quiet);
    /// Where this process takes up the run: speed and time left count from here.
    void begin(const ProgressState& s);
    void update(const ProgressState& s);
    /// Leaves the last state standing and ends the line.
    void finish(const ProgressState& s);

private:
    std::string line(const ProgressState& s, double seconds) const;
    bool quiet_, terminal_;
    std::int64_t first_step_ = 0;
    double first_done_ = 0.0;
    std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace grainfrac
