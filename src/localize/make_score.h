// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>

#include "camera/intrinsics.h"
#include "localize/localizer_options.h"
#include "score/score.h"

namespace ridgeline {

// The score that the options name, for one picture. `evidence` and `scene` must outlive it.
// @param tolerance_factor  > 1: more tolerant of the model's errors, for coarse grids.
// @param bgr  The undistorted picture at full size, `camera` its camera.
std::unique_ptr<Score> MakeScore(const ScoreOptions& options,
                                 const PictureEvidence& evidence,
                                 const cv::Mat& bgr,
                                 const PinholeCamera& camera,
                                 const Scene& scene,
                                 double tolerance_factor);

}  // namespace ridgeline
