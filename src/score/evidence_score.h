// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "score/cue_table.h"
#include "score/line_likelihood.h"
#include "score/score.h"

namespace ridgeline {

// Weighted sum of the cues of the table: the log-linear model P(pose) ~ exp(sum of w_k cue_k) over
// the poses of a search, whose weights are those of the highest likelihood of the true poses of the
// dev queries. The edges' cues are the score by edge types: each kind is weighted by how often it
// is seen in pictures, as a likelihood against lines at random; there is no other of that name.
class EvidenceScore final : public Score {
 public:
  // Picture and scene must outlive the score. Cues whose names are not in `weights`, or have the
  // weight 0, are left out.
  EvidenceScore(const CueContext& context, const std::map<std::string, double>& weights);

  ViewParts parts() const override;
  const char* unusable() const override;
  std::unique_ptr<Score::Workspace> NewWorkspace() const override;
  double LogRatio(const PositionView& view,
                  const Pose& cam_from_local,
                  Score::Workspace& workspace) const override;
  void LogRatios(const PositionView& view,
                 std::span<const Pose> poses,
                 Score::Workspace& workspace,
                 std::span<double> log_ratios) const override;
  std::vector<BuildingFit> BuildingFits(const PositionView& view,
                                        const Pose& cam_from_local,
                                        Score::Workspace& workspace) const override;
  std::unique_ptr<Score> Tolerant(double factor) const override;
  std::unique_ptr<Score> ForTilts(std::span<const Eigen::Matrix3f> cam_from_level) const override;

  // Names of the cues' values, and the values of a pose, without their weights; valid until the
  // next use of the workspace.
  std::vector<std::string> cue_names() const;
  std::span<const float> Cues(const PositionView& view,
                              const Pose& cam_from_local,
                              Score::Workspace& workspace) const;
  // The same for many orientations at the place of one view: a row of values for each.
  void CuesOfMany(const PositionView& view,
                  std::span<const Pose> poses,
                  Score::Workspace& workspace,
                  std::span<float> rows) const;

 private:
  struct Part {
    const CuePlugin* plugin = nullptr;
    std::shared_ptr<const Cue> cue;
    std::size_t first = 0;  // of its values
  };
  struct Memory;

  // This score with the cues that `change` makes of its own; null: as they are.
  std::unique_ptr<Score> With(
      const std::function<std::shared_ptr<const Cue>(const Cue&)>& change) const;
  double LogRatioOfOne(const PositionView& view,
                       const Pose& cam_from_local,
                       Memory& memory) const;
  // Asks the cues that take many poses at once.
  void AskForMany(const PositionView& view, std::span<const Pose> poses, Memory& memory) const;
  void ReadPose(const Pose& cam_from_local, const PositionView& view, Memory& memory) const;

  const PictureEvidence& picture_;
  const Scene& scene_;
  LineLikelihoodOptions lines_;
  std::vector<double> edge_weights_;  // by kind of edge
  std::vector<Part> parts_;
  std::vector<double> weights_;  // of the values
};

}  // namespace ridgeline
