// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "projection/simd4.h"
#include "projection/surface_panorama.h"

namespace ridgeline {

// Rays of a camera under a few tilts. A turn about the vertical moves all their azimuths by the
// heading and leaves their elevations: the cells of a panorama behind them cost no trigonometry.
class TiltedRays {
 public:
  // @param rays  Camera axes; any length.
  // @param cam_from_level  Rotations from a level frame (right, ahead, up) into the camera.
  TiltedRays(std::span<const Eigen::Vector3f> rays,
             std::span<const Eigen::Matrix3f> cam_from_level);

  // A rotation as a tilt and a turn.
  struct Turned {
    std::size_t tilt = 0;
    float heading = 0.0f;  // clockwise from north [rad]
  };
  // nullopt: under none of the tilts.
  std::optional<Turned> Find(const Eigen::Matrix3f& cam_from_local) const;

  // Calls visit(i, cells) with the cells behind the rays 4 i to 4 i + 3, -1 outside of the panorama.
  // Behind the last ray follow copies of it.
  template <typename Visit>
  void ForCells(const SurfacePanorama& panorama, const Turned& turned, const Visit& visit) const {
    const auto per_rad = static_cast<float>(1.0 / panorama.step);
    const simd::Float4 turn = simd::Splat(kTurn * per_rad);
    const simd::Float4 shift = simd::Splat(Shift(panorama, turned.heading));
    const simd::Float4 lift =
        simd::Splat(0.5f - static_cast<float>(panorama.first_elevation) * per_rad);
    const std::vector<Directions>& directions = tilts_[turned.tilt].directions;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const simd::Float4 column = directions[i].azimuth * per_rad + shift;
      visit(i,
            panorama.CellsAt({column >= turn ? column - turn : column,
                              directions[i].elevation * per_rad + lift}));
    }
  }

 private:
  static constexpr float kTurn = 6.2831853f;

  struct Directions {
    simd::Float4 azimuth;    // at heading 0, in [0, kTurn)
    simd::Float4 elevation;  // [rad]
  };
  struct Tilt {
    Eigen::Matrix3f cam_from_level;
    std::vector<Directions> directions;  // four rays each
  };

  // What a heading adds to the columns of rays, in [0, a turn).
  static float Shift(const SurfacePanorama& panorama, float heading);

  std::vector<Tilt> tilts_;
};

}  // namespace ridgeline
