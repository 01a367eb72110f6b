// SPDX-License-Identifier: Apache-2.0
#include "city/mesh/point_welder.h"

#include <cmath>

#include "base/random.h"

namespace ridgeline {
namespace {

constexpr std::uint32_t kEmpty = 0xFFFFFFFFu;

std::uint64_t HashCell(const Eigen::Matrix<std::int64_t, 3, 1>& cell) {
  return MixBits(static_cast<std::uint64_t>(cell.x()) * 0x9E3779B97F4A7C15u ^
                 static_cast<std::uint64_t>(cell.y()) * 0xC2B2AE3D27D4EB4Fu ^
                 static_cast<std::uint64_t>(cell.z()) * 0x165667B19E3779F9u);
}

}  // namespace

PointWelder::PointWelder(double tolerance)
    : tolerance_(tolerance),
      // Cells four tolerances wide: most points touch the neighbourhood of one cell only.
      inverse_cell_(1.0 / (4.0 * tolerance)),
      slots_(1024, kEmpty) {}

std::uint32_t PointWelder::Add(const Eigen::Vector3d& point) {
  const Eigen::Vector3d scaled = point * inverse_cell_;
  const double reach = tolerance_ * inverse_cell_;
  const Cell low = (scaled.array() - reach).floor().matrix().cast<std::int64_t>();
  const Cell high = (scaled.array() + reach).floor().matrix().cast<std::int64_t>();
  for (std::int64_t x = low.x(); x <= high.x(); ++x) {
    for (std::int64_t y = low.y(); y <= high.y(); ++y) {
      for (std::int64_t z = low.z(); z <= high.z(); ++z) {
        const std::uint32_t found = Find(point, Cell(x, y, z));
        if (found != kEmpty) return found;
      }
    }
  }
  const auto index = static_cast<std::uint32_t>(points_.size());
  points_.push_back(point);
  next_in_cell_.push_back(kEmpty);
  if (points_.size() * 2 > slots_.size()) {
    Grow();
  } else {
    Insert(scaled.array().floor().matrix().cast<std::int64_t>(), index);
  }
  return index;
}

std::uint32_t PointWelder::Find(const Eigen::Vector3d& point, const Cell& cell) const {
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t slot = HashCell(cell) & mask; slots_[slot] != kEmpty; slot = (slot + 1) & mask) {
    for (std::uint32_t i = slots_[slot]; i != kEmpty; i = next_in_cell_[i]) {
      if ((points_[i] - point).squaredNorm() <= tolerance_ * tolerance_) return i;
    }
  }
  return kEmpty;
}

// Points of one slot run may belong to other cells that hash alike; Find compares distances.
void PointWelder::Insert(const Cell& cell, std::uint32_t index) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = HashCell(cell) & mask;
  while (slots_[slot] != kEmpty) {
    const Eigen::Vector3d scaled = points_[slots_[slot]] * inverse_cell_;
    if (scaled.array().floor().matrix().cast<std::int64_t>() == cell) {
      next_in_cell_[index] = next_in_cell_[slots_[slot]];
      next_in_cell_[slots_[slot]] = index;
      return;
    }
    slot = (slot + 1) & mask;
  }
  slots_[slot] = index;
}

void PointWelder::Grow() {
  slots_.assign(slots_.size() * 4, kEmpty);
  next_in_cell_.assign(points_.size(), kEmpty);
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    const Eigen::Vector3d scaled = points_[i] * inverse_cell_;
    Insert(scaled.array().floor().matrix().cast<std::int64_t>(), i);
  }
}

}  // namespace ridgeline
