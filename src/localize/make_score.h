// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>

#include "localize/localizer_options.h"
#include "score/score.h"

namespace ridgeline {

// The score that the options name, for one picture. `evidence` and `scene` must outlive it.
// bgr: the undistorted picture at full size.
std::unique_ptr<Score> MakeScore(const ScoreOptions& options,
                                 const PictureEvidence& evidence,
                                 const cv::Mat& bgr,
                                 const Scene& scene);

}  // namespace ridgeline
