// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "projection/scene.h"
#include "report/overlay.h"
#include "score/edge_kind.h"
#include "skyline/skyline.h"

namespace ridgeline {

// Colour and name of a kind of edge; the same in every overlay and in the report.
Rgb EdgeColor(EdgeKind kind);
const char* EdgeName(EdgeKind kind);

// The model's visible edges from a pose (local frame), one layer per kind.
std::vector<OverlayLayer> ModelEdgeLayers(const Scene& scene,
                                          const PinholeCamera& camera,
                                          const Pose& cam_from_local);

// The visible edges of some buildings (indices into CityModel::buildings) in one layer.
OverlayLayer BuildingEdgeLayer(const Scene& scene,
                               const PinholeCamera& camera,
                               const Pose& cam_from_local,
                               const std::vector<std::uint32_t>& buildings,
                               std::string name,
                               const Rgb& color);

// The same edges in one thin grey layer, e.g. for the prior.
OverlayLayer PlainEdgeLayer(const Scene& scene,
                            const PinholeCamera& camera,
                            const Pose& cam_from_local,
                            std::string name);

// The skyline found in the picture, where it is known.
OverlayLayer SkylineLayer(const Skyline& skyline);

// The model's skyline (buildings and terrain) from a pose.
OverlayLayer ModelSkylineLayer(const Scene& scene,
                               const PinholeCamera& camera,
                               const Pose& cam_from_local);

}  // namespace ridgeline
