// SPDX-License-Identifier: Apache-2.0
#include "score/area_score.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <numbers>
#include <string>
#include <opencv2/imgcodecs.hpp>

#include "base/error.h"
#include "score/position_view.h"
#include "support/house_before_camera.h"

namespace ridgeline {
namespace {

using testing::kCamera;

constexpr int kOther = 7, kWall = 40, kRoof = 41;

class AreasOfAHouse : public ::testing::Test, protected testing::HouseBeforeCamera {
 protected:
  ~AreasOfAHouse() override { std::filesystem::remove(file_); }

  // What a perfect segmentation says of the house.
  cv::Mat Classes() const {
    const ViewBuffers view = scene_.Render(kCamera, North());
    cv::Mat classes(kCamera.height, kCamera.width, CV_8U, cv::Scalar(kOther));
    for (int y = 0; y < classes.rows; ++y) {
      for (int x = 0; x < classes.cols; ++x) {
        const std::uint32_t surface = view.surfaces[static_cast<std::size_t>(y) * classes.cols + x];
        if (surface == kNoSurface) continue;
        classes.at<std::uint8_t>(y, x) =
            model_.surfaces[surface].normal.z() > 0.25f ? kRoof : kWall;
      }
    }
    return classes;
  }

  double EnergyAt(double heading_deg, const AreaOptions& options) const {
    const PictureEvidence evidence(Photo(), kCamera, {}, EvidenceOptions{}, 1);
    const AreaScore score(evidence, model_, options);
    const Pose pose = North(heading_deg);
    const PositionView view = ViewFrom(scene_,
                                       pose.center_in_world,
                                       RangeOf(kCamera,
                                               {heading_deg, 5.0, 0.0},
                                               {},
                                               0.3 * std::numbers::pi / 180.0),
                                       score.parts());
    return Score::EnergyOf(score.LogRatio(view, pose, *score.NewWorkspace()));
  }

  AreaOptions FromFile(const cv::Mat& classes, const std::string& parts) const {
    cv::imwrite(file_.string(), classes);
    AreaOptions options;
    options.source = "file";
    options.file = file_.string();
    options.parts = parts;
    options.building = {};
    options.roof = {kRoof};
    options.wall = {kWall};
    return options;
  }

  std::string Refusal(const cv::Mat& classes) const {
    cv::imwrite(file_.string(), classes);
    try {
      ReadClasses(file_, kCamera);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }

  const std::filesystem::path file_ = std::filesystem::temp_directory_path() /
                                      ("ridgeline_classes_" + std::to_string(::getpid()) + ".png");
};

TEST_F(AreasOfAHouse, OfAPerfectSegmentationIsLeastAtTheTruth) {
  for (const char* parts : {"building", "roof_wall"}) {
    const AreaOptions options = FromFile(Classes(), parts);
    const double truth = EnergyAt(0.0, options);
    // Cells of 3 px: those of the outline are mixed, and of the roof, seen flatly, half of all.
    EXPECT_LT(truth, std::string(parts) == "building" ? 0.12 : 0.45) << parts;
    for (const double heading : {-6.0, -3.0, 3.0, 6.0}) {
      EXPECT_GT(EnergyAt(heading, options), truth + 0.05) << parts << " at " << heading;
    }
  }
}

TEST_F(AreasOfAHouse, RoofsAndWallsApartSeeWhatTheOutlineDoesNot) {
  // A segmentation that takes roofs for walls and walls for roofs.
  cv::Mat swapped = Classes();
  swapped.forEach<std::uint8_t>([](std::uint8_t& c, const int*) {
    c = c == kRoof ? kWall : c == kWall ? kRoof : c;
  });
  EXPECT_LT(EnergyAt(0.0, FromFile(swapped, "building")), 0.12);
  EXPECT_GT(EnergyAt(0.0, FromFile(swapped, "roof_wall")), 0.9);
}

TEST_F(AreasOfAHouse, WhatIsUnknownDoesNotCount) {
  cv::Mat half = Classes();
  half.colRange(0, half.cols / 2).setTo(9);
  AreaOptions options = FromFile(half, "building");
  const double as_other = EnergyAt(0.0, options);
  options.unknown = {9};
  EXPECT_LT(EnergyAt(0.0, options), 0.15);
  EXPECT_GT(as_other, 0.3);
}

TEST_F(AreasOfAHouse, ByColoursIsLeastAtTheTruth) {
  const double truth = EnergyAt(0.0, AreaOptions{});
  for (const double heading : {-8.0, 8.0}) EXPECT_GT(EnergyAt(heading, AreaOptions{}), truth);
}

TEST_F(AreasOfAHouse, BadFilesAreNamed) {
  EXPECT_NE(Refusal(cv::Mat(100, 300, CV_8U, cv::Scalar(1))).find("300 x 100 px"),
            std::string::npos);
  EXPECT_NE(Refusal(cv::Mat(240, 320, CV_16U, cv::Scalar(1))).find("8 bits"), std::string::npos);
  EXPECT_NE(Refusal(cv::Mat(240, 320, CV_8UC3, cv::Scalar(1, 2, 3))).find("colours"),
            std::string::npos);
  EXPECT_EQ(Refusal(cv::Mat(480, 640, CV_8U, cv::Scalar(1))), "");
  EXPECT_THROW(ReadClasses("none.png", kCamera), InputError);
}

TEST(AreaOptions, BadValuesAreNamed) {
  const auto refusal = [](const auto& change) -> std::string {
    AreaOptions options;
    change(options);
    try {
      CheckOptions(options, "score.areas");
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(refusal([](AreaOptions& o) { o.parts = "roof_wall"; }).find("facade_colours"),
            std::string::npos);
  EXPECT_NE(refusal([](AreaOptions& o) { o.source = "file"; }).find("score.areas.file"),
            std::string::npos);
  EXPECT_NE(refusal([](AreaOptions& o) { o.sky = {255.0}; }).find("twice"), std::string::npos);
  EXPECT_EQ(refusal([](AreaOptions&) {}), "");
}

}  // namespace
}  // namespace ridgeline
