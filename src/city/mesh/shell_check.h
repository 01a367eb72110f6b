// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "city/city_model.h"

namespace ridgeline {

// Buildings (and parts) whose surfaces do not close: the area vectors of a closed shell add up to
// zero, wherever its vertices lie, so T-junctions do not count as gaps. Two gaps that face each
// other exactly cancel and go unseen. Ascending indices.
std::vector<std::uint32_t> FindOpenShells(const CityModel& model);

// Buildings whose own surfaces cross each other by more than a centimetre. Ascending indices.
std::vector<std::uint32_t> FindCrossingShells(const CityModel& model, int threads);

}  // namespace ridgeline
