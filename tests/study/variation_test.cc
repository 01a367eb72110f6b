// SPDX-License-Identifier: Apache-2.0
#include "study/variation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <opencv2/core.hpp>
#include <set>

#include "base/error.h"
#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

CityModel Terrace() {
  std::vector<testing::House> houses;
  for (int i = 0; i < 40; ++i) {
    testing::House house;
    house.center = {12.0 * (i % 8), 30.0 * (i / 8)};
    house.length_m = 12.0;
    house.width_m = 12.0;
    house.eaves_m = 6.0;
    house.ridge_m = 9.0;
    houses.push_back(house);
  }
  return testing::MakeCity(houses);
}

// Vertices of each building, by their old place.
std::map<std::uint32_t, std::vector<Eigen::Vector3d>> Corners(const CityModel& model) {
  std::map<std::uint32_t, std::vector<Eigen::Vector3d>> corners;
  for (const Triangle& triangle : model.triangles) {
    for (const std::uint32_t v : triangle.vertices) {
      corners[model.surfaces[triangle.surface].building].push_back(model.vertices[v]);
    }
  }
  return corners;
}

std::string ErrorOfParsing(const std::string& text) {
  try {
    ParseVariation(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(Variation, HeightErrorsLiftARoofAndLeaveTheFeet) {
  const CityModel model = Terrace();
  const Variation heights = ParseVariation("heights");
  const auto before = Corners(model);
  const auto after = Corners(VariedModel(model, heights, "0.5", 3));
  const auto twice = Corners(VariedModel(model, heights, "1", 3));
  double sum = 0.0;
  double squares = 0.0;
  for (const auto& [building, corners] : before) {
    double lift = NAN;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector3d moved = after.at(building)[i] - corners[i];
      EXPECT_EQ(moved.head<2>().norm(), 0.0);
      if (corners[i].z() < 0.1) {
        EXPECT_NEAR(moved.z(), 0.0, 1e-9);
        continue;
      }
      if (std::isnan(lift)) lift = moved.z();
      EXPECT_NEAR(moved.z(), lift, 1e-9);  // the roof moves as one
      EXPECT_NEAR(twice.at(building)[i].z() - corners[i].z(), 2.0 * lift, 1e-9);
    }
    sum += lift;
    squares += lift * lift;
  }
  // Of 40 normal draws: mean and deviation within about three standard errors.
  EXPECT_NEAR(sum / 40.0, 0.0, 0.24);
  EXPECT_NEAR(std::sqrt(squares / 40.0), 0.5, 0.18);
}

TEST(Variation, FeatureEdgesStayOnTheirBuildings) {
  const CityModel model = Terrace();
  for (const char* name : {"heights", "footprints"}) {
    const CityModel moved = VariedModel(model, ParseVariation(name), "0.7", 5);
    const auto corners = Corners(moved);
    ASSERT_EQ(moved.feature_edges.size(), model.feature_edges.size());
    for (const FeatureEdge& edge : moved.feature_edges) {
      const auto& own = corners.at(moved.surfaces[edge.surface0].building);
      double nearest = INFINITY;
      for (const Eigen::Vector3d& p : own) nearest = std::min(nearest, (p - edge.a).norm());
      EXPECT_LT(nearest, 1e-9) << name;
    }
  }
}

TEST(Variation, AShiftMovesABuildingAsOne) {
  const CityModel model = Terrace();
  const auto before = Corners(model);
  const auto after = Corners(VariedModel(model, ParseVariation("footprints"), "1", 9));
  std::set<double> shifts;
  for (const auto& [building, corners] : before) {
    const Eigen::Vector3d shift = after.at(building)[0] - corners[0];
    EXPECT_EQ(shift.z(), 0.0);
    shifts.insert(shift.x());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      EXPECT_LT((after.at(building)[i] - corners[i] - shift).norm(), 1e-9);
    }
  }
  EXPECT_EQ(shifts.size(), before.size());
}

TEST(Variation, EdgesAreDrawnAndNested) {
  const CityModel model = Terrace();
  const Variation edges = ParseVariation("edges");
  const auto half = VariedModel(model, edges, "50", 1).feature_edges;
  const auto tenth = VariedModel(model, edges, "10", 1).feature_edges;
  const double all = static_cast<double>(model.feature_edges.size());
  EXPECT_NEAR(static_cast<double>(half.size()) / all, 0.5, 0.12);
  EXPECT_NEAR(static_cast<double>(tenth.size()) / all, 0.1, 0.08);
  for (const FeatureEdge& edge : tenth) {
    EXPECT_TRUE(std::any_of(half.begin(), half.end(), [&](const FeatureEdge& other) {
      return other.a == edge.a && other.b == edge.b;
    }));
  }
  EXPECT_EQ(VariedModel(model, edges, "100", 1).feature_edges.size(), model.feature_edges.size());
}

TEST(Variation, ClutterCoversItsShare) {
  const cv::Mat picture(300, 400, CV_8UC3, cv::Scalar(1, 2, 3));
  const Variation clutter = ParseVariation("clutter");
  const cv::Mat covered = VariedPicture(picture, clutter, "20", 1, "a");
  int changed = 0;
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 400; ++x) changed += covered.at<cv::Vec3b>(y, x) != cv::Vec3b(1, 2, 3);
  }
  const double share = changed / 120000.0;
  EXPECT_GE(share, 0.199);  // the last rectangle reaches beyond, a random colour may be the same
  EXPECT_LE(share, 0.24);
  EXPECT_EQ(cv::norm(covered, VariedPicture(picture, clutter, "20", 1, "a")), 0.0);
  EXPECT_GT(cv::norm(covered, VariedPicture(picture, clutter, "20", 1, "b")), 0.0);
  EXPECT_EQ(cv::norm(picture, VariedPicture(picture, clutter, "0", 1, "a")), 0.0);
}

