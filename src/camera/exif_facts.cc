// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>

#include "camera/facts_parts.h"
#include "camera/pose.h"

namespace ridgeline {
namespace {

using Items = std::map<std::uint16_t, ExifItem>;

// Tag numbers of CIPA DC-008 (Exif 2.32).
enum Tag : std::uint16_t {
  kMake = 0x010f,
  kModel = 0x0110,
  kOrientation = 0x0112,
  kDateTime = 0x0132,
  kDateTimeOriginal = 0x9003,
  kFocalLength = 0x920a,
  kPixelXDimension = 0xa002,
  kPixelYDimension = 0xa003,
  kFocalPlaneXResolution = 0xa20e,
  kFocalPlaneResolutionUnit = 0xa210,
  kDigitalZoomRatio = 0xa404,
  kFocalLengthIn35mmFilm = 0xa405,
  kGpsLatitudeRef = 1,
  kGpsLatitude = 2,
  kGpsLongitudeRef = 3,
  kGpsLongitude = 4,
  kGpsAltitudeRef = 5,
  kGpsAltitude = 6,
  kGpsStatus = 9,
  kGpsMeasureMode = 10,
  kGpsDop = 11,
  kGpsImgDirectionRef = 16,
  kGpsImgDirection = 17,
  kGpsMapDatum = 18,
  kGpsProcessingMethod = 27,
  kGpsHPositioningError = 31,
};

std::optional<double> Number(const Items& items, std::uint16_t tag) {
  const auto it = items.find(tag);
  if (it == items.end() || it->second.numbers.empty()) return std::nullopt;
  const double value = it->second.numbers.front();
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<double> InRange(const Items& items, std::uint16_t tag, double least, double most) {
  const std::optional<double> value = Number(items, tag);
  return value && *value >= least && *value <= most ? value : std::nullopt;
}

// An item's text in capitals, also where a program wrote it as bytes.
std::string Capitals(const Items& items, std::uint16_t tag) {
  const auto it = items.find(tag);
  if (it == items.end()) return {};
  std::string text = it->second.text;
  for (const double byte : it->second.numbers) {
    if (byte >= 32.0 && byte < 127.0) text += static_cast<char>(byte);
  }
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string Text(const Items& items, std::uint16_t tag) {
  const auto it = items.find(tag);
  return it == items.end() ? std::string() : it->second.text;
}

// "2023:06:01 12:00:00" to the month.
std::optional<double> YearOf(const std::string& date) {
  int year = 0;
  int month = 0;
  if (std::sscanf(date.c_str(), "%4d:%2d", &year, &month) != 2) return std::nullopt;
  if (year < 1900 || month < 1 || month > 12) return std::nullopt;
  return year + (month - 0.5) / 12.0;
}

// One of the two coordinates: its items, and what its hemispheres are called.
struct Axis {
  Tag tag;
  Tag reference;
  char positive;
  char negative;
  const char* name;
  const char* positive_name;
};

constexpr Axis kLatitude = {kGpsLatitude, kGpsLatitudeRef, 'N', 'S', "GPSLatitudeRef", "north"};
constexpr Axis kLongitude = {kGpsLongitude, kGpsLongitudeRef, 'E', 'W', "GPSLongitudeRef", "east"};

// Degrees, minutes and seconds, any of which may have a fraction; the hemisphere's sign.
std::optional<double> Degrees(const Items& gps,
                              const Axis& axis,
                              std::vector<std::string>& doubts) {
  const auto it = gps.find(axis.tag);
  if (it == gps.end() || it->second.numbers.empty()) return std::nullopt;
  double degrees = 0.0;
  double unit = 1.0;
  for (const double part : it->second.numbers) {
    if (!std::isfinite(part)) return std::nullopt;
    degrees += part * unit;
    unit /= 60.0;
  }
  const std::string letters = Capitals(gps, axis.reference);
  const char letter = letters.empty() ? ' ' : letters.front();
  if (letter == axis.negative) return -std::abs(degrees);
  if (letter == axis.positive) {
    if (degrees < 0.0) {
      doubts.push_back(FormatText(
          "position: %.6f deg is negative and %s says %c; the sign is believed, not the letter",
          degrees,
          axis.name,
          letter));
    }
    return degrees;
  }
  doubts.push_back(FormatText("position: the hemisphere is %s (EXIF %s); %s assumed",
                              letters.empty() ? "not told" : "no letter that is known",
                              axis.name,
                              degrees < 0.0 ? "the number's sign" : axis.positive_name));
  return degrees;
}

// Datums within two metres of WGS 84, in capitals and digits only; EGM 96 is a geoid's name that
// some cameras write here.
bool IsWgs84(const std::string& datum) {
  std::string plain;
  for (const char c : datum) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) plain += c;
  }
  for (const char* known : {"",
                            "WGS84",
                            "WGS1984",
                            "WORLDGEODETICSYSTEM1984",
                            "EGM96",
                            "ETRS89",
                            "JGD2000",
                            "JGD2011",
                            "GDA94",
                            "GDA2020",
                            "NAD83",
                            "CGCS2000"}) {
    if (plain == known) return true;
  }
  return plain.starts_with("WGS84") || plain.starts_with("ITRF") || plain == "EPSG4326" ||
         plain == "EPSG4979";
}

// How far the receiver may be off, as it says itself.
void TakeReceiver(const Items& gps, PictureFacts& facts) {
  // A receiver's error per unit of its dilution of precision [m].
  constexpr double kMetresPerDop = 5.0;
  constexpr double kNetworkErrorM = 100.0;
  if (!facts.horizontal_error_m) {
    facts.horizontal_error_m = InRange(gps, kGpsHPositioningError, 1e-3, 1e5);
  }
  if (!facts.horizontal_error_m) {
    if (const auto dop = InRange(gps, kGpsDop, 1e-3, 100.0)) {
      facts.horizontal_error_m = kMetresPerDop * *dop;
      facts.doubts.push_back(FormatText(
          "position: GPSDOP %.1f is taken as an error of %.0f m", *dop, kMetresPerDop * *dop));
    }
  }
  if (Capitals(gps, kGpsStatus).starts_with('V')) {
    facts.doubts.push_back("position: the receiver had no valid fix (GPSStatus V)");
  }
  const std::string method = Capitals(gps, kGpsProcessingMethod);
  for (const char* network : {"CELLID", "WLAN", "NETWORK"}) {
    if (method.find(network) == std::string::npos) continue;
    facts.horizontal_error_m = std::max(kNetworkErrorM, facts.horizontal_error_m.value_or(0.0));
    facts.doubts.push_back(std::string("position: from the network, not from satellites (") +
                           network + "); it may be off by 100 m and more");
    break;
  }
  const std::string datum = Capitals(gps, kGpsMapDatum);
  if (!IsWgs84(datum)) {
    facts.doubts.push_back("position: the EXIF names the datum " + datum +
                           "; taken as WGS 84, which may be off by hundreds of metres");
  }
}

// References: 0 and 1 above and below sea level, 2 and 3 above and below the ellipsoid (Exif 3.0).
void TakeExifAltitude(const Items& gps, PictureFacts& facts) {
  const auto altitude = Number(gps, kGpsAltitude);
  if (!altitude || facts.altitude_m) return;
  if (Capitals(gps, kGpsMeasureMode).starts_with('2')) {
    facts.doubts.push_back(FormatText(
        "altitude: %.1f m is not used, since the fix was two-dimensional (GPSMeasureMode 2)",
        *altitude));
    return;
  }
  std::optional<double> reference = Number(gps, kGpsAltitudeRef);
  const std::string digits = Text(gps, kGpsAltitudeRef);
  if (!reference && !digits.empty()) reference = digits.front();
  if (reference && *reference >= '0' && *reference <= '3') *reference -= '0';  // as text
  if (!reference || *reference < 0.0 || *reference > 3.0) {
    facts.doubts.push_back(
        "altitude: its reference is not told (EXIF GPSAltitudeRef); above sea "
        "level assumed");
    reference = 0.0;
  }
  const bool below = *reference == 1.0 || *reference == 3.0;
  TakeAltitude(below ? -std::abs(*altitude) : *altitude, *reference >= 2.0, "EXIF", facts);
}

void TakeExifDirection(const Items& gps, PictureFacts& facts) {
  const auto heading = Number(gps, kGpsImgDirection);
  if (!heading || facts.direction) return;
  if (std::abs(*heading) > 720.0) {
    facts.doubts.push_back(
        FormatText("heading: %.4g deg in the EXIF is no direction; taken as not told", *heading));
    return;
  }
  const std::string north = Capitals(gps, kGpsImgDirectionRef);
  if (north != "M" && north != "T") {
    facts.doubts.push_back(
        "heading: the EXIF does not tell from which north (GPSImgDirectionRef); true north "
        "assumed");
  }
  if (*heading == 0.0) {
    facts.doubts.push_back("heading: 0 to the last digit; some programs write that for unknown");
  }
  PictureFacts::Direction direction;
  direction.heading_deg = WrapHeadingDeg(*heading);
  direction.magnetic = north == "M";
  direction.source = "EXIF";
  facts.direction = direction;
}

void TakeOptics(const Items& photo, PictureFacts& facts) {
  // The widest and the longest lenses made, with room [mm]; a zoom of 1 is none.
  facts.focal_mm = InRange(photo, kFocalLength, 0.1, 1e4);
  facts.focal_35mm = InRange(photo, kFocalLengthIn35mmFilm, 0.1, 1e5);
  if (const auto zoom = InRange(photo, kDigitalZoomRatio, 1.005, 200.0)) facts.zoom = zoom;
  const auto width = InRange(photo, kPixelXDimension, 1.0, 1e6);
  const auto height = InRange(photo, kPixelYDimension, 1.0, 1e6);
  if (width) facts.recorded = PictureFacts::Size{*width, height.value_or(0.0)};
  // Units: 2 inch, 3 centimetre, 4 millimetre, 5 micrometre; inch where it is not said.
  const double unit = Number(photo, kFocalPlaneResolutionUnit).value_or(2.0);
  const double mm = unit == 3.0 ? 10.0 : unit == 4.0 ? 1.0 : unit == 5.0 ? 1e-3 : 25.4;
  if (const auto resolution = InRange(photo, kFocalPlaneXResolution, 1e-6, 1e9)) {
    facts.plane_px_per_mm = *resolution / mm;
  }
}

// Makers of cameras that fly and of nothing else.
bool MakesAircraft(std::string make) {
  for (char& c : make) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* maker : {"dji",
                            "autel",
                            "parrot",
                            "skydio",
                            "yuneec",
                            "sensefly",
                            "sentera",
                            "micasense",
                            "hubsan",
                            "powervision",
                            "xiaomi fimi",
                            "fimi",
                            "wingtra",
                            "quantum-systems",
                            "delair",
                            "zero zero robotics"}) {
    if (make.starts_with(maker)) return true;
  }
  return false;
}

}  // namespace

