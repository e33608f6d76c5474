// SPDX-License-Identifier: GPL-3.0-or-later
// Host threads: fixed slices, a short spin, then sleep. Measured against OpenMP and oneTBB on shared cores: no
// millisecond stalls, no false reports from the thread sanitizer.
#pragma once

namespace grainfrac {

/// Number of host threads that parallel_for uses, >= 1; results do not depend on it.
void set_threads(int n);
int threads();

namespace pool_detail {
using Slice = void (*)(const void* kernel, int begin, int end);
/// Split [0, n) in `threads()` contiguous slices and run slice(kernel, begin, end) on each; returns when all are done.
void run(Slice slice, const void* kernel, int n);
}  // namespace pool_detail

}  // namespace grainfrac
