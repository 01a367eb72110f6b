// SPDX-License-Identifier: Apache-2.0
#include "score/area_classes.h"

#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "skyline/sky_likelihood.h"

namespace ridgeline {
namespace {

std::uint8_t Value(AreaClass c) { return static_cast<std::uint8_t>(c); }

std::string SizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
}

// One channel of a picture whose channels are equal.
cv::Mat OneChannel(const cv::Mat& picture, const std::string& file) {
  if (picture.channels() == 1) return picture;
  std::vector<cv::Mat> channels;
  cv::split(picture, channels);
  for (std::size_t c = 1; c < 3; ++c) {
    if (cv::countNonZero(channels[c] != channels[0]) == 0) continue;
    throw InputError(file,
                     "",
                     "a picture in colours",
                     "class values in one channel (8-bit grey), not the colours they are shown in");
  }
  return channels.front();
}

}  // namespace

void AreaOptions::Visit(OptionVisitor& v) {
  v.Field("source", source);
  v.Field("parts", parts);
  v.Field("file", file);
  v.Field("building", building);
  v.Field("roof", roof);
  v.Field("wall", wall);
  v.Field("sky", sky);
  v.Field("ground", ground);
  v.Field("unknown", unknown);
  v.Field("columns", columns);
}

void AreaOptions::Validate() const {
  const auto refuse = [](const char* name, const std::string& found, const char* expected) {
    throw InputError("", std::string("score.areas.") + name, found, expected);
  };
  if (source != "colours" && source != "file") refuse("source", source, "colours or file");
  if (parts != "building" && parts != "roof_wall") refuse("parts", parts, "building or roof_wall");
  if (parts == "roof_wall" && source != "file") {
    refuse("parts",
           "roof_wall with source=" + source,
           "source=file (by colours, roofs and walls are told apart by the cue facade_colours)");
  }
  if (parts == "roof_wall" && (roof.empty() || wall.empty())) {
    refuse(roof.empty() ? "roof" : "wall", "no value", "the class image's values of roofs and walls");
  }
  if (source == "file" && file.empty()) refuse("file", "nothing", "a class image (PNG)");
  if (columns < 16 || columns > 1000) refuse("columns", std::to_string(columns), "[16, 1000]");
  std::array<bool, 256> used{};
  for (const auto* list : {&building, &roof, &wall, &sky, &ground, &unknown}) {
    for (const double value : *list) {
      if (!(value >= 0.0 && value <= 255.0 && value == std::floor(value))) {
        refuse("building", std::to_string(value), "whole numbers from 0 to 255 in all lists");
      }
      bool& is_used = used[static_cast<std::size_t>(value)];
      if (is_used) refuse("building", std::to_string(value) + " twice", "each value once");
      is_used = true;
    }
  }
}

cv::Mat ReadClasses(const std::filesystem::path& path, const PinholeCamera& camera) {
  const cv::Mat read = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  if (read.empty()) {
    throw InputError(path.string(), "", "nothing that can be read", "a class image or mask (PNG)");
  }
  if (read.depth() != CV_8U) {
    throw InputError(path.string(), "", "more than 8 bits", "class values from 0 to 255");
  }
  cv::Mat classes = OneChannel(read, path.string());
  const double shape = static_cast<double>(classes.cols) / classes.rows;
  const double expected = static_cast<double>(camera.width) / camera.height;
  if (std::abs(shape / expected - 1.0) > 0.01) {
    throw InputError(path.string(),
                     "",
                     SizeText(classes.cols, classes.rows),
                     "the shape of the picture, " + SizeText(camera.width, camera.height));
  }
  return classes;
}

cv::Mat AreasOfFile(const cv::Mat& classes, const AreaOptions& options, const cv::Size& cells) {
  cv::Mat table(1, 256, CV_8U, cv::Scalar(Value(AreaClass::kOther)));
  const auto put = [&](const std::vector<double>& values, AreaClass c) {
    for (const double value : values) table.at<std::uint8_t>(static_cast<int>(value)) = Value(c);
  };
  put(options.building, AreaClass::kBuilding);
  put(options.roof, AreaClass::kRoof);
  put(options.wall, AreaClass::kWall);
  put(options.sky, AreaClass::kSky);
  put(options.ground, AreaClass::kGround);
  put(options.unknown, AreaClass::kUnknown);
  cv::Mat reduced, areas;
  cv::resize(classes, reduced, cells, 0.0, 0.0, cv::INTER_NEAREST);
  cv::LUT(reduced, table, areas);
  return areas;
}

cv::Mat AreasOfColours(const cv::Mat& bgr, const cv::Mat& foliage, const cv::Size& cells) {
  cv::Mat odds, leaves;
  cv::resize(SkyLogOdds(bgr, SkyLikelihoodOptions{}), odds, cells, 0.0, 0.0, cv::INTER_AREA);
  cv::resize(foliage, leaves, cells, 0.0, 0.0, cv::INTER_NEAREST);
  cv::Mat areas(cells, CV_8U, cv::Scalar(Value(AreaClass::kBuilding)));
  areas.setTo(Value(AreaClass::kSky), odds > 0.0f);
  areas.setTo(Value(AreaClass::kUnknown), leaves != 0);
  return areas;
}

}  // namespace ridgeline
