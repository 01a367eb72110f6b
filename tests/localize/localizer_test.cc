// SPDX-License-Identifier: Apache-2.0
#include "localize/localizer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "city/raise_roofs.h"
#include "eval/metrics.h"
#include "eval/pose_json.h"
#include "optim/sampler_table.h"
#include "score/score_table.h"
#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

// A street of houses of different heights, seen along the street.
CityModel Street() {
  std::vector<testing::House> houses;
  const double eaves[] = {6.0, 9.0, 5.0, 8.0, 11.0, 7.0, 6.5, 10.0};
  for (int i = 0; i < 8; ++i) {
    testing::House house;
    const bool is_left = i % 2 == 0;
    house.center = {is_left ? -11.0 : 12.0, 8.0 + 9.0 * i};
    house.length_m = 9.0 + i % 3;
    house.width_m = 8.0;
    house.heading_deg = 0.0;
    house.eaves_m = eaves[i];
    house.ridge_m = eaves[i] + (i % 3 == 0 ? 0.0 : 3.0);
    houses.push_back(house);
  }
  CityModel model = testing::MakeCity(houses);
  model.crs.horizontal_epsg = 25832;
  model.origin_in_world = {690000.0, 5335000.0, 500.0};
  return model;
}

const PinholeCamera kCamera{640, 480, 500.0, 500.0, 320.0, 240.0};

// The model in flat shades: sky white, ground dark, each face by its direction.
cv::Mat Photo(const Scene& scene, const Pose& cam_from_local) {
  const ViewBuffers buffers = scene.Render(kCamera, cam_from_local);
  cv::Mat picture(kCamera.height, kCamera.width, CV_8UC3, cv::Scalar(245, 240, 235));
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const std::uint32_t surface =
          buffers.surfaces[static_cast<std::size_t>(y) * picture.cols + x];
      cv::Vec3b& pixel = picture.at<cv::Vec3b>(y, x);
      if (surface == kNoSurface) {
        const Eigen::Vector3d ray =
            cam_from_local.cam_from_world.conjugate() * kCamera.RayFromImage({x + 0.5, y + 0.5});
        if (ray.z() < 0.0) pixel = {70, 70, 70};
        continue;
      }
      const Surface& s = scene.model().surfaces[surface];
      const double shade =
          110.0 + 50.0 * s.normal.x() + 25.0 * s.normal.y() + 6.0 * (s.building % 5);
      pixel = s.surface_class == SurfaceClass::kRoof
                  ? cv::Vec3b(60, 80, static_cast<unsigned char>(shade + 30))
                  : cv::Vec3b(static_cast<unsigned char>(shade - 20),
                              static_cast<unsigned char>(shade),
                              static_cast<unsigned char>(shade));
    }
  }
  return picture;
}

class LocalizerOnAStreet : public ::testing::Test {
 protected:
  LocalizerOnAStreet() : model_(Street()), localizer_(model_, std::nullopt, Options()) {
    truth_.cam_from_world = CamFromWorld(ViewAngles{4.0, 3.0, 0.0});
    truth_.center_in_world = {0.5, -6.0, 1.7};
    input_.picture = Photo(localizer_.scene(), truth_);
    input_.camera = {"PINHOLE", 640, 480, {500.0, 500.0, 320.0, 240.0}};
    truth_.center_in_world += model_.origin_in_world;
    input_.prior.position_in_world = truth_.center_in_world.head<2>() + Eigen::Vector2d(3.3, -2.6);
    input_.prior.height_in_world = truth_.center_in_world.z();
    input_.prior.heading_deg = 350.0;
    input_.prior.pitch_deg = 3.0;
    input_.prior.roll_deg = 0.0;
  }

  static LocalizerOptions Options() {
    LocalizerOptions options;
    options.search.space.east_m = 5.0;
    options.search.space.north_m = 5.0;
    return options;
  }

  std::string ErrorOfInput(const LocalizationInput& input) const {
    try {
      localizer_.Localize(input, 1, 1);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  }

  CityModel model_;
  Localizer localizer_;
  Pose truth_;
  LocalizationInput input_;
};

TEST_F(LocalizerOnAStreet, FindsThePose) {
  const Localization found = localizer_.Localize(input_, 1, 0);
  ASSERT_EQ(found.status, LocalizationStatus::kOk) << found.reason;
  const PoseError error = ErrorOf(*found.pose, truth_);
  EXPECT_LT(error.translation_m, 0.5);
  EXPECT_LT(error.rotation_deg, 0.5);
  EXPECT_GT(found.confidence, 0.5);
  // Higher than anything far away.
  for (std::size_t i = 1; i < found.modes.size(); ++i) {
    EXPECT_GE(found.modes[i].energy, found.energy);
  }
  // No peak twice.
  for (std::size_t i = 1; i < found.modes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const PoseError apart = ErrorOf(found.modes[i].pose, found.modes[k].pose);
      EXPECT_TRUE(apart.translation_m > 0.3 || apart.rotation_deg > 0.2) << i << " and " << k;
    }
  }
}

