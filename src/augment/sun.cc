// SPDX-License-Identifier: Apache-2.0
#include "augment/sun.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>

#include "base/angle.h"
#include "base/error.h"

namespace ridgeline {
namespace {

// Days since 2000-01-01 12:00 UTC of a date of the Gregorian calendar.
double DaysSince2000(const UtcTime& t) {
  const int a = (14 - t.month) / 12;
  const int y = t.year + 4800 - a;
  const int m = t.month + 12 * a - 3;
  const int day_number =
      t.day + (153 * m + 2) / 5 + 365 * y + y / 4 - y / 100 + y / 400 - 32045;
  return day_number - 2451545 + (t.hours - 12.0) / 24.0;
}

bool IsDate(int year, int month, int day) {
  constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  if (year < 1900 || year > 2100 || month < 1 || month > 12 || day < 1) return false;
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return day <= kDays[month - 1] + (month == 2 && leap ? 1 : 0);
}

}  // namespace

UtcTime ParseTime(const std::string& text, const std::string& option) {
  const auto refuse = [&]() -> InputError {
    return InputError(option, "", '"' + text + '"', "e.g. 2026-06-21T14:30+02:00");
  };
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, used = 0;
  if (std::sscanf(text.c_str(), "%4d-%2d-%2d%*1[T ]%2d:%2d%n", &year, &month, &day, &hour, &minute,
                  &used) != 5) {
    throw refuse();
  }
  double seconds = 0.0;
  const char* rest = text.c_str() + used;
  if (*rest == ':') {
    int more = 0;
    if (std::sscanf(rest, ":%lf%n", &seconds, &more) != 1) throw refuse();
    rest += more;
  }
  int zone_hours = 0, zone_minutes = 0;
  if (*rest == '+' || *rest == '-') {
    int more = 0;
    if (std::sscanf(rest + 1, "%2d:%2d%n", &zone_hours, &zone_minutes, &more) != 2) throw refuse();
    if (*rest == '-') zone_hours = -zone_hours, zone_minutes = -zone_minutes;
    rest += 1 + more;
  } else if (*rest == 'Z') {
    ++rest;
  }
  const bool ok = *rest == '\0' && IsDate(year, month, day) && hour >= 0 && hour < 24 &&
                  minute >= 0 && minute < 60 && seconds >= 0.0 && seconds < 61.0 &&
                  std::abs(zone_hours) <= 14 && std::abs(zone_minutes) < 60;
  if (!ok) throw refuse();
  // Hours beyond the day are the next or the last day's, which the formulas take as they are.
  return {year, month, day,
          hour - zone_hours + (minute - zone_minutes) / 60.0 + seconds / 3600.0};
}

SunDirection SunAt(const UtcTime& time, double latitude_deg, double longitude_deg) {
  const double days = DaysSince2000(time);
  const double mean_longitude = 280.460 + 0.9856474 * days;
  const double anomaly = (357.528 + 0.9856003 * days) * kRadPerDeg;
  const double ecliptic =
      (mean_longitude + 1.915 * std::sin(anomaly) + 0.020 * std::sin(2.0 * anomaly)) * kRadPerDeg;
  const double obliquity = (23.439 - 0.0000004 * days) * kRadPerDeg;
  const double ascension =
      std::atan2(std::cos(obliquity) * std::sin(ecliptic), std::cos(ecliptic));
  const double declination = std::asin(std::sin(obliquity) * std::sin(ecliptic));
  const double sidereal_deg = 280.46061837 + 360.98564736629 * days + longitude_deg;
  const double hour_angle =
      std::remainder(sidereal_deg * kRadPerDeg - ascension, 2.0 * std::numbers::pi);
  const double latitude = latitude_deg * kRadPerDeg;
  const double sine = std::sin(latitude) * std::sin(declination) +
                      std::cos(latitude) * std::cos(declination) * std::cos(hour_angle);
  SunDirection sun;
  sun.elevation_deg = std::asin(sine) / kRadPerDeg;
  const double azimuth =
      std::atan2(-std::sin(hour_angle),
                 std::tan(declination) * std::cos(latitude) -
                     std::sin(latitude) * std::cos(hour_angle));
  sun.azimuth_deg = std::fmod(azimuth / kRadPerDeg + 360.0, 360.0);
  if (sun.elevation_deg > -1.0) {
    const double h = sun.elevation_deg;
    sun.elevation_deg += 1.02 / 60.0 / std::tan((h + 10.3 / (h + 5.11)) * kRadPerDeg);
  }
  return sun;
}

}  // namespace ridgeline
