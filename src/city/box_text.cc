// SPDX-License-Identifier: Apache-2.0
#include "city/box_text.h"

#include <cmath>

#include "base/decimals.h"

namespace ridgeline {

std::string BoxText(const Eigen::AlignedBox2d& box) {
  const auto whole = [](double value) {
    return std::isfinite(value) ? std::to_string(static_cast<long long>(std::floor(value)))
                                : ShortestText(value);
  };
  return whole(box.min().x()) + ".." + whole(box.max().x()) + " E, " + whole(box.min().y()) + ".." +
         whole(box.max().y()) + " N";
}

}  // namespace ridgeline