TEST_F(LocalizerOnAStreet, PriorsWithWrongTiltsAreNoObstacle) {
  *input_.prior.pitch_deg -= 3.5;
  *input_.prior.roll_deg += 5.0;
  const Localization found = localizer_.Localize(input_, 1, 0);
  ASSERT_EQ(found.status, LocalizationStatus::kOk) << found.reason;
  const PoseError error = ErrorOf(*found.pose, truth_);
  EXPECT_LT(error.translation_m, 1.0);
  EXPECT_LT(error.rotation_deg, 1.0);
}

TEST_F(LocalizerOnAStreet, TiltsFarFromThePriorsAreLessLikely) {
  const Footprints footprints(model_);
  const PoseSpace space(
      input_.prior, Options().search.space, localizer_.scene(), nullptr, footprints);
  PoseSpace::Offset offset;
  EXPECT_EQ(space.LogPrior(offset), 0.0);
  offset.east_m = 4.0;
  offset.heading_deg = 10.0;
  EXPECT_EQ(space.LogPrior(offset), 0.0) << "uniform in place and heading";
  offset.pitch_deg = 4.8;
  offset.roll_deg = -6.4;  // one scale away: a bivariate Cauchy density is 2^-1.5 of its peak
  EXPECT_NEAR(space.LogPrior(offset), -1.5 * std::log(2.0), 1e-12);
}

TEST_F(LocalizerOnAStreet, UnusualHeightsOfACameraInTheHandAreLessLikely) {
  const Footprints footprints(model_);
  HeightGrid ground{{-50.0, -50.0}, 50.0, 4, 4, std::vector<float>(16, 0.0f)};
  PosePrior prior = input_.prior;
  const PoseSpace known(prior, Options().search.space, localizer_.scene(), &ground, footprints);
  prior.height_in_world.reset();
  const PoseSpace open(prior, Options().search.space, localizer_.scene(), &ground, footprints);
  PoseSpace::Offset offset;
  EXPECT_EQ(open.LogPrior(offset), 0.0);
  offset.height_m = 1.0;  // two standard deviations of a Student t with four degrees of freedom
  EXPECT_NEAR(open.LogPrior(offset), -2.5 * std::log(2.0), 1e-12);
  offset.height_m = -1.0;
  EXPECT_NEAR(open.LogPrior(offset), -2.5 * std::log(2.0), 1e-12);
  EXPECT_EQ(known.LogPrior(offset), 0.0) << "a height that was given is not a guess";
}

TEST_F(LocalizerOnAStreet, IsTheSameOnAnyNumberOfThreads) {
  const std::string one = PoseJson("photo", localizer_.Localize(input_, 1, 1), model_, {});
  EXPECT_EQ(PoseJson("photo", localizer_.Localize(input_, 1, 8), model_, {}), one);
}

TEST_F(LocalizerOnAStreet, MovesWithTheWorld) {
  CityModel far = Street();
  const Eigen::Vector3d shift(-400000.0, 5000000.0, 1000.0);
  far.origin_in_world += shift;
  const Localizer localizer(far, std::nullopt, Options());
  LocalizationInput input = input_;
  input.prior.position_in_world += shift.head<2>();
  *input.prior.height_in_world += shift.z();
  const Localization here = localizer_.Localize(input_, 1, 0);
  const Localization there = localizer.Localize(input, 1, 0);
  ASSERT_TRUE(here.pose && there.pose);
  EXPECT_LT((there.pose->center_in_world - here.pose->center_in_world - shift).norm(), 1e-6);
}

TEST_F(LocalizerOnAStreet, APictureWithoutLinesIsAnAbstentionWithAReason) {
  input_.picture = cv::Mat::zeros(480, 640, CV_8UC3);
  const Localization found = localizer_.Localize(input_, 1, 0);
  EXPECT_EQ(found.status, LocalizationStatus::kTooFewLines);
  EXPECT_FALSE(found.pose.has_value());
  EXPECT_FALSE(found.reason.empty());
}

TEST_F(LocalizerOnAStreet, LookingAwayFromTheModelIsAnAbstention) {
  input_.prior.heading_deg = 180.0;
  input_.prior.position_in_world.y() -= 60.0;
  LocalizerOptions options = Options();
  options.search.widenings = 0;
  const Localizer localizer(model_, std::nullopt, options);
  const Localization found = localizer.Localize(input_, 1, 0);
  EXPECT_EQ(found.status, LocalizationStatus::kNoVisibleModel);
  EXPECT_FALSE(found.pose.has_value());
}

