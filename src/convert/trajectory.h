// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "input/dataset.h"

namespace ridgeline {

// The truths of a dataset in order as a TUM trajectory: "timestamp tx ty tz qx qy qz qw", positions
// in the dataset's system and world_from_cam, numbers exact. Pictures without a time count seconds
// from 0; comments name them. Source: cvg.cit.tum.de, RGB-D benchmark, file formats.
std::string TumTrajectory(const Dataset& dataset);

}  // namespace ridgeline
