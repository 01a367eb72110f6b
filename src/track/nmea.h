// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace ridgeline {

// What a receiver would say of a pose.
struct NmeaFix {
  std::optional<double> time_s;  // of the day, UTC
  double latitude_deg = 0.0;     // WGS 84
  double longitude_deg = 0.0;
  double altitude_m = 0.0;  // above sea level
  double true_heading_deg = 0.0;
  std::optional<double> speed_m_s;   // over ground, with its course
  std::optional<double> course_deg;  // true
  bool is_tracked = false;           // else estimated
};

// NMEA 0183 sentences GGA, RMC and HDT, each with checksum and CR LF. Quality 1 while tracked, 6
// (estimated) else; no satellites. Without a fix: GGA and RMC with empty fields, as a receiver does
// that has none.
std::string NmeaSentences(const std::optional<NmeaFix>& fix);

// "$...*hh\r\n" of the body between $ and *.
std::string NmeaSentence(const std::string& body);

}  // namespace ridgeline
