// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/signals.h"

#include <csignal>
#include <cstdlib>
#include <ctime>

namespace grainfrac {

namespace {

volatile std::sig_atomic_t the_signal = 0, checkpoint_asked = 0;
volatile double first_signal = 0.0;  // [s]
/// Within this time of the first signal a second one is the same wish: a terminal and a wrapper may both pass it on.
constexpr double same_wish = 0.5;  // [s]

/// The first one asks for a checkpoint and an orderly end, a second one ends at once.
void note(int signal)
{
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);  // safe in a signal handler
    const double seconds = static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    if (the_signal == 0) {
        first_signal = seconds;
        the_signal = signal;
    } else if (seconds > first_signal + same_wish) {
        std::_Exit(128 + signal);
    }
}

void note_checkpoint(int)
{
    checkpoint_asked = 1;
}

}  // namespace

void watch_signals()
{
    the_signal = 0;
    std::signal(SIGINT, note);
    std::signal(SIGTERM, note);
}

void survive_signals()
{
    std::signal(SIGUSR1, note_checkpoint);
    std::signal(SIGPIPE, SIG_IGN);  // a closed terminal must not end a run
    std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files is an error of the file, told as such
}

int pending_signal()
{
    return the_signal;
}

bool checkpoint_asked_for()
{
    const bool asked = checkpoint_asked != 0;
    checkpoint_asked = 0;
    return asked;
}

}  // namespace grainfrac
