// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "input/dataset.h"

namespace ridgeline {

// What is doubtful about the poses of an input of another program, a line each: pictures that are
// upside down (another convention of the angles, or other camera axes), poses that were never
// written (at the origin, or not turned), positions that look like degrees, pictures that all stand in
// one place, and pictures that all look down with north up (angles in radians). Empty: nothing.
//
// @param origin  What was added to the positions.
std::vector<std::string> DoubtsOf(const Dataset& dataset, const Eigen::Vector3d& origin);

// Throws InputError for a pose of an input that is in no world: see CheckPlace.
void CheckPoses(const Dataset& dataset);

}  // namespace ridgeline
