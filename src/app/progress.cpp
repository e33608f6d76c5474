// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unistd.h>

namespace grainfrac {

namespace {

constexpr double terminal_interval = 0.2;  // [s]
constexpr double plain_interval = 5.0;     // [s]
constexpr int bar_width = 20;

double seconds_between(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b)
{
    return std::chrono::duration<double>(b - a).count();
}

std::string clock_text(double seconds)
{
    const auto s = std::lround(seconds);
    return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60)
                     : fmt::format("{}:{:02}", s / 60, s % 60);
}

}  // namespace

Progress::Progress(bool quiet)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0), start_(std::chrono::steady_clock::now()), last_(start_)
{
}

void Progress::begin(const ProgressState& s)
{
    first_step_ = s.step;
    first_done_ = s.done;
    start_ = last_ = std::chrono::steady_clock::now();
}

std::string Progress::line(const ProgressState& s, double seconds) const
{
    const double done = std::clamp(s.done, 0.0, 1.0);
    const double now_done = done - first_done_;
    const std::string left = now_done > 0.01 && seconds > 0.5 ? clock_text(seconds * (1.0 - done) / now_done) : "-:--";
    std::string text =
        fmt::format("{}  step {}  t {:.4g} s  {:.0f} steps/s  {} left  broken {}  fragments {}  load {:.4g} N", s.stage,
                    s.step, s.time, seconds > 0.0 ? static_cast<double>(s.step - first_step_) / seconds : 0.0, left,
                    s.broken, s.fragments, s.load);
    if (!terminal_) return fmt::format("{:3.0f} %  {}", 100.0 * done, text);
    const int full = static_cast<int>(bar_width * done);
    return fmt::format("[{}{}] {:3.0f} %  {}", std::string(static_cast<std::size_t>(full), '#'),
                       std::string(static_cast<std::size_t>(bar_width - full), '.'), 100.0 * done, text);
}

void Progress::update(const ProgressState& s)
{
    if (quiet_) return;
    const auto now = std::chrono::steady_clock::now();
    if (seconds_between(last_, now) < (terminal_ ? terminal_interval : plain_interval)) return;
    last_ = now;
    if (terminal_)
        fmt::print(stderr, "\r{}\033[K", line(s, seconds_between(start_, now)));
    else
        fmt::print(stderr, "{}\n", line(s, seconds_between(start_, now)));
    std::fflush(stderr);
}

void Progress::finish(const ProgressState& s)
{
    if (quiet_) return;
    const std::string text = line(s, seconds_between(start_, std::chrono::steady_clock::now()));
    if (terminal_)
        fmt::print(stderr, "\r{}\033[K\n", text);
    else
        fmt::print(stderr, "{}\n", text);
}

}  // namespace grainfrac
