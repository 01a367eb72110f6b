// SPDX-License-Identifier: Apache-2.0
#include "track/gnss_monitor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/random.h"

namespace ridgeline {
namespace {

struct Lie {
  double from_s = 1e9;
  double jump_m = 0.0;
  double drag_m_s = 0.0;
};

struct Outcome {
  bool noticed = false;
  double at_s = 0.0;
  GnssMonitor::Verdict verdict;  // when it was noticed
};

// Two minutes of fixes, one a second, of a receiver with a drifting error of 2 m and noise of 1 m
// against a track that is good to 0.3 m.
Outcome Watch(std::uint64_t seed, const Lie& lie) {
  Random random(seed, 1);
  const auto pair = [&](double sigma) -> Eigen::Vector2d {
    const double x = random.Normal();
    return sigma * Eigen::Vector2d(x, random.Normal());
  };
  const double keep = std::exp(-1.0 / 60.0);
  const double towards = random.Uniform(0.0, 2.0 * std::numbers::pi);
  const Eigen::Vector2d direction(std::sin(towards), std::cos(towards));
  GnssMonitor monitor(GnssMonitorOptions{});
  Eigen::Vector2d drift = pair(2.0);
  Outcome outcome;
  for (int t = 0; t < 120; ++t) {
    drift = keep * drift + std::sqrt(1.0 - keep * keep) * pair(2.0);
    const Eigen::Vector2d truth(8.0 * t, -3.0 * t);
    Eigen::Vector2d fix = truth + drift + pair(1.0);
    if (t >= lie.from_s) fix += (lie.jump_m + lie.drag_m_s * (t - lie.from_s)) * direction;
    const GnssMonitor::Verdict verdict = monitor.Add(t, fix, truth + pair(0.3), 0.3);
    if (verdict.first) outcome = {true, static_cast<double>(t), verdict};
  }
  return outcome;
}

TEST(GnssMonitor, IsQuietWithAnHonestReceiver) {
  int alarms = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) alarms += Watch(seed, {}).noticed ? 1 : 0;
  EXPECT_LE(alarms, 5);  // 1 % of two-minute runs
}

TEST(GnssMonitor, NoticesASlowDragWithinTenMetres) {
  int in_time = 0;
  double begin_error_s = 0.0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Outcome outcome = Watch(seed, {60.0, 0.0, 0.5});
    if (!outcome.noticed) continue;
    EXPECT_TRUE(outcome.verdict.lies);
    in_time += outcome.at_s >= 60.0 && 0.5 * (outcome.at_s - 60.0) <= 10.0 ? 1 : 0;
    begin_error_s += std::abs(outcome.verdict.since_s - 60.0);
  }
  EXPECT_GE(in_time, 279);  // 93 %
  EXPECT_LT(begin_error_s / 300.0, 5.0);
}

TEST(GnssMonitor, NoticesAJumpAtOnceAndSaysHowFar) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Outcome outcome = Watch(seed, {50.0, 30.0, 0.0});
    ASSERT_TRUE(outcome.noticed);
    EXPECT_NEAR(outcome.at_s, 50.0, 1.0);
    EXPECT_FALSE(outcome.verdict.is_drag);
    EXPECT_NEAR(outcome.verdict.size.norm(), 30.0, 8.0);
  }
}

TEST(GnssMonitor, PassesOverTimesThatDoNotRise) {
  GnssMonitor monitor(GnssMonitorOptions{});
  monitor.Add(5.0, {0.0, 0.0}, {0.0, 0.0}, 0.3);
  const auto verdict = monitor.Add(4.0, {500.0, 0.0}, {0.0, 0.0}, 0.3);
  EXPECT_FALSE(verdict.lies);
}

TEST(GnssMonitor, OptionsHaveRanges) {
  GnssMonitorOptions options;
  options.noise_m = 0.0;
  EXPECT_THROW(CheckOptions(options), InputError);
}

}  // namespace
}  // namespace ridgeline
