// SPDX-License-Identifier: Apache-2.0
#include "eval/egeniouss_metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/random.h"

namespace ridgeline {
namespace {

RunRecord RunOf(const Pose& truth, const std::optional<Pose>& answer) {
  RunRecord run;
  run.has_truth = true;
  run.pose = answer;
  if (answer) run.error = ErrorOf(*answer, truth);
  return run;
}

// Another way to the angle: the trace of R_truth * R_answer^T, of matrices that take the
// photogrammetric camera to the world, as the benchmark has them.
double AngleByTrace(const Pose& a, const Pose& b) {
  const Eigen::Matrix3d photo = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  const Eigen::Matrix3d ra = a.cam_from_world.toRotationMatrix().transpose() * photo;
  const Eigen::Matrix3d rb = b.cam_from_world.toRotationMatrix().transpose() * photo;
  const double cosine = std::clamp(0.5 * ((ra * rb.transpose()).trace() - 1.0), -1.0, 1.0);
  return std::acos(cosine) * 180.0 / std::numbers::pi;
}

TEST(EgenioussMetrics, AgreeWithAnotherComputationFromMatrices) {
  Random random(7, 0);
  std::vector<RunRecord> runs;
  std::vector<double> translations;
  std::vector<double> rotations;
  for (int i = 0; i < 200; ++i) {
    const ViewAngles angles{random.Uniform(0, 360), random.Uniform(-20, 20), random.Uniform(-9, 9)};
    const Pose truth{CamFromWorld(angles), {604000.0 + i, 5790000.0, 75.0}};
    const double size = i % 2 == 0 ? 0.4 : 4.0;
    ViewAngles off = angles;
    off.heading_deg += size * random.Normal();
    off.pitch_deg += size * random.Normal();
    off.roll_deg += size * random.Normal();
    const Eigen::Vector3d shift(random.Normal(), random.Normal(), random.Normal());
    const Pose answer{CamFromWorld(off), truth.center_in_world + size * shift};
    runs.push_back(RunOf(truth, answer));
    translations.push_back(size * shift.norm());
    rotations.push_back(AngleByTrace(truth, answer));
  }
  const EgenioussMetrics metrics = EgenioussMetricsOf(runs);
  EXPECT_EQ(metrics.poses, 200);
  const auto check = [](std::vector<double> values, const EgenioussSpread& spread) {
    double sum = 0.0;
    double squares = 0.0;
    for (const double value : values) {
      sum += value;
      squares += value * value;
    }
    std::nth_element(values.begin(), values.begin() + 100, values.end());
    const double upper = values[100];
    const double lower = *std::max_element(values.begin(), values.begin() + 100);
    EXPECT_NEAR(spread.mean, sum / 200.0, 1e-6);
    EXPECT_NEAR(spread.rmse, std::sqrt(squares / 200.0), 1e-6);
    EXPECT_NEAR(spread.median, 0.5 * (lower + upper), 1e-6);
  };
  check(translations, metrics.translation_m);
  check(rotations, metrics.rotation_deg);
  for (std::size_t b = 0; b < kEgenioussBins.size(); ++b) {
    int hits = 0;
    for (std::size_t i = 0; i < 200; ++i) {
      hits += translations[i] < kEgenioussBins[b].translation_m &&
                      rotations[i] < kEgenioussBins[b].rotation_deg
                  ? 1
                  : 0;
    }
    EXPECT_DOUBLE_EQ(metrics.share[b], hits / 200.0);
    EXPECT_GT(hits, 0);
    EXPECT_LT(hits, 200);
  }
}

TEST(EgenioussMetrics, BinsAreStrictAndMissingPosesAreCountedApart) {
  const Pose truth{Eigen::Quaterniond::Identity(), {10.0, 20.0, 30.0}};
  const Pose on_the_edge{truth.cam_from_world, {10.5, 20.0, 30.0}};
  RunRecord unknown;
  unknown.pose = truth;
  const std::vector<RunRecord> runs = {
      RunOf(truth, on_the_edge), RunOf(truth, std::nullopt), unknown};
  const EgenioussMetrics metrics = EgenioussMetricsOf(runs);
  EXPECT_EQ(metrics.poses, 1);
  EXPECT_EQ(metrics.missing, 1);
  EXPECT_EQ(metrics.share[0], 0.0);  // 0.5 m is not below 0.5 m
  EXPECT_EQ(metrics.share[1], 1.0);
}

TEST(EgenioussMetrics, AreZeroWithoutPoses) {
  EXPECT_EQ(EgenioussMetricsOf({}).poses, 0);
  EXPECT_EQ(EgenioussMetricsOf({}).translation_m.rmse, 0.0);
}

}  // namespace
}  // namespace ridgeline
