// SPDX-License-Identifier: Apache-2.0
#include "report/overlay.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/atomic_file.h"
#include "base/error.h"
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

// A box of names and line samples in the lower left corner.
void DrawLegend(const Overlay& overlay, double scale, cv::Mat& picture) {
  const double font = 0.42 * scale;
  const int font_weight = std::max(1, static_cast<int>(std::lround(0.9 * scale)));
  const int line_height = static_cast<int>(std::lround(19 * scale));
  const int pad = static_cast<int>(std::lround(9 * scale));
  const int sample = static_cast<int>(std::lround(26 * scale));
  std::vector<const OverlayLayer*> listed;
  int text_width = 0;
  const auto width_of = [&](const std::string& text) {
    int baseline = 0;
    return cv::getTextSize(text, cv::FONT_HERSHEY_DUPLEX, font, font_weight, &baseline).width;
  };
  for (const OverlayLayer& layer : overlay.layers) {
    if (layer.name.empty() || layer.lines.empty()) continue;
    listed.push_back(&layer);
    text_width = std::max(text_width, sample + pad + width_of(layer.name));
  }
  const int rows = static_cast<int>(listed.size()) + (overlay.caption.empty() ? 0 : 1);
  if (rows == 0) return;
  if (!overlay.caption.empty()) text_width = std::max(text_width, width_of(overlay.caption));
  const cv::Rect box = cv::Rect(pad,
                                picture.rows - pad - rows * line_height - pad,
                                text_width + 2 * pad,
                                rows * line_height + pad) &
                       cv::Rect(0, 0, picture.cols, picture.rows);
  cv::Mat area = picture(box);
  area = 0.22 * area;
  int y = box.y + pad / 2 + line_height / 2;
  const auto put = [&](const std::string& text, int x) {
    cv::putText(picture,
                text,
                {x, y + static_cast<int>(std::lround(5 * scale))},
                cv::FONT_HERSHEY_DUPLEX,
                font,
                {245, 245, 245},
                font_weight,
                cv::LINE_AA);
  };
  for (const OverlayLayer* layer : listed) {
    const int x = box.x + pad;
    cv::line(picture,
             {x, y},
             {x + sample, y},
             Bgr(layer->color),
             std::max(2, static_cast<int>(std::lround(layer->width_px * scale))),
             cv::LINE_AA);
    put(layer->name, x + sample + pad);
    y += line_height;
  }
  if (!overlay.caption.empty()) put(overlay.caption, box.x + pad);
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
  if (options.legend) DrawLegend(overlay, scale, picture);
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
