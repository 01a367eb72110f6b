// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "track/motion.h"

namespace ridgeline {

// Odometry of a file: poses one after the other, in a frame of their own.
struct Odometry {
  struct Row {
    std::string id;  // of the frame; empty: the format has none
    std::optional<double> time_s;
    Pose pose;              // in the file's own world and axes
    Motion since_row;       // since the row before, with its deviations
  };
  std::string file;
  std::string format;  // "CSV", "TUM" or "KITTI"
  std::vector<Row> rows;
};

// Reads odometry, whose format its lines show:
// - CSV with a header: id, time_s, dx_m, dy_m, dz_m, qw, qx, qy, qz, sigma_m, sigma_deg. Each row is
//   the pose of a frame in the axes of the frame before: its projection centre and the rotation
//   before_from_now. id or time_s is needed; the deviations may be absent.
// - TUM: "timestamp tx ty tz qx qy qz qw", world_from_camera.
// - KITTI: twelve numbers a line, the upper rows of world_from_camera.
// Axes are taken to be the camera's; the tracker finds out where they are not. Throws InputError
// naming file and line for what is not a number, rotations that are none, and times that fall.
Odometry ReadOdometry(const std::filesystem::path& path);

// A frame to which odometry is matched.
struct FrameKey {
  std::string id;
  std::optional<double> time_s;
};

// The motion to each frame from the one before: by id, else by time (between rows in proportion),
// else by order where there are as many rows as frames, or one less. The first has none.
struct FrameMotion {
  std::optional<Motion> motion;
  std::string missing;  // why there is none, in words
};
std::vector<FrameMotion> MotionsOf(const Odometry& odometry, std::span<const FrameKey> frames);

}  // namespace ridgeline
