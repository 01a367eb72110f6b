// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <string>

#include "report/overlay.h"
#include "report/overlay_legend.h"
#include "report/overlay_scale.h"
#include "report/picture_file.h"

namespace ridgeline {
namespace {

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

std::string PathData(const OverlayLayer& layer) {
  std::string data;
  for (const auto& line : layer.lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      data += (i == 0 ? "M" : "L") + Number(line[i].x()) + " " + Number(line[i].y());
    }
  }
  return data;
}

std::string Group(const OverlayLayer& layer, double scale) {
  const double width = layer.width_px * scale;
  const std::string data = PathData(layer);
  std::string group = "<g fill=\"none\" stroke-linecap=\"round\" opacity=\"" +
                      Number(layer.opacity) + "\"><title>" + EscapeMarkup(layer.name) + "</title>";
  if (layer.casing) {
    group += "<path stroke=\"#000\" stroke-width=\"" + Number(width + 1.4 * scale) + "\" d=\"" +
             data + "\"/>";
  }
  return group + "<path stroke=\"" + HexColor(layer.color) + "\" stroke-width=\"" + Number(width) +
         "\" d=\"" + data + "\"/></g>\n";
}

// About the width of a letter of 13 px.
constexpr double kLetterPx = 6.6;

// The strip below the picture.
std::string Legend(const LegendLayout& layout, double scale, const cv::Size& photo) {
  std::string marks;
  for (const LegendPlace& place : layout.places) {
    double x = place.x;
    if (place.layer != nullptr) {
      marks += "<path d=\"M" + Number(x) + " " + Number(place.y) + "h" + Number(layout.sample) +
               "\" stroke=\"" + HexColor(place.layer->color) + "\" stroke-width=\"" +
               Number(place.layer->width_px * scale) + "\"/>";
      x += layout.sample + 5.4 * scale;
    }
    marks += "<text x=\"" + Number(x) + "\" y=\"" + Number(place.y + 4.5 * scale) + "\">" +
             EscapeMarkup(place.text) + "</text>";
  }
  return "<g transform=\"translate(0 " + std::to_string(photo.height) + ")\"><rect width=\"" +
         std::to_string(photo.width) + "\" height=\"" + Number(layout.height) +
         "\" fill=\"#202020\"/><g fill=\"#fff\" font-family=\"sans-serif\" font-size=\"" +
         Number(13.0 * scale) + "\">" + marks + "</g></g>\n";
}

}  // namespace

std::string OverlaySvg(const cv::Mat& photo,
                       const Overlay& overlay,
                       const OverlayDrawOptions& options) {
  const double scale = OverlayScale(photo.size());
  const std::string width = std::to_string(photo.cols);
  const std::string height = std::to_string(photo.rows);
  LegendLayout legend;
  if (options.legend) {
    legend = LayLegend(overlay, scale, photo.cols, [&](const std::string& text) {
      return kLetterPx * scale * static_cast<double>(text.size());
    });
  }
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + width + " " +
                    Number(photo.rows + legend.height) + "\">\n<rect width=\"" + width + "\" height=\"" + height +
                    "\" fill=\"#000\"/>\n<image width=\"" + width + "\" height=\"" + height +
                    "\" preserveAspectRatio=\"none\" opacity=\"" +
                    Number(options.photo_brightness) + "\" href=\"" +
                    JpegDataUrl(photo, std::max(photo.cols, photo.rows), 88) + "\"/>\n";
  for (const OverlayLayer& layer : overlay.layers) svg += Group(layer, scale);
  if (legend.height > 0.0) svg += Legend(legend, scale, photo.size());
  return svg + "</svg>\n";
}

}  // namespace ridgeline
