// SPDX-License-Identifier: Apache-2.0
#include "track/nmea.h"

#include <cmath>
#include <cstdio>

namespace ridgeline {
namespace {

constexpr double kKnotsPerMetre = 3600.0 / 1852.0;

// hhmmss.ss
std::string TimeText(const std::optional<double>& time_s) {
  if (!time_s) return "";
  const double day = std::fmod(std::fmod(*time_s, 86400.0) + 86400.0, 86400.0);
  const auto hundredths = static_cast<long>(day * 100.0 + 1e-6);
  char text[32];
  std::snprintf(text,
                sizeof text,
                "%02ld%02ld%02ld.%02ld",
                hundredths / 360000 % 24,
                hundredths / 6000 % 60,
                hundredths / 100 % 60,
                hundredths % 100);
  return text;
}

// Degrees and minutes, and the hemisphere: "4808.123456,N".
std::string AngleText(double degrees, int digits, const char* hemispheres) {
  // In ten-millionths of a minute, so that minutes never round to 60.
  const auto units = std::llround(std::abs(degrees) * 60.0 * 1e6);
  char text[48];
  std::snprintf(text,
                sizeof text,
                "%0*lld%02lld.%06lld,%c",
                digits,
                units / 60000000,
                units / 1000000 % 60,
                units % 1000000,
                degrees < 0.0 ? hemispheres[1] : hemispheres[0]);
  return text;
}

std::string Number(double value, const char* format) {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

std::string NmeaSentence(const std::string& body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  char end[8];
  std::snprintf(end, sizeof end, "*%02X\r\n", sum);
  return "$" + body + end;
}

std::string NmeaSentences(const std::optional<NmeaFix>& fix) {
  if (!fix) return NmeaSentence("GPGGA,,,,,,0,00,,,M,,M,,") + NmeaSentence("GPRMC,,V,,,,,,,,,,N");
  const std::string time = TimeText(fix->time_s);
  const std::string place = AngleText(fix->latitude_deg, 2, "NS") + "," +
                            AngleText(fix->longitude_deg, 3, "EW");
  const std::string gga = "GPGGA," + time + "," + place + "," + (fix->is_tracked ? "1" : "6") +
                          ",00,," + Number(fix->altitude_m, "%.2f") + ",M,,M,,";
  const std::string rmc =
      "GPRMC," + time + ",A," + place + "," +
      (fix->speed_m_s ? Number(*fix->speed_m_s * kKnotsPerMetre, "%.2f") : "") + "," +
      (fix->course_deg ? Number(*fix->course_deg, "%.2f") : "") + ",,,," +
      (fix->is_tracked ? "A" : "E");
  const std::string hdt = "GPHDT," + Number(fix->true_heading_deg, "%.2f") + ",T";
  return NmeaSentence(gga) + NmeaSentence(rmc) + NmeaSentence(hdt);
}

}  // namespace ridgeline
