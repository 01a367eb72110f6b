// SPDX-License-Identifier: Apache-2.0
#include "score/evidence_score.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace ridgeline {

EvidenceScore::EvidenceScore(const PictureEvidence& evidence,
                             const CityModel& model,
                             const std::vector<double>& weights,
                             double tolerance_factor)
    : evidence_(evidence), model_(model), lines_(evidence.Lines(tolerance_factor)) {
  assert(weights.size() == weights_.size());
  std::copy(weights.begin(), weights.end(), weights_.begin());
}

double EvidenceScore::LogRatio(const PositionView& view,
                               const Pose& cam_from_local,
                               PictureEvidence::Workspace& workspace) const {
  constexpr double kNothing = -std::numeric_limits<double>::infinity();
  if (evidence_.is_blank()) return kNothing;
  const CueVector cues = evidence_.Cues(view, model_, cam_from_local, lines_, workspace);
  if (workspace.segments.empty()) return kNothing;
  double sum = 0.0;
  for (int k = 0; k < kCues; ++k) sum += weights_[k] * cues[k];
  return sum;
}

}  // namespace ridgeline
