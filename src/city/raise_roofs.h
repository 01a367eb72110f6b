// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "city/city_model.h"

namespace ridgeline {

// A roof that is higher or lower than in the model [m].
struct RoofShift {
  std::uint32_t building = 0;  // index into CityModel::buildings
  double up_m = 0.0;
};

// The model with the roofs of some buildings moved up or down, and the tops of their walls with
// them; eaves, ridges and gables keep their shapes.
CityModel WithShiftedRoofs(const CityModel& model, std::span<const RoofShift> shifts);

}  // namespace ridgeline
