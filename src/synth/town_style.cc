// SPDX-License-Identifier: Apache-2.0
#include "synth/town_style.h"

#include "base/error.h"

namespace ridgeline {
namespace {

const std::array<TownStyle, 5> kStyles = {{
    {"mixed", {9.0, 19.0}, {9.0, 13.0}, 2, 4, 0.45, 0.70, 0.90, 0.6, 0.6, 3.0, 7.0, 0.3},
    {"suburb", {8.0, 13.0}, {8.0, 11.0}, 1, 2, 0.55, 0.85, 0.93, 0.15, 0.1, 3.0, 9.0, 0.1},
    {"centre", {10.0, 22.0}, {10.0, 13.0}, 3, 4, 0.40, 0.60, 0.95, 0.95, 0.9, 2.0, 5.0, 0.35},
    {"village", {9.0, 16.0}, {8.0, 12.0}, 1, 3, 0.75, 0.90, 0.93, 0.3, 0.4, 3.0, 9.0, 0.5},
    {"estate", {18.0, 40.0}, {10.0, 13.0}, 3, 6, 0.10, 0.20, 0.95, 0.2, 0.1, 3.0, 9.0, 0.0},
}};

}  // namespace

std::vector<std::string> TownStyleNames() {
  std::vector<std::string> names;
  for (const TownStyle& style : kStyles) names.push_back(style.name);
  return names;
}

const TownStyle& FindTownStyle(const std::string& name) {
  std::string names;
  for (const TownStyle& style : kStyles) {
    if (style.name == name) return style;
    names += (names.empty() ? "" : ", ") + style.name;
  }
  throw InputError("", "town.style", "\"" + name + "\"", names);
}

}  // namespace ridgeline
