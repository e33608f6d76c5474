// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/signals.h"

#include <csignal>
#include <cstdlib>
#include <ctime>

namespace grainfrac {

namespace {

volatile std::sig_atomic_t the_signal = 0;
volatile std::time_t first_signal = 0;

/// The first one asks for a checkpoint and an orderly end, a second one ends at once. Within a second of the first it
/// is the same wish: a terminal and a wrapper may both pass it on.
void note(int signal)
{
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);  // safe in a signal handler
    if (the_signal == 0) {
        first_signal = now.tv_sec;
        the_signal = signal;
    } else if (now.tv_sec > first_signal + 1) {
        std::_Exit(128 + signal);
    }
}

}  // namespace

void watch_signals()
{
    the_signal = 0;
    std::signal(SIGINT, note);
    std::signal(SIGTERM, note);
    std::signal(SIGPIPE, SIG_IGN);  // a closed terminal must not end a run
}

int pending_signal()
{
    return the_signal;
}

}  // namespace grainfrac
