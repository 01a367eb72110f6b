// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace ridgeline {

struct Rgb {
  std::uint8_t r = 255;
  std::uint8_t g = 255;
  std::uint8_t b = 255;
};

// A group of lines that share a meaning, a look and an entry of the legend.
struct OverlayLayer {
  std::string name;  // in the legend; empty: not listed
  Rgb color;
  double width_px = 2.0;  // for a picture of 1000 px diagonal; grows with the picture
  double opacity = 1.0;
  bool casing = true;  // a dark rim, so that the line shows on any background
  // Image coordinates as in COLMAP [px]; runs of two points or more.
  std::vector<std::vector<Eigen::Vector2f>> lines;
};

// Lines over a photo, lowest layer first.
struct Overlay {
  std::vector<OverlayLayer> layers;
  std::string caption;  // in the legend's last line; may be empty
};

struct OverlayDrawOptions {
  bool legend = true;  // in a strip below the photo, which makes the picture higher
  // Brightness of the photo below the lines, (0, 1].
  double photo_brightness = 0.85;
};

// The photo (8-bit, 1 or 3 channels) with the lines drawn in, 8-bit BGR.
cv::Mat DrawOverlay(const cv::Mat& photo,
                    const Overlay& overlay,
                    const OverlayDrawOptions& options);

// The same as SVG: lines stay sharp, the photo is embedded as JPEG.
std::string OverlaySvg(const cv::Mat& photo,
                       const Overlay& overlay,
                       const OverlayDrawOptions& options);

// Writes the overlay as its extension says: .png, .jpg or .svg; whole or not at all. Throws
// InputError for another extension or a file that cannot be written.
void WriteOverlay(const cv::Mat& photo,
                  const Overlay& overlay,
                  const OverlayDrawOptions& options,
                  const std::filesystem::path& path);

// "#rrggbb".
std::string HexColor(const Rgb& color);

}  // namespace ridgeline
