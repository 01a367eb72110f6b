// SPDX-License-Identifier: Apache-2.0
#include "lines/detector_table.h"

#include <array>

#include "base/error.h"

namespace ridgeline {

extern const DetectorPlugin kLsdDetector;
extern const DetectorPlugin kEdLinesDetector;
extern const DetectorPlugin kFldDetector;
extern const DetectorPlugin kHoughDetector;

std::span<const DetectorPlugin* const> DetectorTable() {
  static constexpr std::array kTable = {
      &kLsdDetector, &kEdLinesDetector, &kFldDetector, &kHoughDetector};
  return kTable;
}

std::vector<std::string> DetectorNames() {
  std::vector<std::string> names;
  for (const DetectorPlugin* detector : DetectorTable()) names.emplace_back(detector->name);
  return names;
}

const DetectorPlugin& FindDetector(const std::string& name) {
  std::string known;
  for (const DetectorPlugin* detector : DetectorTable()) {
    if (detector->name == name) return *detector;
    known += (known.empty() ? "" : ", ") + std::string(detector->name);
  }
  throw InputError("", "lines.detector", "\"" + name + "\"", known + " or " + kLinesFromFile);
}

}  // namespace ridgeline
