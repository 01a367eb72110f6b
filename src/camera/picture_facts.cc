// SPDX-License-Identifier: Apache-2.0
#include "camera/picture_facts.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include "base/error.h"
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
  kGpsImgDirectionRef = 16,
  kGpsImgDirection = 17,
  kGpsHPositioningError = 31,
};

constexpr const char* kDji = "http://www.dji.com/drone-dji/1.0/ ";
constexpr const char* kPix4d = "http://pix4d.com/camera/1.0";
constexpr const char* kPano = "http://ns.google.com/photos/1.0/panorama/ ";

std::optional<double> Number(const Items& items, std::uint16_t tag) {
  const auto it = items.find(tag);
  if (it == items.end() || it->second.numbers.empty()) return std::nullopt;
  const double value = it->second.numbers.front();
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<double> Positive(const Items& items, std::uint16_t tag) {
  const std::optional<double> value = Number(items, tag);
  return value && *value > 0.0 ? value : std::nullopt;
}

std::string Text(const Items& items, std::uint16_t tag) {
  const auto it = items.find(tag);
  return it == items.end() ? std::string() : it->second.text;
}

std::optional<double> Number(const XmpProperties& xmp, const std::string& name) {
  const auto it = xmp.find(name);
  if (it == xmp.end()) return std::nullopt;
  std::string_view text = it->second;
  while (!text.empty() && (text.front() == ' ' || text.front() == '+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  // Pix4D writes heights and angles as fractions too.
  if (end != text.data() + text.size() && *end == '/') {
    double denominator = 0.0;
    std::from_chars(end + 1, text.data() + text.size(), denominator);
    if (denominator == 0.0) return std::nullopt;
    value /= denominator;
  }
  return value;
}

// The namespace is written with and without a slash at its end.
std::optional<double> Pix4d(const XmpProperties& xmp, const std::string& name) {
  const std::optional<double> value = Number(xmp, kPix4d + std::string("/ ") + name);
  return value ? value : Number(xmp, kPix4d + std::string(" ") + name);
}

// Degrees, minutes and seconds, any of which may have a fraction; the reference letter's sign.
std::optional<double> Degrees(const Items& gps, Tag tag, Tag reference, char negative) {
  const auto it = gps.find(tag);
  if (it == gps.end() || it->second.numbers.empty()) return std::nullopt;
  double degrees = 0.0;
  double unit = 1.0;
  for (const double part : it->second.numbers) {
    if (!std::isfinite(part)) return std::nullopt;
    degrees += part * unit;
    unit /= 60.0;
  }
  const std::string letter = Text(gps, reference);
  return !letter.empty() && letter.front() == negative ? -degrees : degrees;
}

// A receiver without a fix writes zeros.
std::optional<PictureFacts::Place> PlaceAt(std::optional<double> latitude,
                                           std::optional<double> longitude,
                                           const char* source) {
  if (!latitude || !longitude || (*latitude == 0.0 && *longitude == 0.0)) return std::nullopt;
  if (std::abs(*latitude) > 90.0 || std::abs(*longitude) > 360.0) return std::nullopt;
  return PictureFacts::Place{*latitude, *longitude, source};
}

// "2023:06:01 12:00:00" to the month.
std::optional<double> YearOf(const std::string& date) {
  int year = 0;
  int month = 0;
  if (std::sscanf(date.c_str(), "%4d:%2d", &year, &month) != 2) return std::nullopt;
  if (year < 1900 || month < 1 || month > 12) return std::nullopt;
  return year + (month - 0.5) / 12.0;
}

void TakeExif(const ExifItems& exif, PictureFacts& facts) {
  facts.make = Text(exif.image, kMake);
  facts.camera = Text(exif.image, kModel);
  const double orientation = Number(exif.image, kOrientation).value_or(1.0);
  facts.orientation = orientation >= 1.0 && orientation <= 8.0 ? static_cast<int>(orientation) : 1;
  facts.year = YearOf(Text(exif.photo, kDateTimeOriginal));
  if (!facts.year) facts.year = YearOf(Text(exif.image, kDateTime));
  facts.zoom = Positive(exif.photo, kDigitalZoomRatio);
  facts.focal_mm = Positive(exif.photo, kFocalLength);
  facts.focal_35mm = Positive(exif.photo, kFocalLengthIn35mmFilm);
  facts.plane_width_px = Positive(exif.photo, kPixelXDimension);
  // Units: 2 inch, 3 centimetre, 4 millimetre; inch where it is not said.
  const double unit = Number(exif.photo, kFocalPlaneResolutionUnit).value_or(2.0);
  const double mm = unit == 3.0 ? 10.0 : unit == 4.0 ? 1.0 : 25.4;
  if (const auto resolution = Positive(exif.photo, kFocalPlaneXResolution)) {
    facts.plane_px_per_mm = *resolution / mm;
  }
  facts.place = PlaceAt(Degrees(exif.gps, kGpsLatitude, kGpsLatitudeRef, 'S'),
                        Degrees(exif.gps, kGpsLongitude, kGpsLongitudeRef, 'W'),
                        "EXIF");
  facts.horizontal_error_m = Positive(exif.gps, kGpsHPositioningError);
  // References: 0 and 1 above and below sea level, 2 and 3 above and below the ellipsoid
  // (Exif 3.0).
  const double reference = Number(exif.gps, kGpsAltitudeRef).value_or(0.0);
  if (const auto altitude = Number(exif.gps, kGpsAltitude)) {
    facts.altitude_m = reference == 1.0 || reference == 3.0 ? -*altitude : *altitude;
    facts.altitude_above_ellipsoid = reference >= 2.0;
  }
  if (const auto heading = Number(exif.gps, kGpsImgDirection)) {
    PictureFacts::Direction direction;
    direction.heading_deg = WrapHeadingDeg(*heading);
    direction.magnetic = Text(exif.gps, kGpsImgDirectionRef) == "M";
    direction.source = "EXIF";
    facts.direction = direction;
  }
}

PictureFacts::Direction DirectionOf(const Eigen::Quaterniond& cam_from_world, const char* source) {
  const ViewAngles angles = ViewAnglesOf(cam_from_world);
  return {angles.heading_deg, false, angles.pitch_deg, angles.roll_deg, source};
}

// The gimbal's yaw from north, pitch up from the horizon (-90: straight down), then roll: the
// angles of ViewAngles.
void TakeDji(const XmpProperties& xmp, PictureFacts& facts) {
  const auto number = [&](const char* name) { return Number(xmp, kDji + std::string(name)); };
  const auto longitude = number("GpsLongitude");
  const auto misspelt = number("GpsLongtitude");  // by the makers
  if (const auto place =
          PlaceAt(number("GpsLatitude"), longitude ? longitude : misspelt, "DJI's XMP")) {
    facts.place = place;
  }
  if (const auto altitude = number("AbsoluteAltitude")) facts.altitude_m = altitude;
  facts.altitude_above_takeoff_m = number("RelativeAltitude");
  if (const auto focal = number("CalibratedFocalLength"); focal && *focal > 0.0) {
    facts.focal_px = focal;
  }
  const auto yaw = number("GimbalYawDegree");
  if (!yaw) return;
  const ViewAngles angles{
      *yaw, number("GimbalPitchDegree").value_or(0.0), number("GimbalRollDegree").value_or(0.0)};
  facts.direction = DirectionOf(CamFromWorld(angles), "DJI's XMP");
}

// Pix4D's body has x to the front, y to the right, z down; yaw, pitch, roll turn it about z, y, x.
// A camera at zero looks down with the picture's top to the front, so pitch = 90 looks ahead: DJI's
// pitch + 90. Source: Pix4D support, "How are yaw, pitch, roll defined?".
void TakePix4d(const XmpProperties& xmp, PictureFacts& facts) {
  const auto yaw = Pix4d(xmp, "Yaw");
  const auto pitch = Pix4d(xmp, "Pitch");
  const auto roll = Pix4d(xmp, "Roll");
  if (!yaw || !pitch || !roll) return;
  constexpr double kRadPerDeg = 0.017453292519943295;
  const Eigen::Matrix3d north_east_down_from_body =
      (Eigen::AngleAxisd(*yaw * kRadPerDeg, Eigen::Vector3d::UnitZ()) *
       Eigen::AngleAxisd(*pitch * kRadPerDeg, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(*roll * kRadPerDeg, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  Eigen::Matrix3d world_from_north_east_down;
  world_from_north_east_down << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  Eigen::Matrix3d body_from_cam;
  body_from_cam << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const Eigen::Matrix3d world_from_cam =
      world_from_north_east_down * north_east_down_from_body * body_from_cam;
  facts.direction =
      DirectionOf(Eigen::Quaterniond(world_from_cam.transpose()).normalized(), "Pix4D's XMP");
}

// Google's panorama schema on a picture that is none: compass heading of its centre.
void TakeGoogle(const XmpProperties& xmp, PictureFacts& facts) {
  const auto number = [&](const char* name) { return Number(xmp, kPano + std::string(name)); };
  const auto heading = number("PoseHeadingDegrees");
  if (!heading) return;
  PictureFacts::Direction direction;
  direction.heading_deg = WrapHeadingDeg(*heading);
  direction.pitch_deg = number("PosePitchDegrees");
  direction.roll_deg = number("PoseRollDegrees");
  direction.source = "Google's XMP";
  facts.direction = direction;
}

}  // namespace

PictureFacts FactsOf(const ExifItems& exif, const XmpProperties& xmp) {
  PictureFacts facts;
  TakeExif(exif, facts);
  TakeGoogle(xmp, facts);
  TakePix4d(xmp, facts);
  TakeDji(xmp, facts);
  return facts;
}

PictureFacts ReadPictureFacts(const std::filesystem::path& path) {
  const PictureBlocks blocks = ReadPictureBlocks(path);
  const XmpProperties xmp = ParseXmp(blocks.xmp);
  const auto projection = xmp.find(kPano + std::string("ProjectionType"));
  if (projection != xmp.end()) {
    throw InputError(path.string(),
                     "GPano:ProjectionType",
                     "an " + projection->second + " panorama",
                     "a picture of a camera with a lens (cut one out of the panorama)");
  }
  return FactsOf(ParseExif(blocks.exif), xmp);
}

bool OrientationSwapsSides(int orientation) { return orientation >= 5 && orientation <= 8; }

double OrientationRollDeg(int orientation) {
  switch (orientation) {
    case 3:
    case 4:
      return 180.0;
    case 5:
    case 6:
      return 90.0;
    case 7:
    case 8:
      return -90.0;
    default:
      return 0.0;
  }
}

}  // namespace ridgeline
