// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <system_error>

#include "base/angle.h"
#include "camera/facts_parts.h"
#include "camera/pose.h"

namespace ridgeline {
namespace {

std::optional<double> NumberOf(std::string text) {
  text.erase(0, text.find_first_not_of(" +"));
  // Of programs in countries that write a comma for the point.
  if (text.find('.') == std::string::npos) std::replace(text.begin(), text.end(), ',', '.');
  double value = 0.0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  // A second point or comma: not one number.
  if (end != last && (*end == '.' || *end == ',')) return std::nullopt;
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  // Pix4D writes heights and angles as fractions too.
  if (end != last && *end == '/') {
    double denominator = 0.0;
    std::from_chars(end + 1, last, denominator);
    value /= denominator;
    if (!std::isfinite(value)) return std::nullopt;
  }
  return value;
}

// The properties of one namespace.
class Schema {
 public:
  Schema(const XmpProperties& xmp, std::string space) : xmp_(xmp), space_(std::move(space)) {}

  std::optional<double> Number(const char* name) const {
    const auto it = xmp_.find(space_ + " " + name);
    return it == xmp_.end() ? std::nullopt : NumberOf(it->second);
  }
  std::string Text(const char* name) const {
    const auto it = xmp_.find(space_ + " " + name);
    return it == xmp_.end() ? std::string() : it->second;
  }

