// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace ridgeline {

// Lets a caller stop long work between its parts: while a StopCheck lives, ParallelFor() calls
// `check` on the thread that made it, between parts and about every 20 ms; what `check` throws ends
// the work as an exception of the work itself would, without the parts that are left. For callers
// that have no thread or process to end, such as an interpreter asked to stop. Checks nest; the
// innermost counts.
class StopCheck {
 public:
  explicit StopCheck(std::function<void()> check);
  ~StopCheck();
  StopCheck(const StopCheck&) = delete;
  StopCheck& operator=(const StopCheck&) = delete;

 private:
  std::function<void()> check_;
  StopCheck* outer_;
  friend void ThrowIfStopped();
};

// Asks this thread's check, if there is one and it is due.
void ThrowIfStopped();

}  // namespace ridgeline
