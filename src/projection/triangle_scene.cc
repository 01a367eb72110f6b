// SPDX-License-Identifier: Apache-2.0
#include "projection/triangle_scene.h"

#include <limits>

#include "projection/embree_scene.h"

namespace ridgeline {

struct TriangleScene::Impl {
  EmbreeScene embree{RTC_SCENE_FLAG_NONE};
};

TriangleScene::TriangleScene(std::span<const Eigen::Vector3f> vertices,
                             std::span<const std::array<std::uint32_t, 3>> triangles)
    : impl_(std::make_unique<Impl>()) {
  impl_->embree.AddMesh(
      0,
      vertices.size(),
      triangles.size(),
      [&](std::size_t i) { return vertices[i]; },
      [&](std::size_t i) { return triangles[i]; });
  impl_->embree.Commit();
}

TriangleScene::~TriangleScene() = default;

std::optional<TriangleHit> TriangleScene::Cast(const Eigen::Vector3f& from,
                                               const Eigen::Vector3f& direction) const {
  RTCRayHit ray{};
  ray.ray = RayAlong(from, direction, 0.0f, std::numeric_limits<float>::infinity());
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect1(impl_->embree.scene(), &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return TriangleHit{ray.ray.tfar,
                     ray.hit.primID,
                     Eigen::Vector3f(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z).normalized(),
                     ray.hit.u,
                     ray.hit.v};
}

bool TriangleScene::IsBlocked(const Eigen::Vector3f& from,
                              const Eigen::Vector3f& direction,
                              float reach) const {
  RTCRay ray = RayAlong(from, direction, 0.0f, reach);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(impl_->embree.scene(), &context, &ray);
  return ray.tfar < 0.0f;
}

}  // namespace ridgeline
