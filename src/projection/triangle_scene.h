// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace ridgeline {

struct TriangleHit {
  float distance = 0.0f;                             // in lengths of the ray's direction
  std::uint32_t triangle = 0;                        // index
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // of the triangle, unit, on either side
  float u = 0.0f, v = 0.0f;                          // weights of its second and third corner
};

// Bare triangles for single rays, as a renderer of pictures wants them; RayScene is the one of city
// models. Thread-safe after construction.
class TriangleScene {
 public:
  TriangleScene(std::span<const Eigen::Vector3f> vertices,
                std::span<const std::array<std::uint32_t, 3>> triangles);
  ~TriangleScene();

  std::optional<TriangleHit> Cast(const Eigen::Vector3f& from,
                                  const Eigen::Vector3f& direction) const;
  // Whether anything is nearer than `reach` (in lengths of the direction).
  bool IsBlocked(const Eigen::Vector3f& from, const Eigen::Vector3f& direction, float reach) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ridgeline
