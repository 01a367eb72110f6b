// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "camera/intrinsics.h"
#include "score/sky_table.h"

namespace ridgeline {

// Rows at which a skyline crosses the columns of a picture.
//
// @param directions  Unit vectors to the skyline (east, north, height), by azimuth.
// @param camera  Of the size in whose pixels the rows are.
// @param rows  Output, one per column of `camera`; columns that the directions do not reach are NaN.
void SkylineRows(std::span<const Eigen::Vector3f> directions,
                 const PinholeCamera& camera,
                 const Eigen::Matrix3f& cam_from_world,
                 std::span<float> rows);

// The same for directions at azimuths `first_azimuth` + i * `step` [rad, step > 0]: those beside the
// picture are passed over, which makes the whole circle cost no more than what is in view.
void SkylineRows(std::span<const Eigen::Vector3f> directions,
                 double first_azimuth,
                 double step,
                 const PinholeCamera& camera,
                 const Eigen::Matrix3f& cam_from_world,
                 std::span<float> rows);

// Mean of the table's log ratios over the columns; unknown columns count 0.
double SkyLogRatio(const SkyTable& table, std::span<const float> rows);

}  // namespace ridgeline
