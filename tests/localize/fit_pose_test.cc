// SPDX-License-Identifier: Apache-2.0
#include "localize/fit_pose.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "lines/angle_to_direction.h"
#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

const PinholeCamera kCamera{640, 480, 530.0, 530.0, 320.0, 240.0};

// Two rows of gabled houses along a street to the north.
CityModel Street() {
  std::vector<testing::House> houses;
  for (int i = 0; i < 8; ++i) {
    testing::House house;
    house.center = {i % 2 == 0 ? -12.0 : 13.0, 8.0 + 9.0 * i};
    house.length_m = 9.0 + i % 3;
    house.width_m = 8.0;
    house.heading_deg = 7.0 * (i % 4);
    house.eaves_m = 5.0 + 0.8 * i;
    house.ridge_m = house.eaves_m + 3.0;
    houses.push_back(house);
  }
  return testing::MakeCity(houses);
}

Vector6 VectorOf(const PoseSpace::Offset& o) {
  Vector6 v;
  v << o.east_m, o.north_m, o.height_m, o.heading_deg, o.pitch_deg, o.roll_deg;
  return v;
}

class FitPoseOnAStreet : public ::testing::Test {
 protected:
  FitPoseOnAStreet() : model_(Street()), footprints_(model_), scene_(model_, nullptr, {}) {
    truth_.center_in_world = {0.4, -9.0, 1.7};
    truth_.cam_from_world = CamFromWorld(ViewAngles{3.0, 6.0, -1.0});
    prior_.position_in_world = truth_.center_in_world.head<2>();
    prior_.height_in_world = truth_.center_in_world.z();
    prior_.heading_deg = 3.0;
    prior_.pitch_deg = 6.0;
    prior_.roll_deg = -1.0;
    ranges_ = {2.0, 2.0, 2.0, 5.0, 5.0, 5.0};
    likelihood_.sigma_model_m = 0.1;
  }

  // The visible edges of the truth as lines, each once.
  std::vector<LineSegment> ExactLines(const PinholeCamera& camera = kCamera) const {
    const VisibleSet visible = scene_.VisibleFrom(truth_.center_in_world, {0.0, 1.5});
    std::vector<ProjectedSegment> projected;
    ProjectPieces(visible, camera, truth_, projected);
    std::vector<LineSegment> lines;
    for (const ProjectedSegment& segment : projected) {
      if ((segment.b - segment.a).norm() > 16.0f) lines.push_back({segment.a, segment.b, 1.0f});
    }
    return lines;
  }

  PoseFit FitTo(const std::vector<LineSegment>& lines,
                const PoseSpace::Offset& start,
                const PoseFitOptions& options = {}) const {
    return FitTo(lines, Field(lines), start, options);
  }

  PoseFit FitTo(const std::vector<LineSegment>& lines,
                const OrientedDistanceField& field,
                const PoseSpace::Offset& start,
                const PoseFitOptions& options) const {
    const PoseSpace space(prior_, ranges_, scene_, nullptr, footprints_);
    return FitPose({lines, field, kCamera}, scene_, space, likelihood_, options, start);
  }

  static OrientedDistanceField Field(const std::vector<LineSegment>& lines) {
    return {lines, kCamera.width, kCamera.height, 1};
  }

  static PoseFitOptions Wide() {
    PoseFitOptions options;
    options.first_tolerance = 8.0;
    options.max_rounds = 12;
    return options;
  }

  CityModel model_;
  Footprints footprints_;
  Scene scene_;
  Pose truth_;
  PosePrior prior_;
  PoseSpaceOptions ranges_;
  LineLikelihoodOptions likelihood_;
};

TEST_F(FitPoseOnAStreet, ComesHomeFromAMetreAndTwoDegrees) {
  const auto lines = ExactLines();
  for (const PoseSpace::Offset& start :
       {PoseSpace::Offset{0.6, -0.6, 0.5, 1.2, -1.0, 1.0}, {-0.7, 0.7, 0.0, -2.0, 0.0, 0.0}}) {
    const PoseFit fit = FitTo(lines, start, Wide());
    ASSERT_EQ(fit.status, PoseFitStatus::kOk) << fit.reason;
    const Vector6 error = VectorOf(fit.offset);
    EXPECT_LT(error.head<3>().norm(), 0.01);
    EXPECT_LT(error.tail<3>().norm(), 0.01);
  }
}

