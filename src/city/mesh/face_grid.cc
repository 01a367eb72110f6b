// SPDX-License-Identifier: Apache-2.0
#include "city/mesh/face_grid.h"

#include <algorithm>
#include <cmath>

namespace ridgeline {

FaceGrid::FaceGrid(const FaceSet& set, double cell_m) : inverse_cell_(1.0 / cell_m) {
  Eigen::AlignedBox3d all;
  boxes_.reserve(set.faces.size());
  for (const Face& face : set.faces) {
    Eigen::AlignedBox3d box;
    for (const std::uint32_t v : set.Ring(face.first_ring)) box.extend(set.vertices[v]);
    all.extend(box);
    boxes_.push_back(box);
  }
  if (all.isEmpty()) return;
  origin_ = all.min().head<2>();
  // A model that holds a stray building far away must not make a grid of billions of cells.
  constexpr double kMaxCells = 4e6;
  const Eigen::Vector2d extent = all.sizes().head<2>();
  const double cells = (extent.x() * inverse_cell_ + 1.0) * (extent.y() * inverse_cell_ + 1.0);
  if (cells > kMaxCells) inverse_cell_ *= std::sqrt(kMaxCells / cells) * 0.5;
  size_ = CellOf(all.max()) + Eigen::Vector2i::Ones();
  std::vector<std::uint32_t> counts(static_cast<std::size_t>(size_.prod()) + 1, 0);
  const auto for_cells = [this](const Eigen::AlignedBox3d& box, const auto& visit) {
    const Eigen::Vector2i low = CellOf(box.min());
    const Eigen::Vector2i high = CellOf(box.max());
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) visit(static_cast<std::size_t>(y * size_.x() + x));
    }
  };
  for (const Eigen::AlignedBox3d& box : boxes_) {
    for_cells(box, [&](std::size_t cell) { ++counts[cell + 1]; });
  }
  for (std::size_t i = 1; i < counts.size(); ++i) counts[i] += counts[i - 1];
  first_ = counts;
  entries_.resize(counts.back());
  for (std::uint32_t f = 0; f < boxes_.size(); ++f) {
    for_cells(boxes_[f], [&](std::size_t cell) { entries_[counts[cell]++] = f; });
  }
}

Eigen::Vector2i FaceGrid::CellOf(const Eigen::Vector3d& point) const {
  const Eigen::Vector2d cell = (point.head<2>() - origin_) * inverse_cell_;
  return cell.array().floor().matrix().cast<int>();
}

void FaceGrid::Query(const Eigen::AlignedBox3d& box, std::vector<std::uint32_t>& faces) const {
  faces.clear();
  if (entries_.empty()) return;
  const Eigen::Vector2i low = CellOf(box.min()).cwiseMax(0);
  const Eigen::Vector2i high = CellOf(box.max()).cwiseMin(size_ - Eigen::Vector2i::Ones());
  for (int y = low.y(); y <= high.y(); ++y) {
    for (int x = low.x(); x <= high.x(); ++x) {
      const auto cell = static_cast<std::size_t>(y * size_.x() + x);
      for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
        if (boxes_[entries_[i]].intersects(box)) faces.push_back(entries_[i]);
      }
    }
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
}

}  // namespace ridgeline
