// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "city/city_model.h"

namespace ridgeline {

// The model with only those triangles and feature edges whose building comes within `radius_m` of a
// place (local frame; horizontally). Indices of vertices, surfaces and buildings stay what they are.
CityModel NearbyBuildings(const CityModel& model, const Eigen::Vector2d& place, double radius_m);

}  // namespace ridgeline
