// SPDX-License-Identifier: Apache-2.0
#include "projection/embree_scene.h"

#include <stdexcept>

namespace ridgeline {
namespace {

bool CountMemory(void* counter, ssize_t bytes, bool) {
  static_cast<std::atomic<std::int64_t>*>(counter)->fetch_add(bytes);
  return true;
}

}  // namespace

EmbreeScene::EmbreeScene(RTCSceneFlags flags) : device_(rtcNewDevice("threads=1")) {
  if (device_ == nullptr) throw std::runtime_error("Embree cannot be started");
  rtcSetDeviceMemoryMonitorFunction(device_, CountMemory, &bytes_);
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, flags);
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseScene(scene_);
  rtcSetDeviceMemoryMonitorFunction(device_, nullptr, nullptr);
  rtcReleaseDevice(device_);
}

RTCRay RayAlong(const Eigen::Vector3f& from,
                const Eigen::Vector3f& direction,
                float nearest,
                float farthest) {
  RTCRay ray{};
  ray.org_x = from.x();
  ray.org_y = from.y();
  ray.org_z = from.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tnear = nearest;
  ray.tfar = farthest;
  ray.mask = ~0u;
  return ray;
}

}  // namespace ridgeline
