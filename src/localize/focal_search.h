// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "camera/focal_length.h"
#include "localize/localization.h"
#include "score/picture_evidence.h"

namespace ridgeline {

// Localizes with every focal length that a picture may have, the most plausible first, and takes
// another where it explains the picture better by three nats (log likelihood ratio, with the doubt
// of the focal length as its prior). The reading taken is then tried one standard deviation up and
// down, and on in the better direction.
//
// @param hypotheses  The first is that of the picture's camera; empty: it is known, one search.
Localization WithBestFocal(const PictureEvidence& picture,
                           const std::vector<FocalHypothesis>& hypotheses,
                           const std::function<Localization(const PictureEvidence&)>& localize);

}  // namespace ridgeline
