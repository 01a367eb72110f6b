// SPDX-License-Identifier: Apache-2.0
#include "input/prior_pose.h"

#include <cstdio>

namespace ridgeline {

std::optional<Pose> PoseOfPrior(const PosePrior& prior,
                                const HeightGrid* terrain,
                                const Eigen::Vector3d& origin_in_world,
                                double camera_height_m) {
  std::optional<double> height = prior.height_in_world;
  if (!height && terrain != nullptr) {
    const std::optional<double> ground =
        terrain->HeightAt(prior.position_in_world - origin_in_world.head<2>());
    if (ground) height = origin_in_world.z() + *ground + camera_height_m;
  }
  if (!height) return std::nullopt;
  Pose pose;
  pose.center_in_world = {prior.position_in_world.x(), prior.position_in_world.y(), *height};
  pose.cam_from_world = CamFromWorld(ViewAngles{prior.heading_deg.value_or(0.0),
                                                prior.pitch_deg.value_or(0.0),
                                                prior.roll_deg.value_or(0.0)});
  return pose;
}

std::vector<Assumption> AssumptionsOf(const PosePrior& prior,
                                      double camera_height_m,
                                      const std::string& source) {
  std::vector<Assumption> assumptions;
  if (!prior.height_in_world) {
    char text[64];
    std::snprintf(text, sizeof text, "terrain + %.1f m assumed", camera_height_m);
    assumptions.push_back({"height", text, source});
  }
  if (!prior.heading_deg) {
    assumptions.push_back({"heading", "not given; all directions are searched", source});
  }
  if (!prior.pitch_deg && !prior.roll_deg) {
    assumptions.push_back({"pitch, roll", "not given; held level assumed", source});
  } else if (!prior.pitch_deg) {
    assumptions.push_back({"pitch", "not given; level assumed", source});
  } else if (!prior.roll_deg) {
    assumptions.push_back({"roll", "not given; upright assumed", source});
  }
  return assumptions;
}

}  // namespace ridgeline
