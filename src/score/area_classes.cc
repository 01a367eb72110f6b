// SPDX-License-Identifier: Apache-2.0
#include "score/area_classes.h"

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "base/error.h"
#include "camera/decode_file.h"
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

// The first value that is not whole or there twice; empty: none.
std::string BadValue(const std::vector<std::vector<double>>& lists) {
  std::set<double> used;
  for (const std::vector<double>& list : lists) {
    for (const double value : list) {
      if (value != std::floor(value)) return std::to_string(value);
      if (!used.insert(value).second) return std::to_string(static_cast<int>(value)) + " twice";
    }
  }
  return "";
}

}  // namespace

void AreaOptions::Visit(OptionVisitor& v) {
  constexpr NumberRange kByte = Closed(0.0, 255.0);
  const bool of_file = source == "file";
  const bool of_parts = parts == "roof_wall";
  constexpr char kValuesOfParts[] = "the class image's values of roofs and walls";
  v.Field("source", source, OneOf{{"colours", "file"}});
  v.Field("parts", parts, OneOf{{"building", "roof_wall"}});
  v.Rule("parts",
         of_file || !of_parts,
         "roof_wall with source=" + source,
         "source=file (by colours, roofs and walls are told apart by the cue facade_colours)");
  v.Field("file", file);
  v.Rule("file", !of_file || !file.empty(), "nothing", "a class image (PNG)");
  v.Field("building", building, kByte);
  v.Field("roof", roof, kByte);
  v.Rule("roof", !of_parts || !roof.empty(), "no value", kValuesOfParts);
  v.Field("wall", wall, kByte);
  v.Rule("wall", !of_parts || !wall.empty(), "no value", kValuesOfParts);
  v.Field("sky", sky, kByte);
  v.Field("ground", ground, kByte);
  v.Field("unknown", unknown, kByte);
  const std::string bad = BadValue({building, roof, wall, sky, ground, unknown});
  v.Rule("building", bad.empty(), bad, "whole numbers, each once in all lists");
  v.Field("columns", columns, Closed(16, 1000));
}

cv::Mat ReadClasses(const std::filesystem::path& path, const PinholeCamera& camera) {
  const cv::Mat read = DecodeFile(path, cv::IMREAD_UNCHANGED, "a class image or mask");
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
