// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

namespace ridgeline {

// Gives points that lie within `tolerance` of each other one index: a hash grid, O(1) per point.
// The first point of a cluster stands for it, so the result depends on the order alone.
class PointWelder {
 public:
  explicit PointWelder(double tolerance);

  std::uint32_t Add(const Eigen::Vector3d& point);
  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  std::vector<Eigen::Vector3d> Release() { return std::move(points_); }

 private:
  using Cell = Eigen::Matrix<std::int64_t, 3, 1>;

  std::uint32_t Find(const Eigen::Vector3d& point, const Cell& cell) const;
  void Insert(const Cell& cell, std::uint32_t index);
  void Grow();

  double tolerance_;
  double inverse_cell_;
  std::vector<Eigen::Vector3d> points_;
  // Open addressing: slots hold the index of a cell's first point; others of the cell are chained.
  std::vector<std::uint32_t> slots_;
  std::vector<std::uint32_t> next_in_cell_;
};

}  // namespace ridgeline
