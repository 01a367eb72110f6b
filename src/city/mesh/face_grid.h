// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "city/mesh/face_set.h"

namespace ridgeline {

// Faces by the cells of a horizontal grid that their boxes touch.
class FaceGrid {
 public:
  FaceGrid(const FaceSet& set, double cell_m);

  const Eigen::AlignedBox3d& box(std::uint32_t face) const { return boxes_[face]; }
  // Faces whose boxes meet `box`, ascending, each once; replaces the content of `faces`.
  void Query(const Eigen::AlignedBox3d& box, std::vector<std::uint32_t>& faces) const;

 private:
  Eigen::Vector2i CellOf(const Eigen::Vector3d& point) const;

  double inverse_cell_;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  Eigen::Vector2i size_ = Eigen::Vector2i::Zero();
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::vector<std::uint32_t> first_;  // of each cell, in entries_
  std::vector<std::uint32_t> entries_;
};

}  // namespace ridgeline
