// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "base/random.h"
#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "synth/renderer.h"
#include "synth/town.h"

namespace ridgeline {

enum class ViewKind : std::uint8_t { kStreet, kTilted, kPortrait, kDrone, kLow, kNadir };

// "street", "tilted", "portrait", "drone", "low", "nadir": the label of the set.
const char* ViewKindName(ViewKind kind);

// Whether such pictures are taken from a drone.
bool IsFromTheAir(ViewKind kind);

// The camera that pictures are taken with.
struct ViewCamera {
  int width = 0;  // [px]; portrait views turn width and height
  int height = 0;
  bool same_for_all = false;  // else its field of view and principal point are drawn each time
};

struct Viewpoint {
  CameraIntrinsics camera;
  Pose cam_from_local;
};

// A place where somebody would take a photo: on a street 1.6 to 1.8 m above the ground, or from a
// drone (40 to 60 m up; low: 10 to 40 m; nadir: 25 to 60 m, straight down), outside buildings, with
// a fair share of buildings in view and nothing right before the lens. Tries again until a view is
// good.
Viewpoint DrawViewpoint(const Town& town,
                        const TownRenderer& renderer,
                        ViewKind kind,
                        const ViewCamera& camera,
                        Random& random);

}  // namespace ridgeline
