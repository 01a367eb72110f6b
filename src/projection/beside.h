// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "city/city_model.h"
#include "projection/edge_set.h"
#include "projection/ray_scene.h"
#include "projection/visible_set.h"

namespace ridgeline {

// Tells what is seen on both sides of a visible piece.
class BesideFinder {
 public:
  BesideFinder(const CityModel& model, const RayScene& rays);

  // Left and right of the piece from a to b (relative to the eye) of an edge. A side on which the
  // edge shows its own face needs no ray; else rays pass beside the piece's middle, or beside
  // three places of a long piece, where the majority counts (the middle, if all differ).
  std::pair<Beside, Beside> Find(const Eigen::Vector3f& eye,
                                 const SceneEdge& edge,
                                 const FeatureEdge& feature,
                                 const Eigen::Vector3f& a,
                                 const Eigen::Vector3f& b) const;

 private:
  Beside OwnFace(std::uint32_t surface) const;
  Beside Look(const Eigen::Vector3f& eye,
              const FeatureEdge& feature,
              const Eigen::Vector3f& point,
              const Eigen::Vector3f& aside) const;

  const CityModel& model_;
  const RayScene& rays_;
  std::vector<std::uint32_t> roots_;
};

}  // namespace ridgeline
