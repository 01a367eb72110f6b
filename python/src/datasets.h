// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include "camera/pose_prior.h"

namespace ridgeline::python {

// A prior of a Prior, or of a Pose all of which is meant. Throws InputError.
PosePrior PriorOf(pybind11::handle value);

}  // namespace ridgeline::python
