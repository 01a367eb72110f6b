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

enum class ViewKind : std::uint8_t { kStreet, kTilted, kPortrait, kDrone };

// "street", "tilted", "portrait", "drone": the label of the set.
const char* ViewKindName(ViewKind kind);

struct Viewpoint {
  CameraIntrinsics camera;
  Pose cam_from_local;
};

// A place where somebody would take a photo: on a street 1.6 to 1.8 m above the ground, or 40 to 60
// m up for a drone, outside buildings, with a fair share of buildings in view and nothing right
// before the lens. Tries again until a view is good. Portrait views turn width and height.
Viewpoint DrawViewpoint(const Town& town,
                        const TownRenderer& renderer,
                        ViewKind kind,
                        int width,
                        int height,
                        Random& random);

}  // namespace ridgeline
