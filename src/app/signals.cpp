// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/signals.h"

#include <csignal>
#include <cstdlib>

namespace grainfrac {

namespace {

volatile std::sig_atomic_t the_signal = 0;

void note(int signal)
{
    if (the_signal != 0) std::_Exit(128 + signal);
    the_signal = signal;
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
