// SPDX-License-Identifier: Apache-2.0
#include "localize/make_score.h"

#include "score/evidence_score.h"
#include "score/line_energy_score.h"

namespace ridgeline {

std::unique_ptr<Score> MakeScore(const ScoreOptions& options,
                                 const PictureEvidence& evidence,
                                 const cv::Mat& /*bgr*/,
                                 const Scene& scene) {
  if (options.name == "line_energy") {
    return std::make_unique<LineEnergyScore>(
        evidence.segments(), evidence.camera(), options.line_energy);
  }
  return std::make_unique<EvidenceScore>(evidence, scene.model(), options.weights);
}

}  // namespace ridgeline