TEST_F(FitPoseOnAStreet, OutliersHaveNoInfluence) {
  std::vector<LineSegment> lines = ExactLines();
  Random random(1, HashText("OutliersHaveNoInfluence"));
  const std::size_t outliers = 2 * lines.size();
  for (std::size_t i = 0; i < outliers; ++i) {
    const Eigen::Vector2f a(random.Uniform(0, 640), random.Uniform(0, 480));
    const double turn = random.Uniform(0, 2 * M_PI);
    const Eigen::Vector2f d(40 * std::cos(turn), 40 * std::sin(turn));
    lines.push_back({a, a + d, 1.0f});
  }
  const PoseFit fit = FitTo(lines, {0.3, -0.3, 0.2, 0.5, -0.5, 0.5});
  ASSERT_EQ(fit.status, PoseFitStatus::kOk);
  // Random lines within a standard deviation (1.6 px) of an edge do count.
  EXPECT_LT(VectorOf(fit.offset).head<3>().norm(), 0.1);
  EXPECT_LT(VectorOf(fit.offset).tail<3>().norm(), 0.1);
}

TEST_F(FitPoseOnAStreet, FixedParametersDoNotMove) {
  ranges_.height_m = ranges_.pitch_deg = ranges_.roll_deg = 0.0;
  const PoseFit fit = FitTo(ExactLines(), {0.4, 0.4, 0.0, 1.0, 0.0, 0.0});
  EXPECT_EQ(fit.offset.height_m, 0.0);
  EXPECT_EQ(fit.offset.pitch_deg, 0.0);
  EXPECT_EQ(fit.offset.roll_deg, 0.0);
  EXPECT_EQ(fit.covariance.row(kPitch).norm(), 0.0);
  EXPECT_GT(fit.covariance(kEast, kEast), 0.0);
  EXPECT_LT(std::hypot(fit.offset.east_m, fit.offset.north_m), 0.01);
}

TEST_F(FitPoseOnAStreet, StaysInTheBox) {
  prior_.position_in_world += Eigen::Vector2d(0.9, 0.0);
  ranges_.east_m = 0.5;  // the truth is 0.9 m away
  const PoseFit fit = FitTo(ExactLines(), {});
  EXPECT_GE(fit.offset.east_m, -0.5);
  EXPECT_LT(fit.offset.east_m, -0.45);
}

TEST_F(FitPoseOnAStreet, CovarianceIsThatOfNoisyLines) {
  const auto exact = ExactLines();
  likelihood_.sigma_model_m = 0.0;
  PoseFitOptions options;
  options.matches.full_overlap_width = options.matches.min_overlap_width;  // all lines count as 1
  const double sigma_px = likelihood_.sigma_width * kCamera.width;
  Random random(1, HashText("CovarianceIsThatOfNoisyLines"));
  const OrientedDistanceField field = Field(exact);  // the density of lines does not change
  constexpr int kRuns = 100;
  Eigen::Matrix<double, 6, 6> sum = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 6> expected = Eigen::Matrix<double, 6, 6>::Zero();
  for (int run = 0; run < kRuns; ++run) {
    std::vector<LineSegment> lines = exact;
    for (LineSegment& line : lines) {
      const Eigen::Vector2f d = (line.b - line.a).normalized();
      const Eigen::Vector2f across(-d.y(), d.x());
      line.a += static_cast<float>(sigma_px * random.Normal()) * across;
      line.b += static_cast<float>(sigma_px * random.Normal()) * across;
    }
    const PoseFit fit = FitTo(lines, field, {}, options);
    ASSERT_EQ(fit.status, PoseFitStatus::kOk) << fit.reason;
    const Vector6 error = VectorOf(fit.offset);
    sum += error * error.transpose() / kRuns;
    expected += fit.covariance / kRuns;
  }
  // 100 runs know a deviation to 7 %; matches that are missed or wrong widen the rest.
  for (int k = 0; k < 6; ++k) {
    const double ratio = std::sqrt(sum(k, k) / expected(k, k));
    EXPECT_GT(ratio, 0.6) << k;
    EXPECT_LT(ratio, 1.5) << k;
  }
}

