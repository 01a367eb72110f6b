// SPDX-License-Identifier: Apache-2.0
#include "augment/insertion.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include <Eigen/Geometry>
#include <cmath>

#include "augment/impact.h"
#include "base/error.h"
#include "support/synthetic_city.h"
#include "support/synthetic_terrain.h"

namespace ridgeline {
namespace {

constexpr double kFocalPx = 300.0;
const cv::Vec3b kPhoto(10, 20, 250);

PinholeCamera Camera() { return {320, 240, kFocalPx, kFocalPx, 160.0, 120.0}; }

// At eye height, looking level to the north.
Pose Viewer() { return {CamFromWorld(ViewAngles{0.0, 0.0, 0.0}), {0.0, 0.0, 1.6}}; }

// A box 10 m wide and 8 m high, its front 46 m north of the viewer.
TexturedMesh Box() {
  return TexturedFrom(testing::MakeCity({{{0.0, 50.0}, 8.0, 10.0, 0.0, 0.0, 8.0, 8.0}}));
}

// Share of the picture that the box's front fills.
double FrontShare() { return (10.0 * kFocalPx / 46.0) * (8.0 * kFocalPx / 46.0) / (320.0 * 240.0); }

Insertion Insert(const CityModel& city_model,
                 const InsertionOptions& options = {},
                 const cv::Mat& foreground = {},
                 const HeightGrid* dtm = nullptr) {
  const TexturedMesh box = Box();
  const Scene city(city_model, dtm, ProjectionOptions{});
  return Inserter(city, box).Insert(cv::Mat(240, 320, CV_8UC3, cv::Scalar(kPhoto)),
                                    Camera(),
                                    Viewer(),
                                    options,
                                    foreground);
}

// A house behind the viewer: it hides nothing.
const testing::House kBehind{{0.0, -40.0}, 8.0, 10.0, 0.0, 0.0, 6.0, 6.0};

TEST(Inserter, FillsItsOutlineAndNothingElse) {
  const Insertion result = Insert(testing::MakeCity({kBehind}));
  // A pixel's width around the outline.
  EXPECT_NEAR(result.visible_share, FrontShare(), 0.05 * FrontShare());
  EXPECT_NEAR(result.hidden_share, 0.0, 1e-6);
  int changed = 0, covered = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      changed += result.picture.at<cv::Vec3b>(y, x) != kPhoto;
      covered += result.coverage.at<std::uint8_t>(y, x) > 0;
    }
  }
  EXPECT_NEAR(changed / (320.0 * 240.0), FrontShare(), 0.05 * FrontShare());
  EXPECT_EQ(changed, covered);
}

TEST(Inserter, IsHiddenByWhatStandsBeforeIt) {
  const Insertion all =
      Insert(testing::MakeCity({{{0.0, 25.0}, 6.0, 60.0, 0.0, 0.0, 12.0, 12.0}}));
  EXPECT_EQ(all.visible_share, 0.0);
  EXPECT_EQ(all.hidden_share, 1.0);
  EXPECT_EQ(all.picture.at<cv::Vec3b>(110, 160), kPhoto);
  // A house whose west side is in the line of sight to the middle: the east half is hidden.
  const Insertion half =
      Insert(testing::MakeCity({{{20.0, 25.0}, 6.0, 40.0, 0.0, 0.0, 12.0, 12.0}}));
  EXPECT_NEAR(half.hidden_share, 0.5, 0.03);
  EXPECT_NEAR(half.visible_share, 0.5 * FrontShare(), 0.05 * FrontShare());
}

TEST(Inserter, RevealsHiddenPartsHatched) {
  InsertionOptions options;
  options.reveal = 0.5;
  const Insertion all =
      Insert(testing::MakeCity({{{0.0, 25.0}, 6.0, 60.0, 0.0, 0.0, 12.0, 12.0}}), options);
  EXPECT_EQ(all.visible_share, 0.0);
  int changed = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) changed += all.picture.at<cv::Vec3b>(y, x) != kPhoto;
  }
  EXPECT_NEAR(changed / (320.0 * 240.0), 0.5 * FrontShare(), 0.1 * FrontShare());
}

TEST(Inserter, OpacityMixesWithThePhoto) {
  const CityModel city = testing::MakeCity({kBehind});
  InsertionOptions options;
  const cv::Vec3b solid = Insert(city, options).picture.at<cv::Vec3b>(110, 160);
  options.opacity = 0.5;
  const cv::Vec3b half = Insert(city, options).picture.at<cv::Vec3b>(110, 160);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(half[c], 0.5 * (solid[c] + kPhoto[c]), 2.0);
}

TEST(Inserter, AForegroundStaysBeforeIt) {
  cv::Mat mask = cv::Mat::zeros(240, 320, CV_8U);
  mask.colRange(160, 320).setTo(255);
  const Insertion result = Insert(testing::MakeCity({kBehind}), {}, mask);
  EXPECT_EQ(result.picture.at<cv::Vec3b>(110, 170), kPhoto);
  EXPECT_NE(result.picture.at<cv::Vec3b>(110, 150), kPhoto);
  EXPECT_NEAR(result.hidden_share, 0.5, 0.03);
}

