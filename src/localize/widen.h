// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "localize/pose_space.h"

namespace ridgeline {

// The searched parameters on or near whose limits an offset lies, in words with the limit ("pitch
// (8 deg)"). Fixed parameters, and the whole circle of headings, have no limit.
std::vector<std::string> LimitsReached(const PoseSpace::Offset& offset, const PoseSpace& space);

// Whether the offset lies on the border of the searched area or of the searched headings: the truth
// is likely beyond.
bool IsOnBorder(const PoseSpace::Offset& offset, const PoseSpace& space);

// A box that reaches further, since the truth is not in this one: in position where `everywhere`,
// with any heading, else in the parameters on whose limits the offset lies. Fixed parameters stay.
PoseSpaceOptions Widened(const PoseSpace& space, const PoseSpace::Offset& offset, bool everywhere);

// "within 40 m, any heading" and the like.
std::string WordsOf(const PoseSpaceOptions& ranges);

}  // namespace ridgeline