 private:
  const XmpProperties& xmp_;
  std::string space_;
};

// How a maker's three angles stand for the rotation from the camera to north, east, down.
enum class Convention {
  kLooksAhead,  // all zero: level, to the north (DJI, Parrot, Skydio, Autel)
  kLooksDown,   // all zero: straight down, the picture's top to the north (Pix4D, senseFly)
};

struct Angles {
  std::optional<double> yaw;
  std::optional<double> pitch;
  std::optional<double> roll;
};

// Yaw, pitch, roll turn the body (x to the front, y to the right, z down) about z, then y, then x.
Eigen::Quaterniond CamFromWorld(const Angles& angles, Convention convention) {
  const auto turn = [](double deg, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(deg * kRadPerDeg, axis);
  };
  const Eigen::Matrix3d north_east_down_from_body =
      (turn(*angles.yaw, Eigen::Vector3d::UnitZ()) *
       turn(angles.pitch.value_or(0.0), Eigen::Vector3d::UnitY()) *
       turn(angles.roll.value_or(0.0), Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  Eigen::Matrix3d world_from_north_east_down;
  world_from_north_east_down << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  Eigen::Matrix3d body_from_cam;
  if (convention == Convention::kLooksAhead) {
    body_from_cam << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  } else {
    body_from_cam << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  }
  const Eigen::Matrix3d world_from_cam =
      world_from_north_east_down * north_east_down_from_body * body_from_cam;
  return Eigen::Quaterniond(world_from_cam.transpose()).normalized();
}

// Why three angles cannot be meant; empty if they can.
std::string DoubtOf(const Angles& angles, const ViewAngles& view, Convention convention) {
  constexpr double kUpsideDownDeg = 135.0;
  // Nearer to the vertical a small turn past it is an upside-down picture.
  constexpr double kSteepDeg = 80.0;
  constexpr double kLargest = 720.0;
  const double pitch = angles.pitch.value_or(0.0);
  const double roll = angles.roll.value_or(0.0);
  if (std::abs(*angles.yaw) > kLargest || std::abs(pitch) > kLargest || std::abs(roll) > kLargest) {
    return "are no angles";
  }
  if (angles.pitch && *angles.yaw == 0.0 && pitch == 0.0 && roll == 0.0) {
    return "were never written, as it seems";
  }
  if (std::abs(view.roll_deg) <= kUpsideDownDeg || std::abs(view.pitch_deg) >= kSteepDeg) return "";
  const bool from_horizon = convention == Convention::kLooksDown && pitch < 0.0 && pitch >= -90.0;
  return FormatText("mean a camera that looks to %.0f deg upside down%s",
                    view.heading_deg,
                    from_horizon ? " (is the pitch from the horizon, as DJI writes it?)" : "");
}

void TakeAngles(const Angles& angles,
                Convention convention,
                const std::string& source,
                PictureFacts& facts) {
  if (!angles.yaw || facts.direction) return;
  const ViewAngles view = ViewAnglesOf(CamFromWorld(angles, convention));
  const std::string doubt = DoubtOf(angles, view, convention);
  if (!doubt.empty()) {
    facts.doubts.push_back(
        FormatText("heading, pitch, roll: yaw %.6g, pitch %.6g, roll %.6g in %s ",
                   *angles.yaw,
                   angles.pitch.value_or(0.0),
                   angles.roll.value_or(0.0),
                   source.c_str()) +
        doubt + "; taken as not told");
    return;
  }
  PictureFacts::Direction direction;
  direction.heading_deg = view.heading_deg;
  if (angles.pitch) {
    direction.pitch_deg = view.pitch_deg;
    direction.roll_deg = view.roll_deg;
  }
  direction.source = source;
  facts.direction = direction;
}

// The size whose middle is a calibrated principal point.
std::optional<PictureFacts::Size> SizeAround(std::optional<double> x, std::optional<double> y) {
  constexpr double kLeastPx = 50.0;
  if (!x || !y || *x < kLeastPx || *y < kLeastPx) return std::nullopt;
  return PictureFacts::Size{2.0 * *x, 2.0 * *y};
}

void TakeCalibration(std::optional<double> focal,
                     std::optional<double> x,
                     std::optional<double> y,
                     PictureFacts& facts) {
  if (!focal || !(*focal > 0.0) || *focal > 1e6 || facts.calibration) return;
  facts.calibration = PictureFacts::Calibration{*focal, SizeAround(x, y)};
}

void TakeHeights(const Schema& schema, PictureFacts& facts) {
  constexpr double kMostM = 20000.0;
  const auto height = [&](const char* name) {
    const auto value = schema.Number(name);
    return value && std::abs(*value) < kMostM ? value : std::nullopt;
  };
  if (!facts.altitude_above_takeoff_m) facts.altitude_above_takeoff_m = height("RelativeAltitude");
}

void TakeError(std::optional<double> metres, PictureFacts& facts) {
  if (metres && *metres > 0.0 && *metres < 1e5 && !facts.horizontal_error_m) {
    facts.horizontal_error_m = metres;
  }
}

// DJI's schema under its own namespace or another maker's (Autel): the gimbal's yaw from north,
// pitch up from the horizon (-90: straight down), then roll.
void TakeGimbal(const Schema& schema, const std::string& source, PictureFacts& facts) {
  const auto longitude = schema.Number("GpsLongitude");
  const auto misspelt = schema.Number("GpsLongtitude");  // by the makers
  if (!facts.place) {
    facts.place = PlaceAt(schema.Number("GpsLatitude"), longitude ? longitude : misspelt, source);
  }
  if (const auto altitude = schema.Number("AbsoluteAltitude"); altitude && !facts.altitude_m) {
    // With a reference station heights are above the ellipsoid.
    TakeAltitude(*altitude, schema.Text("AltitudeType") == "RtkAlt", source, facts);
  }
  TakeHeights(schema, facts);
  TakeCalibration(schema.Number("CalibratedFocalLength"),
                  schema.Number("CalibratedOpticalCenterX"),
                  schema.Number("CalibratedOpticalCenterY"),
                  facts);
  TakeAngles({schema.Number("GimbalYawDegree"),
              schema.Number("GimbalPitchDegree"),
              schema.Number("GimbalRollDegree")},
             Convention::kLooksAhead,
             source,
             facts);
}

// Every namespace with DJI's names, DJI's own first.
void TakeGimbals(const XmpProperties& xmp, PictureFacts& facts) {
  constexpr std::string_view kDji = "dji.com/drone-dji/1.0";
  TakeGimbal(Schema(xmp, std::string(kDji)), "DJI's XMP", facts);
  for (const auto& [key, value] : xmp) {
    const std::size_t blank = key.find(' ');
    if (blank == std::string::npos) continue;
    const std::string_view space = std::string_view(key).substr(0, blank);
    if (space == kDji) facts.from_aircraft = true;
    if (key.compare(blank + 1, std::string::npos, "GimbalYawDegree") != 0) continue;
    facts.from_aircraft = true;
    if (space == kDji) continue;
    TakeGimbal(Schema(xmp, std::string(space)), "the XMP of " + std::string(space), facts);
  }
}

// Parrot, "Embedded photo metadata": angles of the camera against north, east, down.
void TakeParrot(const XmpProperties& xmp, PictureFacts& facts) {
  const Schema schema(xmp, "parrot.com/drone-parrot/1.0");
  const Angles angles{schema.Number("CameraYawDegree"),
                      schema.Number("CameraPitchDegree"),
                      schema.Number("CameraRollDegree")};
  if (angles.yaw) facts.from_aircraft = true;
  TakeAngles(angles, Convention::kLooksAhead, "Parrot's XMP", facts);
}

// Skydio, "Camera and metadata overview": structures, heights above the ellipsoid.
void TakeSkydio(const XmpProperties& xmp, PictureFacts& facts) {
  const Schema schema(xmp, "skydio.com/drone-skydio/1.0");
  const Angles angles{schema.Number("CameraOrientationNED/Yaw"),
                      schema.Number("CameraOrientationNED/Pitch"),
                      schema.Number("CameraOrientationNED/Roll")};
  const auto relative = schema.Number("RelativeAltitude");
  if (angles.yaw || relative) facts.from_aircraft = true;
  if (!facts.place) {
    facts.place = PlaceAt(schema.Number("Latitude"), schema.Number("Longitude"), "Skydio's XMP");
  }
  if (const auto altitude = schema.Number("AbsoluteAltitude"); altitude && !facts.altitude_m) {
    TakeAltitude(*altitude, true, "Skydio's XMP", facts);
  }
  TakeHeights(schema, facts);
  TakeError(schema.Number("GpsHorizontalAccuracy"), facts);
  TakeCalibration(schema.Number("CalibratedFocalLength/X"),
                  schema.Number("CalibratedOpticalCenter/X"),
                  schema.Number("CalibratedOpticalCenter/Y"),
                  facts);
  TakeAngles(angles, Convention::kLooksAhead, "Skydio's XMP", facts);
}

// A camera at zero looks down with the picture's top to the front, so that pitch = 90 looks ahead:
// DJI's pitch + 90. Sources: Pix4D support, "How are yaw, pitch, roll defined?", "Specifications of
// xmp.camera tags".
void TakePix4d(const XmpProperties& xmp, PictureFacts& facts) {
  struct Space {
    const char* name;
    const char* source;
  };
  for (const Space& space : {Space{"pix4d.com/camera/1.0", "Pix4D's XMP"},
                             Space{"ns.sensefly.com/camera/1.0", "senseFly's XMP"}}) {
    const Schema schema(xmp, space.name);
    if (const auto height = schema.Number("AboveGroundAltitude");
        height && *height > 0.0 && *height < 20000.0 && !facts.height_above_ground_m) {
      facts.height_above_ground_m = height;
      facts.from_aircraft = true;
    }
    TakeError(schema.Number("GPSXYAccuracy"), facts);
    const Angles angles{schema.Number("Yaw"), schema.Number("Pitch"), schema.Number("Roll")};
    if (!angles.pitch || !angles.roll) continue;
    TakeAngles(angles, Convention::kLooksDown, space.source, facts);
  }
}

// Google's panorama schema on a picture that is none: compass heading of its centre; pitch up; with
// growing roll the horizon turns counterclockwise in the picture. Source: "Photo Sphere XMP
// metadata".
void TakeGoogle(const XmpProperties& xmp, PictureFacts& facts) {
  const Schema schema(xmp, "ns.google.com/photos/1.0/panorama");
  TakeAngles({schema.Number("PoseHeadingDegrees"),
              schema.Number("PosePitchDegrees"),
              schema.Number("PoseRollDegrees")},
             Convention::kLooksAhead,
             "Google's XMP",
             facts);
}

}  // namespace

void TakeXmp(const XmpProperties& xmp, PictureFacts& facts) {
  TakeGimbals(xmp, facts);
  TakeParrot(xmp, facts);
  TakeSkydio(xmp, facts);
  TakePix4d(xmp, facts);
  TakeGoogle(xmp, facts);
}

}  // namespace ridgeline
