// SPDX-License-Identifier: Apache-2.0
#include "localize/make_score.h"

#include "score/evidence_score.h"
#include "score/gradient_score.h"
#include "score/line_energy_score.h"
#include "score/oriented_chamfer_score.h"
#include "score/skyline_l1_score.h"
#include "score/unexplained_score.h"
#include "score/zbuffer_line_energy_score.h"
#include "skyline/skyline_extractor.h"

namespace ridgeline {

std::unique_ptr<Score> MakeScore(const ScoreOptions& options,
                                 const PictureEvidence& evidence,
                                 const cv::Mat& bgr,
                                 const PinholeCamera& camera,
                                 const Scene& scene,
                                 double tolerance_factor) {
  if (options.name == "line_energy") {
    return std::make_unique<LineEnergyScore>(
        evidence.segments(), evidence.camera(), options.line_energy);
  }
  if (options.name == "line_energy_zbuffer") {
    return std::make_unique<ZbufferLineEnergyScore>(evidence.segments(), evidence.camera(),
                                                    scene.model(), options.line_energy,
                                                    options.zbuffer_hough);
  }
  if (options.name == "skyline_l1") {
    const Skyline skyline = ExtractSkyline(bgr, options.skyline);
    return std::make_unique<SkylineL1Score>(SkylineL1(skyline, camera, options.skyline_l1));
  }
  if (options.name == "oriented_chamfer") {
    return std::make_unique<OrientedChamferScore>(
        evidence.field(), evidence.camera(), options.oriented_chamfer);
  }
  if (options.name == "gradient") {
    return std::make_unique<GradientScore>(bgr, evidence.camera(), options.gradient);
  }
  if (options.name == "unexplained") {
    return std::make_unique<UnexplainedScore>(
        evidence.segments(), evidence.field(), evidence.camera(), options.unexplained);
  }
  return std::make_unique<EvidenceScore>(evidence, scene.model(), options.weights,
                                         tolerance_factor);
}

}  // namespace ridgeline
