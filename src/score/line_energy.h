// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/options.h"
#include "lines/line_segment.h"

namespace ridgeline {

struct LineEnergyOptions {
  // Largest angle between corresponding segments [deg], in (0, 90]. The paper gives no number.
  double max_angle_deg = 5.0;
  // Orthogonal distance at which the distance score is 0 [share of the picture's width], > 0; 10 px
  // at the paper's 960 px. The paper gives no number.
  double max_distance_width = 0.0104;
  // The same in pixels of the picture compared, in place of the share if > 0: holds for upright and
  // broad pictures alike.
  double max_distance_px = 0.0;

  void Visit(OptionVisitor& v) {
    v.Field("max_angle_deg", max_angle_deg, LeftOpen(0.0, 90.0));
    v.Field("max_distance_width", max_distance_width, Positive());
    v.Field("max_distance_px", max_distance_px, NotNegative());
  }
  // [px] of a picture of `width_px`.
  double DistanceLimitPx(int width_px) const {
    return max_distance_px > 0.0 ? max_distance_px : max_distance_width * width_px;
  }
};

// Energy of Loeper et al., section 3.1.3: image segment i corresponds to model segment j if their
// directions differ by at most max_angle and the orthogonal distance d_ij of i's middle from the line
// through j is at most max_distance; s_j is the mean of 1 - d_ij / max_distance over j's
// correspondents, 0 without any; the energy is 1 - sum s_j / J. Lengths and overlap do not count.
class LineEnergy {
 public:
  // `picture`: segments of the picture [px of an image of `width_px`].
  LineEnergy(std::span<const LineSegment> picture, int width_px, const LineEnergyOptions& options);

  bool has_lines() const { return !segments_.empty(); }

  // In [0, 1]; 1 without model segments, and for a picture without lines.
  double Energy(std::span<const LineSegment> model) const;

  // A picture's and a model's segment that correspond.
  struct Pair {
    std::size_t picture = 0;  // indices into what the constructor and Pairs() were given
    std::size_t model = 0;
    double score = 0.0;  // 1 - d / max_distance
  };
  // All pairs behind Energy(), by model segment; for figures.
  std::vector<Pair> Pairs(std::span<const LineSegment> model) const;

 private:
  struct Directed {
    Eigen::Vector2f middle;
    float angle;  // undirected, [0, pi)
    std::uint32_t index;
  };
  // Calls visit(picture's segment, score) for the correspondents of a model segment.
  template <typename Visit>
  void ForCorrespondents(const LineSegment& segment, const Visit& visit) const;

  std::vector<Directed> segments_;  // by angle
  float max_angle_rad_ = 0.0f;
  float max_distance_px_ = 0.0f;
};

}  // namespace ridgeline
