// SPDX-License-Identifier: Apache-2.0
#include "report/overlay_legend.h"

#include <algorithm>

namespace ridgeline {

LegendLayout LayLegend(const Overlay& overlay,
                       double scale,
                       double width,
                       const std::function<double(const std::string&)>& width_of) {
  const double pad = 9.0 * scale;
  const double row = 20.0 * scale;
  LegendLayout layout;
  layout.sample = 24.0 * scale;
  double x = pad;
  double y = 0.5 * row + 0.5 * pad;
  const auto put = [&](const OverlayLayer* layer, const std::string& text) {
    const double lead = layer == nullptr ? 0.0 : layout.sample + 0.6 * pad;
    const double length = lead + width_of(text);
    if (x > pad && x + length + pad > width) {
      x = pad;
      y += row;
    }
    layout.places.push_back({layer, text, x, y});
    x += length + 2.0 * pad;
  };
  for (const OverlayLayer& layer : overlay.layers) {
    if (!layer.name.empty() && !layer.lines.empty()) put(&layer, layer.name);
  }
  if (!overlay.caption.empty()) put(nullptr, overlay.caption);
  if (!layout.places.empty()) layout.height = y + 0.5 * row + 0.5 * pad;
  return layout;
}

}  // namespace ridgeline
