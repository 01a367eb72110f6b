// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "city/crs.h"

namespace ridgeline {

// The one place that knows lengths in other units than metres.

// Metres per unit of length as files name it: "m", "metre", "ft" and "foot" (0.3048 m), "US survey
// foot", "us-ft", "ftUS" (1200/3937 m), "cm", "dm", "mm", "km", "yd", with or without a plural, and
// EPSG's codes of units at the end of an address or URN ("urn:ogc:def:uom:EPSG::9002"). nullopt: no
// unit of length that is known.
std::optional<double> MetresPerUnit(std::string_view unit);

struct LengthUnit {
  double metres = 1.0;
  std::string name = "metre";

  bool IsMetre() const { return metres == 1.0; }
};

// Of the east and north of a system; degrees and no system: metre.
LengthUnit HorizontalUnit(const Crs& crs);

// Of heights: the vertical system's. Without one the horizontal system's, since models in feet have
// both in feet.
LengthUnit HeightUnit(const Crs& crs);

// The vertical system that is the same in metres (EPSG:6360, NAVD88 in US feet: EPSG:5703); the
// system itself where it has metres; 0: none is known.
int VerticalEpsgInMetres(int vertical_epsg);

}  // namespace ridgeline