TEST_F(FitPoseOnAStreet, FindsTheFocalLength) {
  PinholeCamera longer = kCamera;
  longer.fx *= 1.02;
  longer.fy *= 1.02;
  likelihood_.sigma_width = 0.0005;  // the picture outweighs the prior of the focal length
  likelihood_.sigma_model_m = 0.01;
  PoseFitOptions options = Wide();
  options.first_tolerance = 32.0;
  options.focal_range_percent = 3.0;
  const PoseFit fit = FitTo(ExactLines(longer), {0.2, 0.2, 0.0, 0.5, 0.0, 0.0}, options);
  EXPECT_NEAR(fit.focal_factor, 1.02, 1e-3);
  EXPECT_LT(VectorOf(fit.offset).head<3>().norm(), 0.05);
  EXPECT_GT(fit.focal_sigma_percent, 0.0);
}

TEST_F(FitPoseOnAStreet, WithoutLinesNothingIsFitted) {
  const PoseSpace::Offset start{0.5, 0.0, 0.0, 0.0, 0.0, 0.0};
  const PoseFit fit = FitTo({}, start);
  EXPECT_EQ(fit.status, PoseFitStatus::kNoMatches);
  EXPECT_FALSE(fit.reason.empty());
  EXPECT_EQ(fit.offset.east_m, 0.5);
}

TEST_F(FitPoseOnAStreet, ThePriorHoldsWhatThePictureLeavesOpen) {
  // One edge alone: a vertical one.
  std::vector<LineSegment> one;
  for (const LineSegment& line : ExactLines()) {
    const Eigen::Vector2f d = (line.b - line.a).normalized();
    if (std::abs(d.x()) < 0.1f && line.Length() > 60.0f && one.empty()) one.push_back(line);
  }
  ASSERT_EQ(one.size(), 1u);
  const PoseFit fit = FitTo(one, {0.1, 0.1, 0.1, 0.0, 0.0, 0.0});
  EXPECT_EQ(fit.status, PoseFitStatus::kUndetermined);
  EXPECT_NE(fit.reason.find("height"), std::string::npos) << fit.reason;
  EXPECT_TRUE(VectorOf(fit.offset).allFinite());
  EXPECT_TRUE(fit.covariance.allFinite());
  EXPECT_NEAR(fit.offset.height_m, 0.0, 0.05);  // drawn to the prior
  EXPECT_NEAR(std::sqrt(fit.covariance(kHeight, kHeight)), 2.0 / std::sqrt(3.0), 0.05);
}

TEST_F(FitPoseOnAStreet, ParallelEdgesLeaveOneDirectionOpen) {
  // Vertical edges say nothing of the height.
  std::vector<LineSegment> vertical;
  for (const LineSegment& line : ExactLines()) {
    const Eigen::Vector2f d = (line.b - line.a).normalized();
    if (std::abs(d.x()) < 0.2f) vertical.push_back(line);
  }
  ASSERT_GT(vertical.size(), 3u);
  const PoseFit fit = FitTo(vertical, {0.2, 0.2, 0.5, 0.3, 0.0, 0.0});
  EXPECT_EQ(fit.status, PoseFitStatus::kUndetermined);
  EXPECT_EQ(fit.reason, "the matched lines leave open: height");
  EXPECT_LT(std::abs(fit.offset.east_m), 0.05);
  EXPECT_TRUE(fit.covariance.allFinite());
}

TEST_F(FitPoseOnAStreet, APoseInABuildingIsNamed) {
  prior_.position_in_world = {-12.0, 8.0};
  const PoseFit fit = FitTo(ExactLines(), {});
  EXPECT_EQ(fit.status, PoseFitStatus::kNotAdmissible);
  EXPECT_FALSE(fit.reason.empty());
}

