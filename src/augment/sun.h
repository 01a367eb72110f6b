// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace ridgeline {

// A moment in universal time.
struct UtcTime {
  int year = 2026;
  int month = 6;
  int day = 21;
  double hours = 12.0;  // since midnight UTC, [0, 24)
};

// "2026-06-21T14:30+02:00", "...Z", seconds optional; a time without zone is UTC. Throws InputError
// naming `option`.
UtcTime ParseTime(const std::string& text, const std::string& option);

// Direction to the sun: azimuth clockwise from true north, elevation above the horizon with mean
// refraction [deg].
struct SunDirection {
  double azimuth_deg = 0.0;
  double elevation_deg = 0.0;
};

// To about 0.01 degrees between 1950 and 2050 (low precision formulas of the Astronomical Almanac;
// refraction after Bennett 1982).
SunDirection SunAt(const UtcTime& time, double latitude_deg, double longitude_deg);

}  // namespace ridgeline
