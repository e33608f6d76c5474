// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of a run take.
#pragma once

#include <chrono>

namespace grainfrac {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point t)
{
    return std::chrono::duration<double>(Clock::now() - t).count();
}

}  // namespace grainfrac
