// SPDX-License-Identifier: Apache-2.0
// The kinds of edges, one value each: the line likelihood (line_likelihood.h, with the source) of
// the visible edges of that kind.
#include "score/cue.h"
#include "score/line_likelihood.h"

namespace ridgeline {
namespace {

// How edges are compared on a grid of places.
struct Coarseness {
  double tolerance = 1.0;  // of the model's errors
  float spacing = 1.0f;    // of the samples along an edge: one stands for so many
};

class EdgeCues final : public Cue {
 public:
  EdgeCues(const PictureEvidence& picture,
           const LineLikelihoodOptions& options,
           const Coarseness& coarseness)
      : picture_(picture),
        options_(options),
        sample_weight_(coarseness.spacing),
        likelihood_(picture.field(), picture.camera(), Coarser(options, coarseness)) {}

  void LogRatios(const CuePose& pose,
                 Workspace* /*workspace*/,
                 std::span<float> log_ratios) const override {
    const auto by_kind = likelihood_.LogRatios(pose.segments, pose.view.kinds);
    for (std::size_t k = 0; k < by_kind.size(); ++k) log_ratios[k] = sample_weight_ * by_kind[k];
  }

  // With the tolerance of a coarse grid neighbouring samples say the same: every second will do.
  std::shared_ptr<const Cue> Tolerant(double factor) const override {
    constexpr double kWide = 3.0;
    return std::make_shared<EdgeCues>(
        picture_, options_, Coarseness{factor, factor >= kWide ? 2.0f : 1.0f});
  }

 private:
  static LineLikelihoodOptions Coarser(LineLikelihoodOptions options,
                                       const Coarseness& coarseness) {
    options.sigma_model_m *= coarseness.tolerance;
    options.spacing_width *= coarseness.spacing;
    return options;
  }

  const PictureEvidence& picture_;
  LineLikelihoodOptions options_;
  float sample_weight_;
  LineLikelihood likelihood_;
};

// In the order of EdgeKind.
constexpr CueName kNames[kEdgeKinds] = {{"skyline_edges", 0.097},
                                        {"occlusions", 0.077},
                                        {"folds", 0.039},
                                        {"ground_lines", 0.147},
                                        {"seams", 0.279}};

}  // namespace

extern const CuePlugin kEdgeCues;
constinit const CuePlugin kEdgeCues = {
    .names = kNames,
    .parts = {.edges_and_skyline = true, .surfaces = false},
    .declare = [](OptionGroups& options) { options.Add<LineLikelihoodOptions>("lines"); },
    .make = [](const CueContext& c) -> std::shared_ptr<const Cue> {
      return std::make_shared<EdgeCues>(
          c.picture, c.options.Get<LineLikelihoodOptions>(), Coarseness{});
    }};

}  // namespace ridgeline
