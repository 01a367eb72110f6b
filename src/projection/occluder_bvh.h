// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace ridgeline {

// A triangle (d = c) or a convex plane quadrangle, its corners in turn; local frame [m].
struct Occluder {
  Eigen::Vector3f a, b, c, d;
  // A point hides behind it only if it lies deeper than this behind its plane [m]. It keeps
  // an edge from hiding behind its own faces and behind coplanar neighbours.
  float tolerance_m = 0.0f;
};

// Part of a segment as parameters in [0, 1] from its first to its second end.
struct Interval {
  float first = 0.0f;
  float last = 0.0f;
};

// Occluders in a bounding volume hierarchy that answers which parts of a segment are hidden from a
// point. Instead of rays along the segment, the plane triangle between the point and the segment
// goes down the hierarchy once, near boxes first, and every occluder on the way cuts its shadow out
// of the segment: exact to rounding, no gap is missed, and a hidden segment ends early.
class OccluderBvh {
 public:
  // Per range of azimuths the leaf that completed the last hidden segment there: tried first. It
  // saves time and changes no result, so that any state (one per thread) will do.
  using Hints = std::array<std::uint32_t, 256>;

  explicit OccluderBvh(std::vector<Occluder> occluders);
  ~OccluderBvh();

  // Adds the hidden parts of the segment a-b (relative to the eye) to `hidden`, which stays
  // disjoint and in order; parts that meet within float rounding are joined. Stops early and
  // returns false once no gap of at least `min_part` of the segment's length is left.
  bool Hide(const Eigen::Vector3f& eye,
            const Eigen::Vector3f& a_from_eye,
            const Eigen::Vector3f& b_from_eye,
            float min_part,
            std::vector<Interval>& hidden,
            Hints& hints) const;

  // Whether one of the occluders in the leaf hinted at hides a whole box (centre relative to the
  // eye, half sizes) for sure: then Hide would hide every segment in it. Cheap; often says no.
  bool HidesBox(const Eigen::Vector3f& eye,
                const Eigen::Vector3f& center_from_eye,
                const Eigen::Vector3f& extent,
                const Hints& hints) const;

  std::size_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ridgeline