void TakeExif(const ExifItems& exif, PictureFacts& facts) {
  facts.make = Text(exif.image, kMake);
  facts.camera = Text(exif.image, kModel);
  facts.from_aircraft = facts.from_aircraft || MakesAircraft(facts.make);
  const double orientation = Number(exif.image, kOrientation).value_or(1.0);
  facts.orientation = orientation >= 1.0 && orientation <= 8.0 ? static_cast<int>(orientation) : 1;
  facts.year = YearOf(Text(exif.photo, kDateTimeOriginal));
  if (!facts.year) facts.year = YearOf(Text(exif.image, kDateTime));
  TakeOptics(exif.photo, facts);
  if (!facts.place) {
    std::vector<std::string> doubts;
    const auto latitude = Degrees(exif.gps, kLatitude, doubts);
    const auto longitude = Degrees(exif.gps, kLongitude, doubts);
    facts.place = PlaceAt(latitude, longitude, "EXIF");
    if (facts.place) {
      facts.doubts.insert(facts.doubts.end(), doubts.begin(), doubts.end());
      TakeReceiver(exif.gps, facts);
    } else if (latitude && longitude) {
      facts.doubts.push_back(FormatText(
          "position: latitude %.4g, longitude %.4g in the EXIF is no place; taken as not told",
          *latitude,
          *longitude));
    }
  }
  TakeExifAltitude(exif.gps, facts);
  TakeExifDirection(exif.gps, facts);
}

}  // namespace ridgeline