TEST_F(LocalizerOnAStreet, ABoxWithoutTheTruthIsMadeLarger) {
  LocalizerOptions options = Options();
  options.search.space.east_m = options.search.space.north_m = 3.0;
  input_.prior.position_in_world.y() -= 12.0;
  options.search.widenings = 0;
  const Localization inside =
      Localizer(model_, std::nullopt, options).Localize(input_, 1, 0);
  EXPECT_TRUE(!inside.pose || inside.status == LocalizationStatus::kDoubtful);
  options.search.widenings = 1;
  const Localization found = Localizer(model_, std::nullopt, options).Localize(input_, 1, 0);
  ASSERT_FALSE(found.modes.empty());
  EXPECT_LT(ErrorOf(found.modes.front().pose, truth_).translation_m, 2.0);
  EXPECT_THAT(found.notes, ::testing::ElementsAre(::testing::StartsWith("searched further: ")));
}

TEST_F(LocalizerOnAStreet, ARoofAtAnotherHeightThanTheModelsIsMovedAndNamed) {
  // Found to the steps of the trial, 0.375 m.
  const char* const lifted = "its roof is taken \\+1\\.[1-9] m .*";
  const char* const lowered = "its roof is taken -1\\.[1-9] m .*";
  for (const std::uint32_t house : {1u, 4u}) {
    for (const double up : {-1.5, 1.5}) {
      const CityModel wrong = WithShiftedRoofs(model_, std::vector<RoofShift>{{house, up}});
      const Localization found = Localizer(wrong, std::nullopt, Options()).Localize(input_, 1, 0);
      ASSERT_TRUE(found.pose.has_value()) << found.reason;
      EXPECT_LT(ErrorOf(*found.pose, truth_).translation_m, 0.5);
      EXPECT_THAT(found.doubts,
                  ::testing::Contains(::testing::MatchesRegex(
                      ".*" + model_.buildings[house].id + ": " + (up < 0.0 ? lifted : lowered))))
          << up;
    }
  }
  const Localization right = localizer_.Localize(input_, 1, 0);
  EXPECT_THAT(right.doubts, ::testing::Not(::testing::Contains(::testing::HasSubstr("roof"))));
}

TEST_F(LocalizerOnAStreet, AFocalLengthInDoubtIsFoundWithThePose) {
  input_.camera.params[0] = input_.camera.params[1] = 640.0;
  input_.focal_lengths = {{640.0, 2.0, "with the zoom"}, {500.0, 2.0, "without"}};
  const Localization found = localizer_.Localize(input_, 1, 0);
  ASSERT_TRUE(found.pose.has_value()) << found.reason;
  EXPECT_NEAR(*found.focal_px, 500.0, 11.0);
  EXPECT_LT(ErrorOf(*found.pose, truth_).translation_m, 0.5);
}

TEST_F(LocalizerOnAStreet, GreyDeepAndTransparentPicturesAreRead) {
  cv::Mat deep;
  input_.picture.convertTo(deep, CV_16U, 257.0);
  input_.picture = deep;
  EXPECT_TRUE(localizer_.Localize(input_, 1, 0).pose.has_value());
}

TEST_F(LocalizerOnAStreet, BadInputIsNamed) {
  LocalizationInput input = input_;
  input.camera.width = 641;
  EXPECT_THAT(ErrorOfInput(input),
              ::testing::StartsWith("image: got 640 x 480, expected the camera's"));
  input = input_;
  input.prior.position_in_world.x() += 5000.0;
  EXPECT_THAT(ErrorOfInput(input), ::testing::HasSubstr("expected a place in the model, between"));
  input = input_;
  input.prior.position_in_world.x() = NAN;
  EXPECT_THAT(ErrorOfInput(input), ::testing::HasSubstr("not finite"));
  input = input_;
  input.prior.height_in_world.reset();
  EXPECT_THAT(ErrorOfInput(input), ::testing::HasSubstr("no height and no DTM"));
}

TEST_F(LocalizerOnAStreet, EverySamplerAndScoreRuns) {
  // Each score by TPE, and each sampler (gp: Gaussian process with expected improvement) on a score.
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const std::string& score : ScoreNames()) pairs.emplace_back(score, "tpe");
  for (const std::string& sampler : SamplerNames()) pairs.emplace_back("gradient", sampler);
  for (const auto& [score, sampler] : pairs) {
    LocalizerOptions options = Options();
    options.score.name = score;
    options.search.method = "sampler";
    options.search.sampler.name = sampler;
    options.search.evaluations = 20;
    options.search.refine = false;
    options.search.widenings = 0;
    options.confidence.abstain_below = 0.0;
    const Localizer localizer(model_, std::nullopt, options);
    const Localization found = localizer.Localize(input_, 1, 0);
    EXPECT_TRUE(found.pose.has_value()) << score << " by " << sampler << ": " << found.reason;
    EXPECT_EQ(found.evaluations, 20u) << score << " by " << sampler;
    EXPECT_GE(found.energy, 0.0);
    EXPECT_LE(found.energy, 1.0);
  }
}

}  // namespace
}  // namespace ridgeline
