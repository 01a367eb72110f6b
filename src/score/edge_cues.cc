// SPDX-License-Identifier: Apache-2.0
// The kinds of edges, one value each: the line likelihood (line_likelihood.h, with the source) of
// the visible edges of that kind.
#include <algorithm>

#include "score/cue.h"
#include "score/line_likelihood.h"

namespace ridgeline {
namespace {

class EdgeCues final : public Cue {
 public:
  EdgeCues(const PictureEvidence& picture, const LineLikelihoodOptions& options, double tolerance)
      : picture_(picture),
        options_(options),
        likelihood_(picture.field(), picture.camera(), WithTolerance(options, tolerance)) {}

  void LogRatios(const CuePose& pose,
                 Workspace* /*workspace*/,
                 std::span<float> log_ratios) const override {
    const auto by_kind = likelihood_.LogRatios(pose.segments, pose.view.kinds);
    std::copy(by_kind.begin(), by_kind.end(), log_ratios.begin());
  }

  std::shared_ptr<const Cue> Tolerant(double factor) const override {
    return std::make_shared<EdgeCues>(picture_, options_, factor);
  }

 private:
  static LineLikelihoodOptions WithTolerance(LineLikelihoodOptions options, double factor) {
    options.sigma_model_m *= factor;
    return options;
  }

  const PictureEvidence& picture_;
  LineLikelihoodOptions options_;
  LineLikelihood likelihood_;
};

// In the order of EdgeKind.
constexpr CueName kEdgeNames[kEdgeKinds] = {{"skyline_edges", 0.097},
                                            {"occlusions", 0.077},
                                            {"folds", 0.039},
                                            {"ground_lines", 0.147},
                                            {"seams", 0.279}};

}  // namespace

extern const CuePlugin kEdgeCues;
constinit const CuePlugin kEdgeCues = {
    .names = kEdgeNames,
    .parts = {.edges_and_skyline = true, .surfaces = false},
    .declare = [](OptionGroups& options) { options.Add<LineLikelihoodOptions>("lines"); },
    .make = [](const CueContext& c) -> std::shared_ptr<const Cue> {
      return std::make_shared<EdgeCues>(c.picture, c.options.Get<LineLikelihoodOptions>(), 1.0);
    }};

}  // namespace ridgeline
