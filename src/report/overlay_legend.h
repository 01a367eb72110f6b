// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "report/overlay.h"

namespace ridgeline {

// A name of a legend in the strip below a picture, by the left end of its line [px of the strip].
struct LegendPlace {
  const OverlayLayer* layer = nullptr;  // null: the overlay's caption
  std::string text;
  double x = 0.0;
  double y = 0.0;  // of the middle of the letters
};

struct LegendLayout {
  std::vector<LegendPlace> places;
  double height = 0.0;  // of the strip; 0: nothing to say
  double sample = 0.0;  // length of the line that stands before a name
};

// Names beside each other, in as many rows as they need.
// @param width_of  Of a text [px].
LegendLayout LayLegend(const Overlay& overlay,
                       double scale,
                       double width,
                       const std::function<double(const std::string&)>& width_of);

}  // namespace ridgeline
