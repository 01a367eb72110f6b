// SPDX-License-Identifier: Apache-2.0
#include "track/track_errors.h"

#include <algorithm>
#include <cmath>

#include "track/motion.h"

namespace ridgeline {
namespace {

double RootMeanSquare(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace

TrackErrors ErrorsOf(std::span<const std::optional<Pose>> poses,
                     std::span<const std::optional<Pose>> truths) {
  TrackErrors errors;
  std::vector<double> metres, degrees, step_metres, step_degrees;
  const auto share = [&](double& sum, bool counts) { sum += counts ? 1.0 : 0.0; };
  std::size_t before = poses.size();  // none
  for (std::size_t i = 0; i < truths.size(); ++i) {
    if (!truths[i]) continue;
    ++errors.frames;
    if (!poses[i]) {
      before = poses.size();
      continue;
    }
    ++errors.posed;
    const double m = (poses[i]->center_in_world - truths[i]->center_in_world).norm();
    const double deg = RotationDistanceDeg(poses[i]->cam_from_world, truths[i]->cam_from_world);
    metres.push_back(m);
    degrees.push_back(deg);
    share(errors.within_1m, m <= 1.0);
    share(errors.within_3m, m <= 3.0);
    share(errors.within_5m, m <= 5.0);
    share(errors.within_1m_1deg, m <= 1.0 && deg <= 1.0);
    share(errors.within_5deg, deg <= 5.0);
    if (before < poses.size()) {
      const Motion found = MotionBetween(*poses[before], *poses[i]);
      const Motion truth = MotionBetween(*truths[before], *truths[i]);
      step_metres.push_back((found.step_in_before - truth.step_in_before).norm());
      step_degrees.push_back(RotationDistanceDeg(found.now_from_before, truth.now_from_before));
    }
    before = i;
  }
  const double count = std::max<double>(1.0, static_cast<double>(errors.frames));
  for (double* sum : {&errors.within_1m,
                      &errors.within_3m,
                      &errors.within_5m,
                      &errors.within_1m_1deg,
                      &errors.within_5deg}) {
    *sum /= count;
  }
  errors.ate_rmse_m = RootMeanSquare(metres);
  errors.ate_median_m = Median(metres);
  errors.ate_max_m = metres.empty() ? 0.0 : *std::max_element(metres.begin(), metres.end());
  errors.rotation_median_deg = Median(degrees);
  errors.rotation_max_deg =
      degrees.empty() ? 0.0 : *std::max_element(degrees.begin(), degrees.end());
  errors.rpe_rmse_m = RootMeanSquare(step_metres);
  errors.rpe_rmse_deg = RootMeanSquare(step_degrees);
  errors.steps = step_metres.size();
  return errors;
}

}  // namespace ridgeline