TEST(MatchResiduals, JacobianIsThatOfDifferences) {
  AdjustmentFrame frame;
  frame.camera = kCamera;
  frame.center = {1.0, -2.0, 3.0};
  frame.slope = {0.03, -0.07};
  frame.angles = {35.0, 8.0, -4.0};
  EdgeMatch match;
  match.a = {10.0, 14.0, 6.0};
  match.b = {13.0, 20.0, 7.0};
  match.overhang = {0.6, 0.8, -0.5};
  match.normal = Eigen::Vector2d(0.6, -0.8);
  match.offset_px = 20.0;
  match.sigma_a_px = 2.0;
  match.sigma_b_px = 3.0;
  AdjustmentVector x;
  x << 0.3, -0.2, 0.1, 2.0, -1.0, 0.5, 1.5, 0.4;
  Eigen::Vector2d r;
  Eigen::Matrix<double, 2, kAdjustmentUnknowns> jacobian;
  ASSERT_TRUE(MatchResiduals(match, frame, x, r, &jacobian));
  for (int k = 0; k < kAdjustmentUnknowns; ++k) {
    constexpr double kStep = 1e-5;
    AdjustmentVector more = x;
    AdjustmentVector less = x;
    more[k] += kStep;
    less[k] -= kStep;
    Eigen::Vector2d r_more;
    Eigen::Vector2d r_less;
    ASSERT_TRUE(MatchResiduals(match, frame, more, r_more, nullptr));
    ASSERT_TRUE(MatchResiduals(match, frame, less, r_less, nullptr));
    const Eigen::Vector2d difference = (r_more - r_less) / (2 * kStep);
    EXPECT_LT((jacobian.col(k) - difference).norm(), 1e-6 * (1.0 + difference.norm())) << k;
  }
  // The frame's own pose and camera project the same.
  const Eigen::Vector2d image = frame.CameraAt(x).ImageFromCamera(
      frame.PoseAt(x).CameraFromWorld(match.a + x[kOverhang] * match.overhang));
  EXPECT_NEAR(r[0], (match.normal.dot(image) - 20.0) / 2.0, 1e-9);
}

TEST(DirectionResidual, JacobianIsThatOfDifferences) {
  AdjustmentFrame frame;
  frame.camera = kCamera;
  frame.angles = {35.0, 8.0, -4.0};
  DirectionMatch match;
  match.line = {{200.0f, 100.0f}, {230.0f, 300.0f}, 1.0f};
  match.direction = Eigen::Vector3d(0.3, -0.2, 0.9).normalized();
  AdjustmentVector x;
  x << 0.3, -0.2, 0.1, 2.0, -1.0, 0.5, 1.5, 0.4;
  Eigen::Matrix<double, 1, kAdjustmentUnknowns> jacobian;
  const double residual = DirectionResidual(match, frame, x, &jacobian);
  const double angle = AngleToDirection(match.line, frame.CameraAt(x),
                                        frame.PoseAt(x).cam_from_world * match.direction);
  EXPECT_NEAR(std::abs(residual), std::abs(std::sin(angle)) / match.sigma_rad, 1e-9);
  for (int k = 0; k < kAdjustmentUnknowns; ++k) {
    constexpr double kStep = 1e-5;
    AdjustmentVector more = x;
    AdjustmentVector less = x;
    more[k] += kStep;
    less[k] -= kStep;
    const double difference = (DirectionResidual(match, frame, more, nullptr) -
                               DirectionResidual(match, frame, less, nullptr)) /
                              (2 * kStep);
    EXPECT_NEAR(jacobian[k], difference, 1e-6 * (1.0 + std::abs(difference))) << k;
  }
}

TEST(MatchResiduals, APointBehindTheCameraHasNone) {
  AdjustmentFrame frame;
  frame.camera = kCamera;
  EdgeMatch match;
  match.a = {0.0, -5.0, 0.0};
  match.b = {0.0, 5.0, 0.0};
  Eigen::Vector2d r;
  EXPECT_FALSE(MatchResiduals(match, frame, AdjustmentVector::Zero(), r, nullptr));
}

TEST(OverhangOf, GoesOutwardFromTheWallAndDownTheRoof) {
  testing::House house;  // its length to the north, ridge along it
  house.eaves_m = 5.0;
  house.ridge_m = 8.0;
  const CityModel model = testing::MakeCity({house});
  int eaves = 0;
  for (const FeatureEdge& edge : model.feature_edges) {
    const Eigen::Vector3d overhang = OverhangOf(edge, model);
    const bool is_eaves = std::abs(edge.a.z() - 5.0) < 1e-6 && std::abs(edge.b.z() - 5.0) < 1e-6 &&
                          std::abs(edge.a.x() - edge.b.x()) < 1e-6;
    if (!is_eaves) continue;
    ++eaves;
    EXPECT_NEAR(std::abs(overhang.x()), 1.0, 1e-6);
    EXPECT_GT(overhang.x() * edge.a.x(), 0.0);
    EXPECT_NEAR(overhang.z(), -3.0 / 4.0, 1e-6);  // the roof rises by 3 m over half the width, 4 m
  }
  EXPECT_EQ(eaves, 2);
}

}  // namespace
}  // namespace ridgeline
