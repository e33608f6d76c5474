// SPDX-License-Identifier: GPL-3.0-or-later
// SIGINT and SIGTERM ask the run to stop at the next step, a second one ends the program at once; SIGUSR1 asks for a
// checkpoint.
#pragma once

namespace grainfrac {

/// From here on SIGUSR1, a closed terminal and a file beyond its limit do not end the program.
void survive_signals();
/// From here on the run is asked to stop; before, it has nothing to save and ends at once.
void watch_signals();
/// The signal that came, 0 if none.
int pending_signal();
/// Whether SIGUSR1 came since this was last asked.
bool checkpoint_asked_for();

}  // namespace grainfrac
