// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "track/tracker.h"

namespace ridgeline {

struct SmootherOptions {
  // Of the causal covariances that a smoothed one is never below: frames share errors of the model
  // that no number of them averages out [m, deg].
  double floor_m = 0.1;
  double floor_deg = 0.1;
  // Factor on the deviations of the pictures' evidence, whose errors are alike from frame to frame.
  double evidence_factor = 1.5;

  void Visit(OptionVisitor& v);
};

struct SmoothedPose {
  Pose pose;  // world
  PoseCovariance covariance = PoseCovariance::Zero();
};

// The whole trajectory at once: least squares (Ceres) over the frames between which a motion is
// known, with the odometry and, of each look, the bell of the picture's own evidence that lies
// nearest to the trajectory; both robust (Cauchy), so that frames that lie are outvoted. Bells are
// chosen again in rounds, beginning with the frames that were tracked. Frames outside of a stretch
// that was tracked somewhere have none.
// @param origin_in_world  Of the local frame.
std::vector<std::optional<SmoothedPose>> Smooth(std::span<const TrackFrame> frames,
                                                const Eigen::Vector3d& origin_in_world,
                                                const SmootherOptions& options);

}  // namespace ridgeline
