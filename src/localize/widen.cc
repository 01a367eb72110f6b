// SPDX-License-Identifier: Apache-2.0
#include "localize/widen.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

namespace ridgeline {
namespace {

struct Dimension {
  const char* name;
  const char* unit;
  double PoseSpace::Offset::*offset;
  double PoseSpaceOptions::*range;
  double whole;  // beyond which there is nothing to search
  bool is_border;
};

constexpr Dimension kParameters[] = {
    {"east", "m", &PoseSpace::Offset::east_m, &PoseSpaceOptions::east_m, 1000.0, true},
    {"north", "m", &PoseSpace::Offset::north_m, &PoseSpaceOptions::north_m, 1000.0, true},
    {"height", "m", &PoseSpace::Offset::height_m, &PoseSpaceOptions::height_m, 1000.0, false},
    {"heading", "deg", &PoseSpace::Offset::heading_deg, &PoseSpaceOptions::heading_deg, 180.0, true},
    {"pitch", "deg", &PoseSpace::Offset::pitch_deg, &PoseSpaceOptions::pitch_deg, 90.0, false},
    {"roll", "deg", &PoseSpace::Offset::roll_deg, &PoseSpaceOptions::roll_deg, 180.0, false}};

// The truth is not in a box of that size: the next is larger by this much.
constexpr double kFurtherM = 30.0;

bool IsReached(const Dimension& parameter, const PoseSpace::Offset& offset, const PoseSpace& space) {
  constexpr double kNear = 0.97;
  const double range = space.ranges().*parameter.range;
  return range > 0.0 && range < parameter.whole && std::abs(offset.*parameter.offset) > kNear * range;
}

}  // namespace

std::vector<std::string> LimitsReached(const PoseSpace::Offset& offset, const PoseSpace& space) {
  std::vector<std::string> names;
  for (const Dimension& parameter : kParameters) {
    if (!IsReached(parameter, offset, space)) continue;
    char text[60];
    std::snprintf(text,
                  sizeof(text),
                  "%s (%g %s)",
                  parameter.name,
                  space.ranges().*parameter.range,
                  parameter.unit);
    names.emplace_back(text);
  }
  return names;
}

bool IsOnBorder(const PoseSpace::Offset& offset, const PoseSpace& space) {
  return std::any_of(std::begin(kParameters), std::end(kParameters), [&](const Dimension& p) {
    return p.is_border && IsReached(p, offset, space);
  });
}

PoseSpaceOptions Widened(const PoseSpace& space, const PoseSpace::Offset& offset, bool everywhere) {
  PoseSpaceOptions wide = space.ranges();
  for (const Dimension& parameter : kParameters) {
    if (!IsReached(parameter, offset, space)) continue;
    wide.*parameter.range = std::min(2.0 * (wide.*parameter.range), parameter.whole);
  }
  if (!everywhere) return wide;
  for (double PoseSpaceOptions::*range : {&PoseSpaceOptions::east_m, &PoseSpaceOptions::north_m}) {
    if (wide.*range > 0.0) wide.*range = std::max(wide.*range, space.ranges().*range + kFurtherM);
  }
  if (wide.heading_deg > 0.0) wide.heading_deg = 180.0;
  return wide;
}

std::string WordsOf(const PoseSpaceOptions& ranges) {
  char text[160];
  std::snprintf(text,
                sizeof(text),
                "within %.0f m, %.1f m up and down, heading %.0f deg, pitch %.0f deg, roll %.0f deg",
                std::max(ranges.east_m, ranges.north_m),
                ranges.height_m,
                ranges.heading_deg,
                ranges.pitch_deg,
                ranges.roll_deg);
  return text;
}

}  // namespace ridgeline
