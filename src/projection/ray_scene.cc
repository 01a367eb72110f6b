// SPDX-License-Identifier: Apache-2.0
#include "projection/ray_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "projection/embree_scene.h"

namespace ridgeline {
namespace {

constexpr unsigned kModelGeometry = 0;
constexpr unsigned kTerrainGeometry = 1;
constexpr int kPacket = 8;

RTCRayHit8 RaysFrom(const Eigen::Vector3f& origin) {
  RTCRayHit8 rays{};
  for (int k = 0; k < kPacket; ++k) {
    rays.ray.org_x[k] = origin.x();
    rays.ray.org_y[k] = origin.y();
    rays.ray.org_z[k] = origin.z();
    rays.ray.mask[k] = ~0u;
  }
  return rays;
}

void SetRay(RTCRayHit8& rays, std::size_t k, const Eigen::Vector3f& direction) {
  rays.ray.dir_x[k] = direction.x();
  rays.ray.dir_y[k] = direction.y();
  rays.ray.dir_z[k] = direction.z();
  rays.ray.tnear[k] = 0.0f;
  rays.ray.tfar[k] = std::numeric_limits<float>::infinity();
  rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
}

}  // namespace

struct RayScene::Impl {
  std::vector<std::uint32_t> surface_of_triangle;
  EmbreeScene embree{RTC_SCENE_FLAG_ROBUST};

  std::uint32_t Surface(unsigned geometry, unsigned primitive) const {
    return geometry == kTerrainGeometry ? kTerrainSurface : surface_of_triangle[primitive];
  }
};

RayScene::RayScene(const CityModel& model, const TerrainMesh& terrain)
    : impl_(std::make_unique<Impl>()) {
  impl_->embree.AddMesh(
      kModelGeometry,
      model.vertices.size(),
      model.triangles.size(),
      [&](std::size_t i) -> Eigen::Vector3f { return model.vertices[i].cast<float>(); },
      [&](std::size_t i) { return model.triangles[i].vertices; });
  impl_->embree.AddMesh(
      kTerrainGeometry,
      terrain.vertices.size(),
      terrain.triangles.size(),
      [&](std::size_t i) { return terrain.vertices[i]; },
      [&](std::size_t i) { return terrain.triangles[i]; });
  impl_->embree.Commit();
  impl_->surface_of_triangle.reserve(model.triangles.size());
  for (const Triangle& triangle : model.triangles) {
    impl_->surface_of_triangle.push_back(triangle.surface);
  }
}

RayScene::~RayScene() = default;

std::size_t RayScene::memory_bytes() const { return impl_->embree.memory_bytes(); }

std::optional<RayHit> RayScene::Cast(const Eigen::Vector3f& from,
                                     const Eigen::Vector3f& direction,
                                     float nearest) const {
  RTCRayHit ray{};
  ray.ray = RayAlong(from, direction, nearest, std::numeric_limits<float>::infinity());
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(impl_->embree.scene(), &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return RayHit{ray.ray.tfar,
                impl_->Surface(ray.hit.geomID, ray.hit.primID),
                Eigen::Vector3f(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z).normalized()};
}

void RayScene::CastMany(const Eigen::Vector3f& from,
                        std::span<const Eigen::Vector3f> directions,
                        std::span<std::uint32_t> surfaces) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  RTCRayHit8 rays = RaysFrom(from);
  alignas(32) std::array<int, kPacket> valid{};
  for (std::size_t first = 0; first < directions.size(); first += kPacket) {
    const std::size_t count = std::min<std::size_t>(kPacket, directions.size() - first);
    for (std::size_t k = 0; k < kPacket; ++k) {
      valid[k] = k < count ? -1 : 0;
      SetRay(rays, k, directions[first + std::min(k, count - 1)]);
    }
    rtcIntersect8(valid.data(), impl_->embree.scene(), &context, &rays);
    for (std::size_t k = 0; k < count; ++k) {
      const bool is_hit = rays.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
      surfaces[first + k] =
          is_hit ? impl_->Surface(rays.hit.geomID[k], rays.hit.primID[k]) : kNoSurface;
    }
  }
}

ViewBuffers RayScene::Render(const PinholeCamera& camera,
                             const Pose& cam_from_local,
                             bool normals) const {
  const float infinity = std::numeric_limits<float>::infinity();
  ViewBuffers buffers;
  buffers.depth = cv::Mat(camera.height, camera.width, CV_32F, cv::Scalar(infinity));
  buffers.surfaces.assign(
      static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height), kNoSurface);
  if (normals) buffers.normals = cv::Mat::zeros(camera.height, camera.width, CV_32FC3);

  const Eigen::Matrix3d local_from_cam =
      cam_from_local.cam_from_world.toRotationMatrix().transpose();
  // Rays have z = 1 in the camera, so that the distance along them is the depth.
  const Eigen::Vector3f step_x = (local_from_cam.col(0) / camera.fx).cast<float>();
  const Eigen::Vector3f origin = cam_from_local.center_in_world.cast<float>();
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  RTCRayHit8 rays = RaysFrom(origin);
  alignas(32) std::array<int, kPacket> valid{};
  for (int y = 0; y < camera.height; ++y) {
    const Eigen::Vector3f row_start =
        (local_from_cam * camera.RayFromImage({0.5, y + 0.5})).cast<float>();
    for (int x = 0; x < camera.width; x += kPacket) {
      for (int k = 0; k < kPacket; ++k) {
        SetRay(rays, static_cast<std::size_t>(k), row_start + static_cast<float>(x + k) * step_x);
        valid[k] = x + k < camera.width ? -1 : 0;
      }
      rtcIntersect8(valid.data(), impl_->embree.scene(), &context, &rays);
      for (int k = 0; k < kPacket && x + k < camera.width; ++k) {
        if (rays.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) continue;
        buffers.depth.at<float>(y, x + k) = rays.ray.tfar[k];
        buffers.surfaces[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width) +
                         static_cast<std::size_t>(x + k)] =
            impl_->Surface(rays.hit.geomID[k], rays.hit.primID[k]);
        if (!normals) continue;
        Eigen::Vector3f normal =
            Eigen::Vector3f(rays.hit.Ng_x[k], rays.hit.Ng_y[k], rays.hit.Ng_z[k]).normalized();
        const Eigen::Vector3f direction(rays.ray.dir_x[k], rays.ray.dir_y[k], rays.ray.dir_z[k]);
        if (normal.dot(direction) > 0.0f) normal = -normal;
        buffers.normals.at<cv::Vec3f>(y, x + k) = {normal.x(), normal.y(), normal.z()};
      }
    }
  }
  return buffers;
}

}  // namespace ridgeline
