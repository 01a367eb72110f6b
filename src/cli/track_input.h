// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "camera/pose_prior.h"
#include "city/city_model.h"
#include "city/terrain.h"
#include "cli/frame_source.h"
#include "input/dataset.h"
#include "track/odometry_file.h"
#include "track/sensors.h"

namespace ridgeline {

// A drive, named on the command line.
struct TrackArguments {
  std::string input;  // dataset.json, its folder, a folder of pictures, a film, or "-"
  std::vector<std::string> model;
  std::string dtm;
  std::string crs;
  std::string camera;
  std::string odometry;
  std::string sensors;
  std::string prior;
  bool follow = false;  // the folder grows
  double idle_s = 10.0;
};

// What is known of a frame before its picture is looked at.
struct TrackFrameFacts {
  std::string id;
  std::optional<double> time_s;
  std::optional<CameraIntrinsics> camera;
  std::optional<Motion> motion;
  std::string motion_missing;
  std::optional<double> heading_deg;  // grid
  std::optional<double> pitch_deg;
  std::optional<double> roll_deg;
  std::optional<double> speed_m_s;
  std::optional<Eigen::Vector2d> fix;  // world
  std::optional<Pose> truth;           // world
};

// The frames of a drive, one after the other: those of a list, or as they come.
class TrackFrames {
 public:
  virtual ~TrackFrames() = default;
  // False: there are no more. An empty picture is missing.
  virtual bool Next(TrackFrameFacts& facts, cv::Mat& picture) = 0;
  virtual std::optional<std::size_t> size() const { return std::nullopt; }
  virtual std::optional<double> frames_per_second() const { return std::nullopt; }
};

struct TrackWorld {
  CityModel model;
  std::optional<HeightGrid> dtm;
  PosePrior start;
  std::string start_from;  // "the first frame's prior" and the like
  std::unique_ptr<TrackFrames> frames;
  bool has_odometry = false;
  std::vector<std::string> warnings;
};

// Throws InputError for anything missing or unreadable; frames without a picture, without motion or
// without sensors are no error.
std::unique_ptr<TrackWorld> ReadTrack(const TrackArguments& arguments,
                                      const SensorOptions& sensors,
                                      int threads);

}  // namespace ridgeline
