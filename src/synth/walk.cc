// SPDX-License-Identifier: Apache-2.0
#include "synth/walk.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/angle.h"
#include "base/random.h"

namespace ridgeline {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::uint64_t kWalkStage = 0x90;
// The walker keeps to the roadway, so far from the middle line [m].
constexpr double kOffMiddleM = 1.5;
// Steps per second.
constexpr double kStepRate = 1.9;

// The crossings a walk leads over: along one street, then into others, back and forth.
std::vector<Vector2d> Way(const Town& town, double length_m, Random& random) {
  const int columns = town.options.blocks_east;
  const int rows = town.options.blocks_north;
  int column = static_cast<int>(random.Below(static_cast<std::uint64_t>(columns + 1)));
  int row = 0;
  bool north = true;
  std::vector<Vector2d> way{town.Crossing(column, row)};
  double length = 0.0;
  int dx = column < columns ? 1 : -1, dy = 1;
  while (length < length_m) {
    // North and east by turns, turning back at the edges of the town.
    if (north) {
      if (row + dy < 0 || row + dy > rows) dy = -dy;
      row += dy;
    } else {
      if (column + dx < 0 || column + dx > columns) dx = -dx;
      column += dx;
    }
    north = !north;
    way.push_back(town.Crossing(column, row));
    length += (way.back() - way[way.size() - 2]).norm();
  }
  return way;
}

struct Place {
  Vector2d xy;
  double heading_rad = 0.0;  // of the walk
};

Place PlaceAt(const std::vector<Vector2d>& way, double distance_m) {
  std::size_t i = 0;
  double left = distance_m;
  while (i + 2 < way.size() && left > (way[i + 1] - way[i]).norm()) {
    left -= (way[i + 1] - way[i]).norm();
    ++i;
  }
  const Vector2d along = (way[i + 1] - way[i]).normalized();
  const Vector2d right(along.y(), -along.x());
  return {way[i] + left * along + kOffMiddleM * right, std::atan2(along.x(), along.y())};
}

// A smooth random function of time: three sines of random phase, of amplitude about 1.
class Sway {
 public:
  Sway(double period_s, Random& random) : period_s_(period_s) {
    for (double& phase : phases_) phase = random.Uniform(0.0, 2.0 * std::numbers::pi);
  }
  double At(double time_s) const {
    const double t = 2.0 * std::numbers::pi * time_s / period_s_;
    return 0.6 * std::sin(t + phases_[0]) + 0.3 * std::sin(1.7 * t + phases_[1]) +
           0.2 * std::sin(3.1 * t + phases_[2]);
  }

 private:
  double period_s_;
  double phases_[3] = {};
};

}  // namespace

void OdometryErrors::Visit(OptionVisitor& v) {
  v.Field("scale", scale, Positive());
  v.Field("noise_share", noise_share, NotNegative());
  v.Field("heading_noise_deg", heading_noise_deg, NotNegative());
  v.Field("drift_deg_s", drift_deg_s, AnyNumber());
}

void GnssTrouble::Visit(OptionVisitor& v) {
  v.Field("outage_from_s", outage_from_s, AnyNumber());
  v.Field("outage_to_s", outage_to_s, AnyNumber());
  v.Field("jump_at_s", jump_at_s, AnyNumber());
  v.Field("jump_m", jump_m, NotNegative());
  v.Field("spoof_from_s", spoof_from_s, AnyNumber());
  v.Field("spoof_m_s", spoof_m_s, NotNegative());
  v.Field("noise_m", noise_m, NotNegative());
}

WalkOptions DriveDefaults() {
  WalkOptions drive;
  drive.frames_per_second = 2.0;
  drive.width = 1280;
  drive.height = 720;
  drive.horizontal_fov_deg = 70.0;
  drive.speed_m_s = 8.0;
  drive.pitch_deg = 0.0;
  drive.eye_height_m = 2.0;
  drive.look_deg = 0.0;
  drive.hand_deg = 0.5;
  drive.bob_m = 0.0;
  drive.gnss_error_low_m = 0.0;
  drive.gnss_error_high_m = 4.0;
  drive.gnss.noise_m = 1.0;
  return drive;
}

WalkOptions FlightDefaults() {
  WalkOptions flight = DriveDefaults();
  flight.speed_m_s = 10.0;
  flight.pitch_deg = -35.0;
  flight.eye_height_m = 50.0;
  flight.hand_deg = 2.0;
  return flight;
}

