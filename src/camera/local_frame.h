// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "camera/pose.h"

namespace ridgeline {

// The frame of a model: world minus an origin [m], in which numbers are small; the axes are the
// same.
struct LocalFrame {
  Eigen::Vector3d origin_in_world;

  Pose FromWorld(const Pose& cam_from_world) const {
    return {cam_from_world.cam_from_world, cam_from_world.center_in_world - origin_in_world};
  }
  Pose ToWorld(const Pose& cam_from_local) const {
    return {cam_from_local.cam_from_world, cam_from_local.center_in_world + origin_in_world};
  }
};

}  // namespace ridgeline
