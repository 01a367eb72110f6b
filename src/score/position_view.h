// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "projection/scene.h"
#include "projection/surface_panorama.h"
#include "score/edge_kind.h"
#include "score/surface_groups.h"

namespace ridgeline {

// All that the scores need of a position, for any orientation within a range.
struct PositionView {
  VisibleSet visible;
  std::vector<EdgeKind> kinds;           // of the pieces
  std::vector<Eigen::Vector3f> skyline;  // unit vectors to the skyline, by azimuth
  SurfacePanorama surfaces;
  SurfaceGroups groups;  // of the surfaces
};

// Which parts of a view a score reads; the others are left empty.
struct ViewParts {
  bool edges_and_skyline = true;
  bool surfaces = true;
};

PositionView ViewFrom(const Scene& scene,
                      const Eigen::Vector3d& position,
                      const PanoramaRange& range,
                      const ViewParts& parts);

// Directions that a camera can see within half-ranges [deg] of heading, pitch and roll around
// `center`; `step` [rad] is that of the panorama.
PanoramaRange RangeOf(const PinholeCamera& camera,
                      const ViewAngles& center,
                      const ViewAngles& half_ranges,
                      double step);

}  // namespace ridgeline
