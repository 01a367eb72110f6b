// SPDX-License-Identifier: Apache-2.0
#include "base/stop.h"

#include <chrono>
#include <utility>

namespace ridgeline {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kInterval = std::chrono::milliseconds(20);

thread_local StopCheck* innermost = nullptr;
thread_local Clock::time_point next_check;

}  // namespace

StopCheck::StopCheck(std::function<void()> check)
    : check_(std::move(check)), outer_(std::exchange(innermost, this)) {
  next_check = Clock::now();
}

StopCheck::~StopCheck() { innermost = outer_; }

void ThrowIfStopped() {
  if (innermost == nullptr || Clock::now() < next_check) return;
  next_check = Clock::now() + kInterval;
  innermost->check_();
}

}  // namespace ridgeline
