// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "camera/intrinsics.h"
#include "lines/line_detector.h"
#include "score/evidence_options.h"
#include "score/oriented_distance_field.h"

namespace ridgeline {

// A picture as the scores and the cues compare it: reduced, with its lines and what leaves hide.
// Made once, so that a pose costs microseconds.
class PictureEvidence {
 public:
  // @param bgr  Undistorted picture, 8 bit, three channels.
  // @param camera  Of the picture as given.
  // @param given_lines  Segments [px of the picture as given] instead of the detector's.
  PictureEvidence(const cv::Mat& bgr,
                  const PinholeCamera& camera,
                  const LineDetectionOptions& lines,
                  const EvidenceOptions& options,
                  int threads,
                  const std::optional<std::vector<LineSegment>>& given_lines = std::nullopt);

  // The same picture by a camera whose focal length is another.
  PictureEvidence(const PictureEvidence& other, double focal_scale);
  PictureEvidence(const PictureEvidence&) = delete;
  PictureEvidence& operator=(const PictureEvidence&) = delete;

  // The picture as given.
  const cv::Mat& full_bgr() const { return full_bgr_; }
  const PinholeCamera& full_camera() const { return full_camera_; }

  // The reduced picture; all that follows is in its pixels.
  const cv::Mat& bgr() const { return bgr_; }
  const PinholeCamera& camera() const { return camera_; }
  const std::vector<LineSegment>& segments() const { return segments_; }
  // CV_8U, 255 where leaves hide what is behind.
  const cv::Mat& foliage() const { return foliage_; }
  // Of the segments; hidden where the leaves are.
  const OrientedDistanceField& field() const { return field_; }
  // Whether there is nothing to compare: no lines, and one colour.
  bool is_blank() const { return segments_.empty() && is_one_colour_; }

 private:
  cv::Mat full_bgr_;
  PinholeCamera full_camera_;
  PinholeCamera camera_;
  cv::Mat bgr_;
  bool is_one_colour_ = false;
  std::vector<LineSegment> segments_;
  cv::Mat foliage_;
  OrientedDistanceField field_;
};

}  // namespace ridgeline
