// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/options.h"
#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "projection/scene.h"
#include "score/skyline_l1.h"

namespace ridgeline {

// Which variables a match moves (Ayadi et al., sections 6.2 and 6.3).
enum class SkylineMatch : std::uint8_t {
  k2d,    // shift and turn of the virtual skyline in the image, converted to angles
  k2x2d,  // the same twice, with a new virtual skyline in between
  k3d,    // heading, pitch, roll
  k6dof,  // position too, with the height fixed or free
};

struct SkylineMatchOptions {
  // "2d", "2x2d", "3d" or "6dof".
  std::string method = "3d";
  // Shifts in the image become angles by the field of view per pixel, as in the paper, rather than
  // by the arctangent.
  bool linear_angles = false;
  // Headings and pitches around the start that are tried on a grid before the simplex, so that it
  // begins in the right valley [deg]; 0: the simplex alone, as in the paper.
  double scan_heading_deg = 15.0;
  double scan_pitch_deg = 3.0;
  double scan_step_deg = 1.5;
  // Steps of the first round of the simplex.
  double heading_step_deg = 3.0;
  double pitch_step_deg = 2.0;
  double roll_step_deg = 1.5;
  double position_step_m = 4.0;
  double height_step_m = 1.0;
  // Rounds, and what the steps are multiplied by from one to the next.
  int rounds = 3;
  double shrink = 0.35;
  // Evaluations of one round at most.
  int max_evaluations = 80;
  // 6dof: whether the height is a variable.
  bool free_height = false;
  // What the sensors are worth: a deviation from the start by these costs sensor_weight_px more
  // [px at 640], by twice as much four times that. Keeps variables that the skyline does not
  // determine near the start. 0: the distance alone, as in the paper.
  double sensor_weight_px = 0.5;
  double heading_sigma_deg = 10.0;
  double tilt_sigma_deg = 1.0;
  double position_sigma_m = 6.0;
  double height_sigma_m = 1.0;
  // Distance at which a match is believed [px at 640], and by how much it may leave the start.
  double max_distance_px = 8.0;
  // A match is ambiguous if a heading more than scan_step_deg * 2 away on the grid is no worse than
  // this many times the best distance, both increased by 1 px.
  double ambiguous_ratio = 1.15;
  // So is one whose heading is known no better than this, standard deviation [deg].
  double max_heading_sigma_deg = 1.25;
  double max_heading_deg = 30.0;
  double max_tilt_deg = 12.0;
  double max_shift_m = 20.0;

  void Visit(OptionVisitor& v);
};

// Throws InputError for another name.
SkylineMatch SkylineMatchNamed(const std::string& name);
// "2d", "2x2d", "3d" or "6dof".
const char* NameOf(SkylineMatch method);

enum class SkylineMatchStatus : std::uint8_t {
  kOk,
  kUnusable,      // no sky, or a skyline known in too few columns
  kNoModel,       // no building reaches above the horizon in this direction
  kFarFromStart,  // the best pose is as far from the start as the limits allow
  kPoorMatch,     // the skylines differ by more than max_distance_px
  kAmbiguous,     // another heading fits as well, or the skyline does not tell it
};

// "ok", "unusable", "no_model", "far_from_start", "poor_match", "ambiguous".
const char* NameOf(SkylineMatchStatus status);

struct SkylineMatchResult {
  SkylineMatchStatus status = SkylineMatchStatus::kUnusable;
  std::string reason;        // in words, unless kOk
  std::optional<Pose> pose;  // cam_from_local; absent unless kOk
  Pose best;                 // the best pose found, believed or not; the start if none was sought
  double distance_before_px = 0.0;  // [px at 640]
  double distance_after_px = 0.0;
  double heading_sigma_deg = 0.0;  // of `best`; 0 if none was sought
  int evaluations = 0;
};

// Gives the virtual skyline seen from a position (local frame) within a sector.
using SkylineSource =
    std::function<std::vector<Eigen::Vector3f>(const Eigen::Vector3d& position, const Sector&)>;

// L1 distance at a pose [px at 640].
double DistanceAt(const SkylineL1& real,
                  const SkylineSource& source,
                  const Pose& pose,
                  const SkylineMatchOptions& options);

// Corrects a pose so that the virtual skyline lies on the real one: the least L1 distance by the
// downhill simplex.
SkylineMatchResult MatchSkyline(const SkylineL1& real,
                                const SkylineSource& source,
                                const Pose& start,
                                const SkylineMatchOptions& options);

}  // namespace ridgeline
