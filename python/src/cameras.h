// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "camera/intrinsics.h"

namespace ridgeline::python {

// A camera of what Python code gives for one: a Camera, or an object with COLMAP's words (model,
// width, height, params), such as a pycolmap.Camera. Throws InputError.
CameraIntrinsics CameraOf(pybind11::handle value, const std::string& name = "camera");

}  // namespace ridgeline::python
