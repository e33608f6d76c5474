// SPDX-License-Identifier: GPL-3.0-or-later
// SIGINT and SIGTERM ask the run to stop at the next step; a second one ends the program at once.
#pragma once

namespace grainfrac {

void watch_signals();
/// The signal that came, 0 if none.
int pending_signal();

}  // namespace grainfrac
