// SPDX-License-Identifier: Apache-2.0
#include "score/picture_evidence.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "score/foliage_mask.h"

namespace ridgeline {
namespace {

PinholeCamera WorkCamera(const PinholeCamera& camera, int work_size_px) {
  const int longer = std::max(camera.width, camera.height);
  return camera.Scaled(std::min(1.0, static_cast<double>(work_size_px) / longer));
}

PinholeCamera WithFocal(PinholeCamera camera, double scale) {
  camera.fx *= scale;
  camera.fy *= scale;
  return camera;
}

cv::Mat Reduced(const cv::Mat& picture, const PinholeCamera& camera) {
  cv::Mat reduced;
  cv::resize(picture, reduced, cv::Size(camera.width, camera.height), 0.0, 0.0, cv::INTER_AREA);
  return reduced;
}

bool IsOneColour(const cv::Mat& bgr) {
  cv::Mat changes;
  cv::compare(bgr,
              cv::Mat(bgr.size(), bgr.type(), cv::Scalar(bgr.at<cv::Vec3b>(0, 0))),
              changes,
              cv::CMP_NE);
  return cv::countNonZero(changes.reshape(1)) == 0;
}

std::vector<LineSegment> WorkSegments(const cv::Mat& reduced,
                                      const PinholeCamera& work,
                                      const PinholeCamera& full,
                                      const LineDetectionOptions& options,
                                      const std::optional<std::vector<LineSegment>>& given) {
  if (!given) return DetectLines(reduced, options);
  const Eigen::Vector2f scale(static_cast<float>(work.width) / full.width,
                              static_cast<float>(work.height) / full.height);
  std::vector<LineSegment> segments = *given;
  for (LineSegment& segment : segments) {
    segment.a = segment.a.cwiseProduct(scale);
    segment.b = segment.b.cwiseProduct(scale);
  }
  return segments;
}

}  // namespace

PictureEvidence::PictureEvidence(const cv::Mat& bgr,
                                 const PinholeCamera& camera,
                                 const LineDetectionOptions& lines,
                                 const EvidenceOptions& options,
                                 int threads,
                                 const std::optional<std::vector<LineSegment>>& given_lines)
    : full_bgr_(bgr),
      full_camera_(camera),
      camera_(WorkCamera(camera, options.work_size_px)),
      bgr_(Reduced(bgr, camera_)),
      is_one_colour_(IsOneColour(bgr_)),
      segments_(WorkSegments(bgr_, camera_, camera, lines, given_lines)),
      foliage_(FoliageMask(bgr_)),
      field_(segments_, camera_.width, camera_.height, threads, foliage_) {}

PictureEvidence::PictureEvidence(const PictureEvidence& other, double focal_scale)
    : full_bgr_(other.full_bgr_),
      full_camera_(WithFocal(other.full_camera_, focal_scale)),
      camera_(WithFocal(other.camera_, focal_scale)),
      bgr_(other.bgr_),
      is_one_colour_(other.is_one_colour_),
      segments_(other.segments_),
      foliage_(other.foliage_),
      field_(other.field_) {}

}  // namespace ridgeline
