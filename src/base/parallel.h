// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace ridgeline {

// Number of threads an option value stands for: itself if > 0, all hardware threads if 0.
int ResolveThreads(int threads);

// Calls body(i) for i in [0, count) on up to `threads` threads, in no fixed order; body(i) writes
// slot i only. Rethrows the exception of the smallest index that threw, after all threads ended.
void ParallelFor(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

}  // namespace ridgeline
