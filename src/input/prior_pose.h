// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "camera/pose.h"
#include "camera/pose_prior.h"
#include "city/city_model.h"
#include "city/terrain.h"
#include "input/assumption.h"

namespace ridgeline {

// The prior as a pose in the world frame: what it leaves open is level, to the north, and
// `camera_height_m` above the terrain. nullopt: the height is open, and there is no terrain at the
// place.
//
// @param terrain  In the local frame of `origin_in_world`; null: none.
std::optional<Pose> PoseOfPrior(const PosePrior& prior,
                                const HeightGrid* terrain,
                                const Eigen::Vector3d& origin_in_world,
                                double camera_height_m);

// What is assumed for the parts that a prior leaves open, as the search takes them.
// @param source  File that the prior is from.
std::vector<Assumption> AssumptionsOf(const PosePrior& prior,
                                      double camera_height_m,
                                      const std::string& source);

// Whether a position can only be a latitude and a longitude: no projected system's numbers are as
// small.
bool IsInDegrees(const PosePrior& prior);

// Throws InputError if a prior's position is in degrees where the system has metres, with what it
// would be in the system.
// @param source  File that the prior is from.
void CheckPosition(const PosePrior& prior, const Crs& crs, const std::string& source);

}  // namespace ridgeline
