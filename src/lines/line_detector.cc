// SPDX-License-Identifier: Apache-2.0
#include "lines/line_detector.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "lines/detector_table.h"

namespace ridgeline {
namespace {

// Mean directed gradient across a segment: positive where the right side of a -> b is brighter.
float MeanGradientAcross(const cv::Mat& gray, const LineSegment& segment) {
  constexpr float kOffsetPx = 1.5f;
  const Eigen::Vector2f along = (segment.b - segment.a).normalized();
  const Eigen::Vector2f right(-along.y(), along.x());
  const int samples = std::max(2, static_cast<int>(segment.Length() / 2.0f));
  const auto value = [&](const Eigen::Vector2f& p) {
    const int x = std::clamp(static_cast<int>(std::floor(p.x())), 0, gray.cols - 1);
    const int y = std::clamp(static_cast<int>(std::floor(p.y())), 0, gray.rows - 1);
    return static_cast<float>(gray.at<std::uint8_t>(y, x));
  };
  float sum = 0.0f;
  for (int i = 0; i < samples; ++i) {
    const Eigen::Vector2f p =
        segment.a + (segment.b - segment.a) * ((static_cast<float>(i) + 0.5f) / samples);
    sum += value(p + kOffsetPx * right) - value(p - kOffsetPx * right);
  }
  return sum / (2.0f * kOffsetPx * static_cast<float>(samples));
}

struct Joint {
  bool joins = false;
  LineSegment joined;
};

Joint TryJoin(const LineSegment& base, const LineSegment& other, double max_gap_px) {
  constexpr float kMinCosine = 0.99939f;  // 2 degrees
  constexpr float kMaxOffsetPx = 1.5f;
  const float base_length = base.Length();
  const Eigen::Vector2f u = (base.b - base.a) / base_length;
  if (u.dot((other.b - other.a).normalized()) < kMinCosine) return {};
  const auto offset = [&](const Eigen::Vector2f& p) {
    const Eigen::Vector2f d = p - base.a;
    return std::abs(u.x() * d.y() - u.y() * d.x());
  };
  if (offset(other.a) > kMaxOffsetPx || offset(other.b) > kMaxOffsetPx) return {};
  const float start = u.dot(other.a - base.a);
  const float end = u.dot(other.b - base.a);
  if (start > base_length + max_gap_px || end < -max_gap_px) return {};
  Joint joint{true, base};
  if (start < 0.0f) joint.joined.a = other.a;
  if (end > base_length) joint.joined.b = other.b;
  const float other_length = other.Length();
  joint.joined.strength =
      (base.strength * base_length + other.strength * other_length) / (base_length + other_length);
  return joint;
}

}  // namespace

cv::Mat GrayOf(const cv::Mat& picture) {
  cv::Mat eight_bit = picture;
  if (picture.depth() == CV_16U) picture.convertTo(eight_bit, CV_8U, 1.0 / 257.0);
  if (eight_bit.channels() == 1) return eight_bit;
  cv::Mat gray;
  cv::cvtColor(
      eight_bit, gray, eight_bit.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
  return gray;
}

std::vector<LineSegment> MergeCollinear(std::vector<LineSegment> segments, double max_gap_px) {
  std::stable_sort(
      segments.begin(), segments.end(), [](const LineSegment& x, const LineSegment& y) {
        return x.Length() > y.Length();
      });
  std::vector<bool> used(segments.size(), false);
  std::vector<LineSegment> merged;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (used[i]) continue;
    LineSegment base = segments[i];
    for (bool grown = true; grown;) {
      grown = false;
      for (std::size_t j = i + 1; j < segments.size(); ++j) {
        if (used[j]) continue;
        const Joint joint = TryJoin(base, segments[j], max_gap_px);
        if (!joint.joins) continue;
        base = joint.joined;
        used[j] = true;
        grown = true;
      }
    }
    merged.push_back(base);
  }
  return merged;
}

void LineDetectionOptions::Visit(OptionVisitor& v) {
  OneOf detectors{DetectorNames()};
  detectors.words.push_back(kLinesFromFile);
  v.Field("detector", detector, detectors);
  v.Field("min_length_px", min_length_px, Positive());
  v.Field("max_gap_px", max_gap_px, NotNegative());
  v.Field("canny_low", canny_low, NotNegative());
  v.Field("canny_high", canny_high, MoreThan(canny_low, "canny_low"));
}

std::vector<LineSegment> DetectLines(const cv::Mat& picture, const LineDetectionOptions& options) {
  const cv::Mat gray = GrayOf(picture);
  const std::vector<cv::Vec4f> lines = FindDetector(options.detector).detect(gray, options);

  std::vector<LineSegment> segments;
  segments.reserve(lines.size());
  for (const cv::Vec4f& line : lines) {
    // OpenCV's integer coordinates are pixel centres.
    LineSegment segment{{line[0] + 0.5f, line[1] + 0.5f}, {line[2] + 0.5f, line[3] + 0.5f}, 1.0f};
    if (segment.Length() < options.min_length_px) continue;
    const float gradient = MeanGradientAcross(gray, segment);
    if (gradient < 0.0f) std::swap(segment.a, segment.b);
    segment.strength = std::max(std::abs(gradient), 1e-3f);
    segments.push_back(segment);
  }
  return options.max_gap_px > 0.0 ? MergeCollinear(std::move(segments), options.max_gap_px)
                                  : segments;
}

}  // namespace ridgeline
