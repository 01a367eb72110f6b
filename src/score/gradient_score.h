// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "base/options.h"
#include "camera/intrinsics.h"
#include "score/score.h"

namespace ridgeline {

struct GradientScoreOptions {
  // Width of the smoothing before the gradient [share of the picture's width]: how far beside a
  // line an edge still feels it.
  double sigma_width = 0.003;
  // Spacing of samples along an edge [share of the picture's width].
  double spacing_width = 0.004;

  void Visit(OptionVisitor& v) {
    v.Field("sigma_width", sigma_width, Positive());
    v.Field("spacing_width", spacing_width, Positive());
  }
};

// Gradient of the picture across the projected edges: at each sample the share of all gradients of
// the picture (pixels and directions) that are smaller than the one across the edge (weighted by
// the fourth power of the cosine to it). The energy is 1 minus the mean of these ranks: 0 if every
// edge lies on the strongest gradients, about 1/2 by chance in a picture full of texture. Ranks do
// not change with brightness and contrast. Needs no lines. Loeper et al. name it in their outlook.
class GradientScore final : public Score {
 public:
  // @param picture  CV_8U, any channels; reduced to the size of `camera`.
  GradientScore(const cv::Mat& picture,
                const PinholeCamera& camera,
                const GradientScoreOptions& options);

  ViewParts parts() const override { return {true, false}; }
  const char* unusable() const override {
    return has_gradients_ ? "" : "the picture has no gradients";
  }
  double LogRatio(const PositionView& view,
                  const Pose& cam_from_local,
                  Workspace& workspace) const override;
  // Of projected edges; 1 without any, and for a picture without gradients.
  double EnergyOfEdges(std::span<const ProjectedSegment> segments) const;

 private:
  PinholeCamera camera_;
  float spacing_px_ = 1.0f;
  bool has_gradients_ = false;
  std::vector<std::uint8_t> ranks_;  // [1/255], by direction, row, column
};

}  // namespace ridgeline
