// SPDX-License-Identifier: Apache-2.0
#include "lines/segments_file.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "base/error.h"
#include "base/limits.h"
#include "base/text_file.h"

namespace ridgeline {
namespace {

Eigen::Vector2f UndistortedPoint(const CameraIntrinsics& camera, double x, double y) {
  const Eigen::Vector2d ray = camera.Undistort({x, y});
  return camera.Pinhole().ImageFromCamera({ray.x(), ray.y(), 1.0}).cast<float>();
}

}  // namespace

std::vector<LineSegment> ReadSegments(const std::filesystem::path& path,
                                      const CameraIntrinsics& camera) {
  std::istringstream text(ReadText(path));
  std::vector<LineSegment> segments;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    line.resize(std::min(line.size(), line.find('#')));
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::istringstream fields(line);
    double x0 = 0.0;
    double y0 = 0.0;
    double x1 = 0.0;
    double y1 = 0.0;
    double score = 1.0;
    const bool has_ends = static_cast<bool>(fields >> x0 >> y0 >> x1 >> y1);
    if (has_ends) fields >> score;
    constexpr double kFarthestPx = 1e6;
    const bool near =
        std::max({std::abs(x0), std::abs(y0), std::abs(x1), std::abs(y1)}) <= kFarthestPx;
    if (!has_ends || !near || !(score > 0.0) || !std::isfinite(score)) {
      throw InputError(path.string(),
                       "line " + std::to_string(number),
                       "\"" + line + "\"",
                       "x0 y0 x1 y1 [score > 0]");
    }
    LineSegment segment;
    segment.a = UndistortedPoint(camera, x0, y0);
    segment.b = UndistortedPoint(camera, x1, y1);
    segment.strength = static_cast<float>(score);
    if (segment.Length() > 0.0f) segments.push_back(segment);
    if (segments.size() > limits::kSegments) {
      const std::string most = std::to_string(limits::kSegments);
      throw InputError(
          path.string(), "limit", "more than " + most + " segments", "at most " + most);
    }
  }
  return segments;
}

}  // namespace ridgeline