TEST(Variation, FocalLengthsOfEachCameraModel) {
  const Variation focal = ParseVariation("focal=10");
  const CameraIntrinsics pinhole{"PINHOLE", 100, 80, {50.0, 60.0, 50.0, 40.0}};
  const CameraIntrinsics radial{"RADIAL", 100, 80, {50.0, 50.0, 40.0, 0.1, 0.2}};
  const auto wide = VariedCamera(pinhole, focal, "10").params;
  EXPECT_NEAR(wide[0], 55.0, 1e-9);
  EXPECT_NEAR(wide[1], 66.0, 1e-9);
  EXPECT_EQ(wide[2], 50.0);
  const auto one = VariedCamera(radial, focal, "-10").params;
  EXPECT_NEAR(one[0], 45.0, 1e-9);
  EXPECT_EQ(one[1], 50.0);
}

TEST(Variation, OptionsOfSizeAndDetector) {
  const LocalizerOptions options;
  EXPECT_EQ(VariedOptions(options, ParseVariation("size"), "480").score.evidence.work_size_px, 480);
  EXPECT_EQ(VariedOptions(options, ParseVariation("detector"), "fld").lines.detector, "fld");
}

TEST(Variation, BadNamesAndLevelsAreNamed) {
  EXPECT_THAT(ErrorOfParsing("hights"), AllOf(HasSubstr("--vary"), HasSubstr("heights")));
  EXPECT_THAT(ErrorOfParsing("focal=2,wide"), AllOf(HasSubstr("focal"), HasSubstr("\"wide\"")));
  EXPECT_THAT(ErrorOfParsing("edges=120"), HasSubstr("[0, 100]"));
  EXPECT_THAT(ErrorOfParsing("detector=canny"), HasSubstr("a detector, e.g. \""));
  EXPECT_THAT(ErrorOfParsing("heights="), HasSubstr("no levels"));
  EXPECT_EQ(ParseVariation("heights=0,2").levels, (std::vector<std::string>{"0", "2"}));
}

}  // namespace
}  // namespace ridgeline
