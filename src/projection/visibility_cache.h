// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>

#include "base/options.h"
#include "projection/scene.h"

namespace ridgeline {

struct VisibilityCacheOptions {
  // Cells: their sides to the east and north, and in height [m].
  double cell_m = 1.0;
  double height_cell_m = 0.5;
  // Most memory of the sets kept [MB]; the least recently used go first.
  double max_megabytes = 256.0;

  void Visit(OptionVisitor& v) {
    v.Field("cell_m", cell_m);
    v.Field("height_cell_m", height_cell_m);
    v.Field("max_megabytes", max_megabytes);
  }
  // Throws InputError naming the field, e.g. "visibility_cache.cell_m".
  void Validate() const;
};

// Visible sets at the centres of a grid of cells, computed when first asked for. Any orientation at
// a cell asked for before costs a projection only (ProjectPieces with the exact pose: the edges are
// where they belong, only what hides them is taken from the cell's centre). Which sets are
// kept depends on the order of the questions, but a set is always the one that Scene::VisibleFrom
// gives. Thread-safe; two threads that miss the same cell at once both compute it.
class VisibilityCache {
 public:
  // `origin` (local) is the centre of one cell, e.g. the prior; the sector is that of every set.
  // The scene must outlive the cache.
  VisibilityCache(const Scene& scene,
                  const Eigen::Vector3d& origin,
                  const Sector& sector,
                  const VisibilityCacheOptions& options);
  ~VisibilityCache();

  // The set at the centre of the cell around `position`.
  std::shared_ptr<const VisibleSet> Near(const Eigen::Vector3d& position);

  // The centre of the cell around `position`.
  Eigen::Vector3d CenterNear(const Eigen::Vector3d& position) const;

  // Of the sets kept now.
  std::size_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ridgeline