void WalkOptions::Visit(OptionVisitor& v) {
  v.Group("town", [&](OptionVisitor& g) { town.Visit(g); });
  const int most_blocks = std::max(town.blocks_east, town.blocks_north);
  v.Rule("town.blocks_east",
         most_blocks <= 6,
         std::to_string(most_blocks),
         "at most 6 blocks each way");
  v.Field("frames", frames, Closed(1, 100000));
  v.Field("frames_per_second", frames_per_second, Positive());
  v.Field("width", width, Closed(64, 10000));
  v.Field("height", height, Closed(64, 10000));
  v.Field("horizontal_fov_deg", horizontal_fov_deg, Closed(20.0, 120.0));
  v.Field("jpeg_quality", jpeg_quality, Closed(1, 100));
  v.Field("speed_m_s", speed_m_s, NotNegative());
  v.Field("pitch_deg", pitch_deg, Closed(-45.0, 45.0));
  v.Field("overhang_m", overhang_m, NotNegative());
  v.Field("survey_sigma_m", survey_sigma_m, NotNegative());
  v.Field("compass_error_deg", compass_error_deg, NotNegative());
  v.Field("compass_noise_deg", compass_noise_deg, NotNegative());
  v.Field("declination_deg", declination_deg, Closed(-180.0, 180.0));
  v.Field("gnss_error_low_m", gnss_error_low_m, NotNegative());
  v.Field("gnss_error_high_m", gnss_error_high_m, AtLeast(gnss_error_low_m, "gnss_error_low_m"));
  v.Field("altitude_noise_m", altitude_noise_m, NotNegative());
  v.Field("altitude_jump_m", altitude_jump_m, NotNegative());
  v.Field("tilt_sigma_deg", tilt_sigma_deg, NotNegative());
  v.Field("acceleration_noise", acceleration_noise, NotNegative());
  v.Field("pressure_noise_hpa", pressure_noise_hpa, NotNegative());
  v.Field("gyro_bias", gyro_bias, NotNegative());
  v.Field("gyro_noise", gyro_noise, NotNegative());
  v.Field("eye_height_m", eye_height_m, Positive());
  v.Field("look_deg", look_deg, NotNegative());
  v.Field("hand_deg", hand_deg, NotNegative());
  v.Field("bob_m", bob_m, NotNegative());
  v.Group("odometry", [&](OptionVisitor& g) { odometry.Visit(g); });
  v.Group("gnss", [&](OptionVisitor& g) { gnss.Visit(g); });
}

std::vector<Pose> WalkPoses(const Town& town, const WalkOptions& options) {
  Random random(static_cast<std::uint64_t>(town.options.seed), kWalkStage);
  const double seconds = options.frames / options.frames_per_second;
  const std::vector<Vector2d> way = Way(town, seconds * options.speed_m_s + 1.0, random);
  // Looking around slowly, the hand's unrest, and the head's path from step to step.
  const Sway look(12.0, random), hand_heading(2.3, random), hand_pitch(1.9, random),
      hand_roll(2.7, random), side(3.1, random);
  std::vector<Pose> poses;
  for (int i = 0; i < options.frames; ++i) {
    const double t = i / options.frames_per_second;
    // Half a second of the way smooths the corners.
    Place place = PlaceAt(way, t * options.speed_m_s);
    const Place ahead = PlaceAt(way, (t + 1.5) * options.speed_m_s);
    const double turn =
        std::remainder(ahead.heading_rad - place.heading_rad, 2.0 * std::numbers::pi);
    const double heading_deg = (place.heading_rad + 0.5 * turn) * kDegPerRad +
                               options.look_deg * look.At(t) +
                               0.75 * options.hand_deg * hand_heading.At(t);
    const double bob = options.bob_m * std::sin(2.0 * std::numbers::pi * kStepRate * t);
    place.xy +=
        0.1 * side.At(t) * Vector2d(std::cos(place.heading_rad), -std::sin(place.heading_rad));
    Pose pose;
    pose.center_in_world = {
        place.xy.x(), place.xy.y(), town.TerrainHeight(place.xy) + options.eye_height_m + bob};
    pose.cam_from_world = CamFromWorld(ViewAngles{WrapHeadingDeg(heading_deg),
                                                  options.pitch_deg + options.hand_deg * hand_pitch.At(t),
                                                  options.hand_deg * hand_roll.At(t)});
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace ridgeline
