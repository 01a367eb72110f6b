// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "city/city_model.h"
#include "projection/terrain_mesh.h"
#include "projection/view_buffers.h"

namespace ridgeline {

struct RayHit {
  float distance = 0.0f;               // in lengths of the ray's direction
  std::uint32_t surface = kNoSurface;  // index into CityModel::surfaces, or kTerrainSurface
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // of the triangle hit, unit
};

// The triangles of model and terrain in Embree, in robust mode: no ray slips between neighbours.
// Thread-safe after construction.
class RayScene {
 public:
  RayScene(const CityModel& model, const TerrainMesh& terrain);
  ~RayScene();

  // First hit farther than `nearest` (in lengths of the direction).
  std::optional<RayHit> Cast(const Eigen::Vector3f& from,
                             const Eigen::Vector3f& direction,
                             float nearest = 0.0f) const;

  // The surfaces first hit by rays from one point, many at a time: about ten times as fast as one
  // by one if neighbours in the list are neighbours in space. kNoSurface: none.
  void CastMany(const Eigen::Vector3f& from,
                std::span<const Eigen::Vector3f> directions,
                std::span<std::uint32_t> surfaces) const;

  ViewBuffers Render(const PinholeCamera& camera, const Pose& cam_from_local, bool normals) const;

  // Memory of Embree's structures.
  std::size_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ridgeline
