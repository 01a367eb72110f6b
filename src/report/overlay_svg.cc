// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <string>

#include "report/overlay.h"
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

std::string Legend(const Overlay& overlay, double scale, int height) {
  std::string rows;
  std::size_t letters = 0;
  int count = 0;
  const double step = 19.0 * scale;
  const auto add_text = [&](const std::string& text, double x) {
    rows += "<text x=\"" + Number(x) + "\" y=\"" + Number((count + 0.72) * step) + "\">" +
            EscapeMarkup(text) + "</text>";
    letters = std::max(letters, text.size());
    ++count;
  };
  for (const OverlayLayer& layer : overlay.layers) {
    if (layer.name.empty() || layer.lines.empty()) continue;
    const std::string y = Number((count + 0.5) * step);
    rows += "<path d=\"M0 " + y + "H" + Number(26.0 * scale) + "\" stroke=\"" +
            HexColor(layer.color) + "\" stroke-width=\"" + Number(layer.width_px * scale) + "\"/>";
    add_text(layer.name, 35.0 * scale);
  }
  if (!overlay.caption.empty()) add_text(overlay.caption, 0.0);
  if (count == 0) return "";
  const double pad = 9.0 * scale;
  const double box_width = 35.0 * scale + 7.4 * scale * static_cast<double>(letters) + 2.0 * pad;
  const double box_height = count * step + pad;
  return "<g transform=\"translate(" + Number(pad) + " " + Number(height - box_height - pad) +
         ")\"><rect width=\"" + Number(box_width) + "\" height=\"" + Number(box_height) +
         "\" rx=\"" + Number(4.0 * scale) +
         "\" fill=\"#000\" opacity=\"0.75\"/><g transform=\"translate(" + Number(pad) + " " +
         Number(0.5 * pad) + ")\" fill=\"#fff\" font-family=\"sans-serif\" font-size=\"" +
         Number(13.0 * scale) + "\">" + rows + "</g></g>\n";
}

}  // namespace

std::string OverlaySvg(const cv::Mat& photo,
                       const Overlay& overlay,
                       const OverlayDrawOptions& options) {
  const double scale = OverlayScale(photo.size());
  const std::string width = std::to_string(photo.cols);
  const std::string height = std::to_string(photo.rows);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + width + " " +
                    height + "\">\n<rect width=\"" + width + "\" height=\"" + height +
                    "\" fill=\"#000\"/>\n<image width=\"" + width + "\" height=\"" + height +
                    "\" preserveAspectRatio=\"none\" opacity=\"" +
                    Number(options.photo_brightness) + "\" href=\"" +
                    JpegDataUrl(photo, std::max(photo.cols, photo.rows), 88) + "\"/>\n";
  for (const OverlayLayer& layer : overlay.layers) svg += Group(layer, scale);
  if (options.legend) svg += Legend(overlay, scale, photo.rows);
  return svg + "</svg>\n";
}

}  // namespace ridgeline
