// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace ridgeline {

struct OccluderTriangle {
  Eigen::Vector3f a, b, c;  // local frame [m]
  // A point hides behind the triangle only if it lies deeper than this behind its plane [m]. It keeps
  // an edge from hiding behind its own faces and behind coplanar neighbours.
  float tolerance_m = 0.0f;
};

// Part of a segment as parameters in [0, 1] from its first to its second end.
struct Interval {
  float first = 0.0f;
  float last = 0.0f;
};

// Triangles in a bounding volume hierarchy that answers which parts of a segment are hidden from a
// point. Instead of rays along the segment, the plane triangle between the point and the segment
// goes down the hierarchy once, near boxes first, and every occluder on the way cuts its shadow out
// of the segment: exact to rounding, no gap is missed, and a hidden segment ends early.
class OccluderBvh {
 public:
  // Working memory of a query, reused between queries of one thread.
  struct Workspace {
    std::vector<Interval> hidden;  // disjoint, in order
    // Per range of azimuths the leaf that completed the last hidden segment there: tried first.
    std::array<std::uint32_t, 256> leaf_at_azimuth{};
  };

  explicit OccluderBvh(const std::vector<OccluderTriangle>& triangles);
  ~OccluderBvh();

  // Visible parts of the segment a-b (relative to the eye) of at least `min_part` of its length.
  // Parts that meet within float rounding are joined.
  void VisibleParts(const Eigen::Vector3f& eye,
                    const Eigen::Vector3f& a_from_eye,
                    const Eigen::Vector3f& b_from_eye,
                    float min_part,
                    Workspace& workspace,
                    std::vector<Interval>& visible) const;

  std::size_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ridgeline
