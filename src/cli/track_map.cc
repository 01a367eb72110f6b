// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

#include "cli/track_report.h"
#include "report/chart.h"

namespace ridgeline {
namespace {

constexpr int kLongSidePx = 1600;
constexpr double kMarginM = 20.0;
constexpr double kLeastSizeM = 60.0;
constexpr int kLegendPx = 40;

const cv::Scalar kPaper(250, 250, 248), kHouse(222, 222, 216), kHouseRim(180, 180, 172),
    kCorridor(235, 206, 160), kCausal(180, 90, 20), kSmoothed(60, 130, 20), kTruth(30, 30, 200),
    kFix(150, 60, 150), kInk(60, 60, 60);

// World to pixels of the map; drawn with four fractional bits.
class Sheet {
 public:
  Sheet(const Eigen::AlignedBox2d& box) : box_(box) {
    const Eigen::Vector2d size = box.sizes();
    scale_ = kLongSidePx / std::max(size.x(), size.y());
    map_ = cv::Mat(static_cast<int>(size.y() * scale_) + kLegendPx,
                   static_cast<int>(size.x() * scale_),
                   CV_8UC3,
                   kPaper);
  }
  cv::Point At(const Eigen::Vector2d& world) const {
    const Eigen::Vector2d px((world.x() - box_.min().x()) * scale_,
                             (box_.max().y() - world.y()) * scale_);
    return {static_cast<int>(std::lround(px.x() * 16.0)),
            static_cast<int>(std::lround(px.y() * 16.0))};
  }
  int Pixels(double metres) const { return static_cast<int>(std::lround(metres * scale_ * 16.0)); }

  void Polygon(const std::vector<Eigen::Vector2d>& ring) {
    std::vector<cv::Point> points;
    for (const Eigen::Vector2d& p : ring) points.push_back(At(p));
    const std::vector<std::vector<cv::Point>> polygons{points};
    cv::fillPoly(map_, polygons, kHouse, cv::LINE_AA, 4);
    cv::polylines(map_, polygons, true, kHouseRim, 1, cv::LINE_AA, 4);
  }
  void Line(const std::vector<std::optional<Eigen::Vector2d>>& way,
            const cv::Scalar& color,
            int width) {
    for (std::size_t i = 1; i < way.size(); ++i) {
      if (way[i - 1] && way[i]) {
        cv::line(map_, At(*way[i - 1]), At(*way[i]), color, width, cv::LINE_AA, 4);
      }
    }
    for (const auto& p : way) {
      if (p) cv::circle(map_, At(*p), 16 * (width + 1), color, -1, cv::LINE_AA, 4);
    }
  }
  void Disc(const Eigen::Vector2d& at, double radius_m, const cv::Scalar& color) {
    cv::circle(map_, At(at), Pixels(radius_m), color, -1, cv::LINE_AA, 4);
  }
  void Cross(const Eigen::Vector2d& at, const cv::Scalar& color) {
    const cv::Point p = At(at);
    cv::drawMarker(map_, {p.x / 16, p.y / 16}, color, cv::MARKER_CROSS, 9, 1, cv::LINE_AA);
  }
  void Legend() {
    int x = 14;
    const int y = map_.rows - kLegendPx / 2;
    const auto entry = [&](const char* name, const cv::Scalar& color) {
      cv::circle(map_, {x, y}, 6, color, -1, cv::LINE_AA);
      cv::putText(map_, name, {x + 12, y + 5}, cv::FONT_HERSHEY_SIMPLEX, 0.5, kInk, 1, cv::LINE_AA);
      x += 30 + static_cast<int>(9 * std::string(name).size());
    };
    entry("as it came", kCausal);
    entry("smoothed", kSmoothed);
    entry("truth", kTruth);
    entry("GNSS", kFix);
    entry("corridor", kCorridor);
    const double bar_m = std::pow(10.0, std::floor(std::log10(0.3 * map_.cols / scale_)));
    const int bar = static_cast<int>(bar_m * scale_);
    cv::line(map_, {map_.cols - bar - 14, y + 8}, {map_.cols - 14, y + 8}, kInk, 2);
    char text[32];
    std::snprintf(text, sizeof text, "%g m", bar_m);
    cv::putText(map_, text, {map_.cols - bar - 14, y}, cv::FONT_HERSHEY_SIMPLEX, 0.5, kInk, 1,
                cv::LINE_AA);
  }
  const cv::Mat& map() const { return map_; }

 private:
  Eigen::AlignedBox2d box_;
  double scale_ = 1.0;
  cv::Mat map_;
};

std::optional<Eigen::Vector2d> PlaceOf(const std::optional<Pose>& pose) {
  if (!pose) return std::nullopt;
  return Eigen::Vector2d(pose->center_in_world.head<2>());
}

double RadiusOf(const TrackFrame& frame) {
  if (frame.protection) return frame.protection->position_m;
  return 2.45 * std::sqrt(std::max(frame.covariance(0, 0), frame.covariance(1, 1)));
}

}  // namespace

cv::Mat TrackMap(std::span<const TrackRow> rows, const Localizer& localizer) {
  std::vector<std::optional<Eigen::Vector2d>> causal, smoothed, truth;
  Eigen::AlignedBox2d box;
  for (const TrackRow& row : rows) {
    causal.push_back(PlaceOf(row.frame.pose));
    smoothed.push_back(row.smoothed ? PlaceOf(row.smoothed->pose) : std::nullopt);
    truth.push_back(PlaceOf(row.truth));
    for (const auto* way : {&causal, &smoothed, &truth}) {
      if (way->back()) box.extend(*way->back());
    }
  }
  if (box.isEmpty()) return {};
  const Eigen::Vector2d margin =
      Eigen::Vector2d::Constant(kMarginM) + 0.5 * (Eigen::Vector2d::Constant(kLeastSizeM) -
                                                   box.sizes()).cwiseMax(0.0);
  Sheet sheet({box.min() - margin, box.max() + margin});
  const Eigen::Vector2d origin = localizer.scene().model().origin_in_world.head<2>();
  for (std::vector<Eigen::Vector2d> ring : localizer.footprints().rings()) {
    for (Eigen::Vector2d& p : ring) p += origin;
    sheet.Polygon(ring);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (causal[i]) sheet.Disc(*causal[i], RadiusOf(rows[i].frame), kCorridor);
  }
  for (const TrackRow& row : rows) {
    if (row.frame.fix) sheet.Cross(*row.frame.fix, kFix);
  }
  sheet.Line(truth, kTruth, 3);
  sheet.Line(causal, kCausal, 2);
  sheet.Line(smoothed, kSmoothed, 1);
  sheet.Legend();
  return sheet.map();
}

}  // namespace ridgeline
