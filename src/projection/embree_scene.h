// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <atomic>
#include <cstdint>

namespace ridgeline {

// A device and a scene of Embree with meshes of triangles; released together. For .cc files: no
// other header names Embree's types.
class EmbreeScene {
 public:
  explicit EmbreeScene(RTCSceneFlags flags);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  // Adds a mesh as geometry `id`: vertex(i) is an Eigen::Vector3f, triangle(i)[k] the index of a
  // corner. One without triangles is left out.
  void AddMesh(unsigned id,
               std::size_t vertex_count,
               std::size_t triangle_count,
               const auto& vertex,
               const auto& triangle) {
    if (triangle_count == 0) return;
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertex_count));
    for (std::size_t i = 0; i < vertex_count; ++i) {
      Eigen::Map<Eigen::Vector3f>(vertices + 3 * i) = vertex(i);
    }
    auto* const indices =
        static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(geometry,
                                                            RTC_BUFFER_TYPE_INDEX,
                                                            0,
                                                            RTC_FORMAT_UINT3,
                                                            3 * sizeof(std::uint32_t),
                                                            triangle_count));
    for (std::size_t i = 0; i < triangle_count; ++i) {
      for (int k = 0; k < 3; ++k) indices[3 * i + k] = triangle(i)[k];
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_, geometry, id);
    rtcReleaseGeometry(geometry);
  }
  // After the last mesh, before the first ray.
  void Commit() { rtcCommitScene(scene_); }

  RTCScene scene() const { return scene_; }
  // Memory of Embree's structures.
  std::size_t memory_bytes() const { return static_cast<std::size_t>(bytes_); }

 private:
  std::atomic<std::int64_t> bytes_{0};
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

// A ray from `from`, its length in lengths of `direction`.
RTCRay RayAlong(const Eigen::Vector3f& from,
                const Eigen::Vector3f& direction,
                float nearest,
                float farthest);

}  // namespace ridgeline
