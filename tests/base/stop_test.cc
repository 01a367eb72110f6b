// SPDX-License-Identifier: Apache-2.0
#include "base/stop.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "base/parallel.h"

namespace ridgeline {
namespace {

void WaitUntilDue() { std::this_thread::sleep_for(std::chrono::milliseconds(25)); }

TEST(Stop, EndsAParallelForWithoutThePartsThatAreLeft) {
  for (const int threads : {1, 4}) {
    std::atomic<int> done{0};
    std::atomic<bool> stop{false};
    const StopCheck check([&] {
      if (stop) throw std::domain_error("stopped");
    });
    const auto part = [&](std::size_t) {
      WaitUntilDue();
      if (++done == 3) stop = true;
    };
    EXPECT_THROW(ParallelFor(10000, threads, part), std::domain_error);
    EXPECT_LT(done, 100);
  }
}

TEST(Stop, IsAskedOnTheThreadThatMadeTheCheck) {
  const std::thread::id mine = std::this_thread::get_id();
  int asked = 0;
  const StopCheck check([&] {
    ++asked;
    EXPECT_EQ(std::this_thread::get_id(), mine);
  });
  ParallelFor(20, 4, [](std::size_t) { WaitUntilDue(); });
  EXPECT_GT(asked, 0);
}

TEST(Stop, TheInnermostCheckCountsAndItsEndBringsBackTheOuterOne) {
  int outer = 0;
  int inner = 0;
  const StopCheck first([&] { ++outer; });
  {
    const StopCheck second([&] { ++inner; });
    ThrowIfStopped();
  }
  EXPECT_EQ(inner, 1);
  EXPECT_EQ(outer, 0);
  WaitUntilDue();
  ThrowIfStopped();
  EXPECT_EQ(outer, 1);
}

TEST(Stop, NobodyIsAskedWithoutACheck) { EXPECT_NO_THROW(ThrowIfStopped()); }

TEST(Parallel, AFailedPartKeepsTheOthersFromBeginning) {
  std::atomic<int> begun{0};
  const auto fail = [&](std::size_t) {
    ++begun;
    throw std::runtime_error("part");
  };
  EXPECT_THROW(ParallelFor(1000, 2, fail), std::runtime_error);
  EXPECT_LE(begun, 2);
}

}  // namespace
}  // namespace ridgeline
