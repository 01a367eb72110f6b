// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "base/options.h"
#include "camera/intrinsics.h"

namespace ridgeline {

inline constexpr char kAreaScoreName[] = "areas";

// What a pixel of a picture, or a direction of the model, shows.
enum class AreaClass : std::uint8_t { kUnknown, kSky, kGround, kWall, kRoof, kBuilding, kOther };

struct AreaOptions {
  // "colours": sky and not-sky by the picture's own colours, leaves left out; "file": an image of
  // classes or a mask by any segmentation.
  std::string source = "colours";
  // "building": the outlines of buildings as a whole; "roof_wall": roofs and walls apart, which
  // colours alone cannot tell ("file" only).
  std::string parts = "building";
  // Of "file": the class image of the one picture that is looked at.
  std::string file;
  // Values of the class image. What is in none of the lists is something else (cars, trees).
  std::vector<double> building = {255.0};  // roof or wall, not told apart
  std::vector<double> roof;
  std::vector<double> wall;
  std::vector<double> sky;
  std::vector<double> ground;
  std::vector<double> unknown;  // not compared
  // Columns of the grid on which picture and model are compared.
  int columns = 96;

  void Visit(OptionVisitor& v);
};

// Class image or mask (8 bit, one channel; of colour pictures with equal channels one is taken) of a
// picture without distortion. A size other than the camera's is allowed if its shape is the same.
// Throws InputError for a file that is missing or something else.
cv::Mat ReadClasses(const std::filesystem::path& path, const PinholeCamera& camera);

// Classes of the cells of a grid of `columns` over the picture, row by row: by the values of a class
// image; CV_8U in and out.
cv::Mat AreasOfFile(const cv::Mat& classes, const AreaOptions& options, const cv::Size& cells);

// By colours: kSky, kUnknown behind leaves, else kBuilding (which here means: not sky).
cv::Mat AreasOfColours(const cv::Mat& bgr, const cv::Mat& foliage, const cv::Size& cells);

}  // namespace ridgeline
