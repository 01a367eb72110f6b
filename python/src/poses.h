// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "camera/pose.h"

PYBIND11_MAKE_OPAQUE(std::vector<ridgeline::Pose>);

namespace ridgeline::python {

// Many poses in the world frame; arrays of them are views of this memory.
using PoseList = std::vector<Pose>;

// Poses of what Python code gives for them: Poses, a Pose, or a list of Pose. Throws InputError.
std::shared_ptr<const PoseList> PosesOf(pybind11::handle value, const std::string& name = "poses");

// A pose of a Pose, or of an object in pycolmap's words (rotation.quat, translation). Throws
// InputError.
Pose PoseOf(pybind11::handle value, const std::string& name = "pose");

// Copies in another frame: centre minus `origin`.
PoseList Shifted(std::span<const Pose> poses, const Eigen::Vector3d& origin);

// (n, 4) float64 x, y, z, w and (n, 3) float64, without a copy; `owner` keeps the poses alive.
pybind11::array QuaternionsOf(std::span<const Pose> poses, pybind11::handle owner);
pybind11::array CentersOf(std::span<const Pose> poses, pybind11::handle owner);

}  // namespace ridgeline::python
