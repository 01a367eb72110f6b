// SPDX-License-Identifier: Apache-2.0
#include "lines/detector_table.h"

#include <algorithm>

#include "base/error.h"

namespace ridgeline {

extern const DetectorPlugin kLsdDetector;
extern const DetectorPlugin kEdLinesDetector;
extern const DetectorPlugin kFldDetector;
extern const DetectorPlugin kHoughDetector;

namespace {

std::vector<const DetectorPlugin*>& Table() {
  static std::vector<const DetectorPlugin*> table = {
      &kLsdDetector, &kEdLinesDetector, &kFldDetector, &kHoughDetector};
  return table;
}

}  // namespace

std::span<const DetectorPlugin* const> DetectorTable() { return Table(); }

void AddDetector(const DetectorPlugin& plugin) {
  const std::vector<std::string> taken = DetectorNames();
  if (plugin.name == std::string(kLinesFromFile) ||
      std::find(taken.begin(), taken.end(), plugin.name) != taken.end()) {
    throw InputError(
        "", "detector", "\"" + std::string(plugin.name) + "\" again", "a name of its own");
  }
  Table().push_back(&plugin);
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
