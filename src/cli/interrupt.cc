// SPDX-License-Identifier: Apache-2.0
#include "cli/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <thread>

#include "base/atomic_file.h"
#include "cli/context.h"

namespace ridgeline {

void CleanUpOnInterrupt() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread([signals] {
    int signal = 0;
    sigwait(&signals, &signal);
    RemoveTemporaries();
    std::fputs("\ninterrupted; nothing half written was left behind\n", stderr);
    _exit(kExitInterrupted);
  }).detach();
}

}  // namespace ridgeline
