// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "synth/detail_mesh.h"

namespace ridgeline {

// Colour of a point of a surface before light falls on it.
struct Paint {
  Eigen::Vector3f albedo = Eigen::Vector3f::Constant(0.5f);  // linear RGB
  float mirror = 0.0f;                                       // share of reflected sky
};

// Plaster, plinth, cornices, windows with frames and curtains, shutters, doors, shop windows.
// @param uv  As in WallLook [m].
Paint PaintFacade(const WallLook& wall, const Eigen::Vector2f& uv);

// Rows of tiles.
Paint PaintRoof(const Eigen::Vector3f& color, const Eigen::Vector3f& point);

// Roadway with lane markings, curb, pavement, yards, fields.
Paint PaintGround(const Town& town, const Eigen::Vector3f& point);

// Value noise in [0, 1], smooth at the given wavelength.
float ValueNoise(const Eigen::Vector2f& at, std::uint64_t key);
// Sum of `octaves` of value noise in [0, 1].
float FractalNoise(const Eigen::Vector2f& at, int octaves, std::uint64_t key);

}  // namespace ridgeline
