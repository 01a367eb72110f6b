// SPDX-License-Identifier: Apache-2.0
#include "localize/coarse_to_fine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

// A score that knows the truth: a cone around a place and a heading on a rough floor. Tolerance
// makes the cone wider, and nothing else.
class Cone final : public Score {
 public:
  explicit Cone(double tolerance = 1.0) : tolerance_(tolerance) {}

  ViewParts parts() const override { return {.edges_and_skyline = false, .surfaces = false}; }
  double LogRatio(const PositionView&, const Pose& pose, Workspace&) const override {
    const Eigen::Vector3d& c = pose.center_in_world;
    const double heading = ViewAnglesOf(pose.cam_from_world).heading_deg;
    const double off = std::hypot(c.x() - kEast, c.y() - kNorth) +
                       std::abs(HeadingDifferenceDeg(heading, kHeading));
    const double floor = 20.0 + 3.0 * std::sin(1.7 * c.x()) * std::sin(2.3 * c.y() + heading);
    return std::max(80.0 - 12.0 * off / tolerance_, floor);
  }
  std::unique_ptr<Score> Tolerant(double factor) const override {
    return std::make_unique<Cone>(tolerance_ * factor);
  }

  static constexpr double kEast = 3.6;
  static constexpr double kNorth = -4.3;
  static constexpr double kHeading = 47.4;

 private:
  double tolerance_;
};

class CoarseToFine : public ::testing::Test {
 protected:
  // A house stands where the coarse grid has one of its places.
  CoarseToFine()
      : model_(testing::MakeCity({House()})), footprints_(model_), scene_(model_, nullptr, {}) {
    prior_.position_in_world = Eigen::Vector2d::Zero();
    prior_.height_in_world = 1.7;
    prior_.heading_deg = 40.0;
    prior_.pitch_deg = prior_.roll_deg = 0.0;
    ranges_.pitch_deg = ranges_.roll_deg = 0.0;
  }

  static testing::House House() {
    testing::House house;
    house.center = {-7.0, 8.0};
    house.length_m = house.width_m = 2.4;
    return house;
  }

  struct Volumes {
    PoseVolume dense;
    PoseVolume quick;
  };
  Volumes Compute(int threads = 1) const {
    const PoseSpace space(prior_, ranges_, scene_, nullptr, footprints_);
    const Cone cone;
    const PoseScorer fine(cone, scene_, space, camera_, 0.5);
    const std::unique_ptr<Score> coarse = cone.Tolerant(CoarseSpacingOf(ranges_, options_));
    const std::vector<Tilt> tilts(1);
    return {ComputeVolume(fine, tilts, options_, threads),
            ComputeVolumeCoarseToFine(fine.With(*coarse), fine, tilts, options_, threads)};
  }

  CityModel model_;
  Footprints footprints_;
  Scene scene_;
  PinholeCamera camera_{640, 480, 500.0, 500.0, 320.0, 240.0};
  PosePrior prior_;
  PoseSpaceOptions ranges_;
  MapOptions options_;
};

TEST_F(CoarseToFine, PosesNearTheBestAreThoseOfTheDenseVolume) {
  const Volumes v = Compute();
  ASSERT_EQ(v.quick.log_ratios.size(), v.dense.log_ratios.size());
  const float best = *std::max_element(v.dense.log_ratios.begin(), v.dense.log_ratios.end());
  std::size_t near = 0;
  for (std::size_t i = 0; i < v.dense.log_ratios.size(); ++i) {
    EXPECT_EQ(std::isfinite(v.quick.log_ratios[i]), std::isfinite(v.dense.log_ratios[i]));
    if (v.dense.log_ratios[i] < best - 15.0f) continue;
    ++near;
    EXPECT_EQ(v.quick.log_ratios[i], v.dense.log_ratios[i]);
  }
  EXPECT_GT(near, 10u);
  EXPECT_LT(v.quick.evaluations, v.dense.evaluations / 3);
}

TEST_F(CoarseToFine, AHeadingBehindTheEndOfTheCircleIsFound) {
  ranges_.heading_deg = 180.0;
  prior_.heading_deg = Cone::kHeading - 179.6;
  const Volumes v = Compute();
  EXPECT_EQ(*std::max_element(v.quick.log_ratios.begin(), v.quick.log_ratios.end()),
            *std::max_element(v.dense.log_ratios.begin(), v.dense.log_ratios.end()));
}

TEST_F(CoarseToFine, IsTheSameOnAnyNumberOfThreads) {
  EXPECT_EQ(Compute(1).quick.log_ratios, Compute(8).quick.log_ratios);
}

TEST_F(CoarseToFine, NothingIsSeenWhereNoPlaceIsAdmissible) {
  prior_.position_in_world = {-7.0, 8.0};
  ranges_.east_m = ranges_.north_m = 0.4;
  const Volumes v = Compute();
  EXPECT_EQ(v.quick.evaluations, 0u);
  for (const float value : v.quick.log_ratios) EXPECT_FALSE(std::isfinite(value));
}

}  // namespace
}  // namespace ridgeline
