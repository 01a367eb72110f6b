// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "input/assumption.h"
#include "input/world.h"
#include "localize/localization.h"
#include "localize/pose_space.h"

namespace ridgeline::python {

// An answer, with what its words and numbers are about.
struct FoundPose {
  std::shared_ptr<const World> world;
  std::string picture;  // as pose.json names it
  std::vector<Assumption> assumptions;
  Localization result;
};

// A map for Python, which keeps it.
struct SharedMap {
  std::shared_ptr<const EnergyMap> map;
};

// Half-ranges of a search of a dict {"east_m": 10, ...} over `ranges`; None changes nothing. Throws
// InputError.
PoseSpaceOptions RangesOf(pybind11::handle value, const PoseSpaceOptions& ranges);

}  // namespace ridgeline::python
