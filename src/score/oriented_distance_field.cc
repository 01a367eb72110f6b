// SPDX-License-Identifier: Apache-2.0
#include "score/oriented_distance_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <span>

#include "base/parallel.h"
#include "projection/fast_angle.h"
#include "score/truncated_distance.h"

namespace ridgeline {
namespace {

// A segment counts for every direction bin whose centre is within this of its own: half a bin and
// the uncertainty of a short segment's direction.
constexpr double kDirectionToleranceDeg = 9.0;
// Window over which the density of segments is averaged.
constexpr double kDensitySigmaPx = 32.0;
constexpr double kSmallestDensity = 1e-3;
constexpr double kLevelRatio = 1.4;

double BinCenterDeg(int direction) {
  return (direction + 0.5) * 180.0 / OrientedDistanceField::kDirections;
}

double DirectionDeg(const LineSegment& segment) {
  const Eigen::Vector2f d = segment.b - segment.a;
  return std::atan2(d.y(), d.x()) * 180.0 / std::numbers::pi;
}

// The least value of each cell of 2 x 2 pixels, row by row.
void ReduceToLeast(const cv::Mat& pixels, int columns, std::uint8_t* cells) {
  static_assert(OrientedDistanceField::kDistanceCellPx == 2);
  for (int y = 0; y < pixels.rows; y += 2) {
    const std::uint8_t* above = pixels.ptr(y);
    const std::uint8_t* below = pixels.ptr(std::min(y + 1, pixels.rows - 1));
    const int pairs = pixels.cols / 2;
    for (int i = 0; i < pairs; ++i) {
      cells[i] = std::min(std::min(above[2 * i], above[2 * i + 1]),
                          std::min(below[2 * i], below[2 * i + 1]));
    }
    if (pairs < columns) cells[pairs] = std::min(above[2 * pairs], below[2 * pairs]);
    cells += columns;
  }
}

double UndirectedDifferenceDeg(double a, double b) {
  const double d = std::fmod(std::abs(a - b), 180.0);
  return std::min(d, 180.0 - d);
}

}  // namespace

int OrientedDistanceField::DirectionOf(float dx, float dy) {
  const float turns = std::atan2(dy, dx) * std::numbers::inv_pi_v<float>;  // in half turns
  const int bin = static_cast<int>(std::floor(turns * kDirections));
  return (bin + kDirections) % kDirections;
}

simd::Int4 OrientedDistanceField::DirectionsOf(simd::Float4 dx, simd::Float4 dy) {
  // Of the opposite vector where it points up: angles in [0, 180) degrees.
  const simd::Float4 across = dy < 0.0f ? -dx : dx;
  const simd::Float4 angle = FastAngleFromAxis(simd::Abs(dx), simd::Abs(dy));
  constexpr float kBinsPerRad = kDirections * std::numbers::inv_pi_v<float>;
  const simd::Float4 bins = angle * kBinsPerRad;
  const simd::Float4 place = across < 0.0f ? float{kDirections} - bins : bins;
  const simd::Int4 bin = __builtin_convertvector(place, simd::Int4);
  return bin < kDirections ? bin : simd::Int4{};
}

float OrientedDistanceField::DensityOfLevel(int level) {
  return static_cast<float>(kSmallestDensity * std::pow(kLevelRatio, level));
}

OrientedDistanceField::OrientedDistanceField(const std::vector<LineSegment>& segments,
                                             int width,
                                             int height,
                                             int threads,
                                             const cv::Mat& hidden)
    : width_(width),
      height_(height),
      distance_columns_((width + kDistanceCellPx - 1) / kDistanceCellPx),
      distance_rows_((height + kDistanceCellPx - 1) / kDistanceCellPx),
      cell_columns_((width + kDensityCellPx - 1) / kDensityCellPx),
      cell_rows_((height + kDensityCellPx - 1) / kDensityCellPx),
      distances_(static_cast<std::size_t>(kDirections) * distance_columns_ * distance_rows_),
      densities_(static_cast<std::size_t>(kDirections) * cell_columns_ * cell_rows_) {
  constexpr int kShift = 4;  // sub-pixel bits of cv::line
  const auto fixed = [](const Eigen::Vector2f& p) {
    return cv::Point(static_cast<int>(std::lround((p.x() - 0.5f) * (1 << kShift))),
                     static_cast<int>(std::lround((p.y() - 0.5f) * (1 << kShift))));
  };
  cv::Mat hidden_cells;
  if (!hidden.empty()) {
    cv::resize(hidden, hidden_cells, cv::Size(cell_columns_, cell_rows_), 0.0, 0.0, cv::INTER_AREA);
  }
  ParallelFor(kDirections, threads, [&](std::size_t index) {
    const int direction = static_cast<int>(index);
    cv::Mat free(height, width, CV_8U, cv::Scalar(255));
    for (const LineSegment& segment : segments) {
      if (UndirectedDifferenceDeg(DirectionDeg(segment), BinCenterDeg(direction)) <=
          kDirectionToleranceDeg) {
        cv::line(free, fixed(segment.a), fixed(segment.b), cv::Scalar(0), 1, cv::LINE_8, kShift);
      }
    }
    cv::Mat free_share;
    cv::resize(free, free_share, cv::Size(cell_columns_, cell_rows_), 0.0, 0.0, cv::INTER_AREA);
    cv::Mat density;
    free_share.convertTo(density, CV_32F, -1.0 / 255.0, 1.0);
    cv::GaussianBlur(density, density, cv::Size(), kDensitySigmaPx / kDensityCellPx);
    std::uint8_t* levels =
        &densities_[static_cast<std::size_t>(direction) * cell_rows_ * cell_columns_];
    for (int i = 0; i < cell_rows_ * cell_columns_; ++i) {
      const double rho = std::max<double>(density.ptr<float>()[i], kSmallestDensity);
      const double level = std::log(rho / kSmallestDensity) / std::log(kLevelRatio);
      const bool is_hidden = !hidden_cells.empty() && hidden_cells.ptr()[i] > 127;
      levels[i] = static_cast<std::uint8_t>(
          is_hidden ? kHiddenLevel : std::clamp(std::lround(level), 0L, kDensityLevels - 1L));
    }
    const std::span<std::uint8_t> distances(
        distances_.data() +
            static_cast<std::size_t>(direction) * distance_columns_ * distance_rows_,
        static_cast<std::size_t>(distance_columns_) * distance_rows_);
    ReduceToLeast(free, distance_columns_, distances.data());
    TruncatedDistance(distances,
                      distance_columns_,
                      distance_rows_,
                      static_cast<int>(kUnitsPerPx) * kDistanceCellPx);
  });
}

}  // namespace ridgeline
