// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "track/motion.h"

namespace ridgeline {

// Axes that odometry may be in: the camera's (x right, y down, z forward), a vehicle's (x forward, y
// left, z up; ROS REP 103), or photogrammetry's (x right, y up, z backward).
enum class OdometryAxes { kCamera, kBody, kPhoto };
inline constexpr std::array<OdometryAxes, 3> kOdometryAxes{
    OdometryAxes::kCamera, OdometryAxes::kBody, OdometryAxes::kPhoto};
// "camera", "body", "photo".
const char* NameOf(OdometryAxes axes);

// The motion in camera axes.
Motion InCameraAxes(const Motion& motion, OdometryAxes axes);

// Compares odometry with poses that pictures gave without it, and finds the axes and the scale under
// which the two agree.
class OdometryCheck {
 public:
  // The motion since the last call as the file has it; nullopt: not known, which ends the chain.
  void Add(const std::optional<Motion>& motion);
  // Where the camera is now by its picture alone (local).
  void Add(const Pose& found);

  struct Finding {
    OdometryAxes axes = OdometryAxes::kCamera;
    double scale = 1.0;  // on the odometry's lengths
    int agreeing = 0;    // poses on one trajectory of the odometry under it
  };
  // The axes and scale under which most poses lie on one trajectory; nullopt: too few do, or not
  // twice as many as with camera axes in scale 1.
  // @param scale_is_guessed  Scale 1 is nothing to hold on to: five poses are enough.
  std::optional<Finding> Find(bool scale_is_guessed = false) const;

 private:
  struct Place {
    Motion from_first;  // by odometry, file axes
    Pose found;
  };
  // Poses on the odometry's trajectory through one of them, this one included.
  int Agreeing(std::size_t from, OdometryAxes axes, double scale) const;

  Motion from_first_;
  std::vector<Place> places_;
};

}  // namespace ridgeline
