// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ridgeline {

// What the buildings of a kind of town are drawn from.
struct TownStyle {
  std::string name;
  std::array<double, 2> length_m;
  std::array<double, 2> depth_m;
  int fewest_storeys = 2;
  std::uint64_t storeys = 4;  // so many different numbers of them
  // Shares of roofs, summed up in this order; the rest are sheds.
  double gable_below = 0.0;
  double hip_below = 0.0;
  double flat_below = 0.0;
  double terraced_share = 0.6;
  double at_pavement_share = 0.6;  // rows without a front garden
  double most_setback_m = 3.0;
  double most_gap_m = 7.0;  // between detached houses
  double church_share = 0.3;
};

// What TownOptions::style may be.
std::vector<std::string> TownStyleNames();

// Throws InputError("town.style", ...) with the names.
const TownStyle& FindTownStyle(const std::string& name);

}  // namespace ridgeline
