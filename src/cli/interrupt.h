// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ridgeline {

// From here on Ctrl-C (SIGINT) and SIGTERM remove unfinished files and end the program with
// kExitInterrupted. Call once, before any thread is started: signals are blocked in all threads and
// awaited in one of its own, where removing files is allowed.
void CleanUpOnInterrupt();

}  // namespace ridgeline