TEST(Inserter, IsTheSameOnAnyNumberOfThreadsAndSmoothWithMoreRays) {
  InsertionOptions options;
  options.shadows = true;
  options.threads = 1;
  const CityModel city = testing::MakeCity({kBehind});
  const Insertion one = Insert(city, options);
  options.threads = 4;
  EXPECT_EQ(cv::norm(one.picture, Insert(city, options).picture, cv::NORM_INF), 0.0);
  const auto partly = [&](int samples) {
    InsertionOptions o;
    o.samples = samples;
    const cv::Mat coverage = Insert(city, o).coverage;
    return cv::countNonZero((coverage > 0) & (coverage < 255));
  };
  EXPECT_EQ(partly(1), 0);
  EXPECT_GT(partly(4), 50);
}

// Sun from the north behind the box: its shadow falls towards the viewer, on flat ground.
TEST(Inserter, ItsShadowFallsOnTheTerrain) {
  const HeightGrid flat =
      testing::MakeTerrain({-200.0, -200.0}, 10.0, 41, 41, [](double, double) { return 0.0; });
  InsertionOptions options;
  options.towards_sun = Towards(0.0, 30.0);
  const CityModel city = testing::MakeCity({kBehind});
  const cv::Mat without = Insert(city, options, {}, &flat).picture;
  options.shadows = true;
  const cv::Mat with = Insert(city, options, {}, &flat).picture;
  // The upper edge of the front, 8 m high and 46 m off, throws it 8 / tan 30 = 13.9 m: to 32.1 m.
  const auto row_of = [](double north_m) {
    return static_cast<int>(120.0 + kFocalPx * 1.6 / north_m);
  };
  EXPECT_EQ(without.at<cv::Vec3b>(row_of(42.0), 160), kPhoto);
  EXPECT_LT(with.at<cv::Vec3b>(row_of(42.0), 160)[2], 0.9 * kPhoto[2]);
  EXPECT_EQ(with.at<cv::Vec3b>(row_of(29.0), 160), kPhoto);
  EXPECT_EQ(with.at<cv::Vec3b>(row_of(42.0), 20), kPhoto);  // beside it
  // No sun, no shadow.
  options.towards_sun = Towards(0.0, -5.0);
  EXPECT_EQ(Insert(city, options, {}, &flat).picture.at<cv::Vec3b>(row_of(42.0), 160), kPhoto);
}

TEST(Inserter, ANeighboursShadowFallsOnIt) {
  // A wide house west of the box, sun from the west: the box's front is lit at an angle only.
  InsertionOptions options;
  options.towards_sun = Towards(225.0, 20.0);
  const CityModel city = testing::MakeCity({{{-25.0, 30.0}, 8.0, 20.0, 0.0, 0.0, 25.0, 25.0}});
  const cv::Vec3b lit = Insert(city, options).picture.at<cv::Vec3b>(120, 150);
  options.shadows = true;
  const cv::Vec3b shaded = Insert(city, options).picture.at<cv::Vec3b>(120, 150);
  for (int c = 0; c < 3; ++c) EXPECT_LT(shaded[c], lit[c]);
}

TEST(InsertionOptions, BadValuesAreNamed) {
  InsertionOptions options;
  options.samples = 0;
  EXPECT_THROW(options.Validate(), InputError);
  options = {};
  options.reveal = 1.5;
  EXPECT_THROW(options.Validate(), InputError);
}

TEST(SkyImpact, CountsTheSkyThatTheBoxTakes) {
  const CityModel city_model = testing::MakeCity({kBehind});
  const Scene city(city_model, nullptr, ProjectionOptions{});
  const Insertion result = Insert(city_model);
  const SkyImpact impact = ImpactOf(city, Camera(), Viewer(), result.coverage);
  EXPECT_NEAR(impact.sky_before, 0.5, 0.01);
  // 6.4 m of the front stand above eye height.
  const double above_px = 6.4 * kFocalPx / 46.0;
  EXPECT_NEAR(impact.highest_rise_px, above_px, 1.5);
  EXPECT_NEAR(impact.raised_columns, 10.0 * kFocalPx / 46.0 / 320.0, 0.01);
  EXPECT_NEAR(impact.sky_lost, impact.raised_columns * above_px / 120.0, 0.02);
  EXPECT_EQ(impact.before[160], 120);
  EXPECT_NEAR(impact.after[160], 120 - above_px, 1.5);
  EXPECT_EQ(impact.after[10], impact.before[10]);
}

TEST(InsertionStability, ErrorAndJitterInPixels) {
  const TexturedMesh box = Box();
  std::vector<InsertedFrame> frames;
  for (int i = 0; i < 6; ++i) {
    // Headings off by +- 0.5 degrees in turn: the building jumps by a degree, 5.2 px.
    Pose pose = Viewer();
    pose.cam_from_world = CamFromWorld(ViewAngles{i % 2 == 0 ? 0.5 : -0.5, 0.0, 0.0});
    frames.push_back({Camera(), pose, Viewer()});
  }
  const InsertionStability s = StabilityOf(frames, box);
  EXPECT_EQ(s.frames, 6);
  EXPECT_EQ(s.steps, 5);
  EXPECT_NEAR(s.mean_error_px, kFocalPx * 0.5 * M_PI / 180.0, 0.1);
  EXPECT_NEAR(s.jitter_px, kFocalPx * 1.0 * M_PI / 180.0, 0.2);
  frames[3].pose.reset();
  EXPECT_EQ(StabilityOf(frames, box).steps, 3);
  EXPECT_EQ(StabilityOf({}, box).frames, 0);
}

}  // namespace
}  // namespace ridgeline
