// SPDX-License-Identifier: Apache-2.0
#include "report/overlay.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/atomic_file.h"
#include "base/error.h"
#include "report/overlay_legend.h"
#include "report/overlay_scale.h"
#include "report/picture_file.h"

namespace ridgeline {
namespace {

constexpr int kShift = 4;  // fixed-point bits of OpenCV's coordinates

cv::Scalar Bgr(const Rgb& color) { return {double(color.b), double(color.g), double(color.r)}; }

// OpenCV draws pixel centres at whole numbers.
std::vector<cv::Point> FixedPoints(const std::vector<Eigen::Vector2f>& line) {
  std::vector<cv::Point> points;
  for (const Eigen::Vector2f& p : line) {
    const Eigen::Vector2f fixed = (p.array() - 0.5f) * static_cast<float>(1 << kShift);
    points.emplace_back(cvRound(fixed.x()), cvRound(fixed.y()));
  }
  return points;
}

void DrawLines(const OverlayLayer& layer, const cv::Scalar& color, double width, cv::Mat& picture) {
  for (const auto& line : layer.lines) {
    cv::polylines(picture,
                  FixedPoints(line),
                  false,
                  color,
                  std::max(1, static_cast<int>(std::lround(width))),
                  cv::LINE_AA,
                  kShift);
  }
}

void DrawLayer(const OverlayLayer& layer, double scale, cv::Mat& picture) {
  const double width = layer.width_px * scale;
  cv::Mat drawn = picture.clone();
  if (layer.casing) DrawLines(layer, {0, 0, 0}, width + 2.0 * std::max(1.0, 0.6 * scale), drawn);
  DrawLines(layer, Bgr(layer.color), width, drawn);
  cv::addWeighted(drawn, layer.opacity, picture, 1.0 - layer.opacity, 0.0, picture);
}

// A strip of names and line samples, to stand below the picture so that nothing of it is covered.
cv::Mat LegendStrip(const Overlay& overlay, double scale, int width) {
  const double font = 0.42 * scale;
  const int weight = std::max(1, static_cast<int>(std::lround(0.9 * scale)));
  const LegendLayout layout = LayLegend(overlay, scale, width, [&](const std::string& text) {
    int baseline = 0;
    return cv::getTextSize(text, cv::FONT_HERSHEY_DUPLEX, font, weight, &baseline).width;
  });
  cv::Mat strip(static_cast<int>(std::lround(layout.height)), width, CV_8UC3, cv::Scalar::all(32));
  for (const LegendPlace& place : layout.places) {
    const int y = static_cast<int>(std::lround(place.y));
    int x = static_cast<int>(std::lround(place.x));
    if (place.layer != nullptr) {
      const int end = x + static_cast<int>(std::lround(layout.sample));
      cv::line(strip,
               {x, y},
               {end, y},
               Bgr(place.layer->color),
               std::max(2, static_cast<int>(std::lround(place.layer->width_px * scale))),
               cv::LINE_AA);
      x = end + static_cast<int>(std::lround(5.4 * scale));
    }
    cv::putText(strip,
                place.text,
                {x, y + static_cast<int>(std::lround(5 * scale))},
                cv::FONT_HERSHEY_DUPLEX,
                font,
                {245, 245, 245},
                weight,
                cv::LINE_AA);
  }
  return strip;
}

}  // namespace

cv::Mat DrawOverlay(const cv::Mat& photo,
                    const Overlay& overlay,
                    const OverlayDrawOptions& options) {
  cv::Mat picture;
  if (photo.channels() == 1) {
    cv::cvtColor(photo, picture, cv::COLOR_GRAY2BGR);
  } else {
    picture = photo.clone();
  }
  picture.convertTo(picture, CV_8UC3, options.photo_brightness);
  const double scale = OverlayScale(picture.size());
  for (const OverlayLayer& layer : overlay.layers) DrawLayer(layer, scale, picture);
  if (!options.legend) return picture;
  const cv::Mat strip = LegendStrip(overlay, scale, picture.cols);
  if (!strip.empty()) cv::vconcat(picture, strip, picture);
  return picture;
}

void WriteOverlay(const cv::Mat& photo,
                  const Overlay& overlay,
                  const OverlayDrawOptions& options,
                  const std::filesystem::path& path) {
  if (path.extension() == ".svg") {
    WriteFileAtomically(path, OverlaySvg(photo, overlay, options));
    return;
  }
  WritePicture(DrawOverlay(photo, overlay, options), path);
}

std::string HexColor(const Rgb& color) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", color.r, color.g, color.b);
  return text;
}

}  // namespace ridgeline
