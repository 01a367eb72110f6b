// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "replay/loeper_replay.h"

namespace ridgeline {

// Limits of Table 1 of Loeper et al.
struct LoeperLimit {
  double translation_m;
  double rotation_deg;
};
inline constexpr std::array<LoeperLimit, 3> kLoeperLimits = {{{2.0, 2.0}, {5.0, 5.0}, {9.0, 10.0}}};

// A row of Table 1, with what the text of section 5.2 adds to it. Pictures without any pose that
// sees the model count as not localized and have no error.
struct LoeperRow {
  std::size_t method = 0;
  double side_m = 0.0;
  double heading_deg = 0.0;
  int iterations = 0;
  int pictures = 0;
  std::array<double, kLoeperLimits.size()> recall{};
  double mean_translation_m = 0.0;
  double mean_kappa_deg = 0.0;  // signed
  double mean_absolute_kappa_deg = 0.0;
  double mad_translation_m = 0.0;  // mean absolute deviation from the mean
  double mad_kappa_deg = 0.0;      // of the signed errors
};

// One row per method, box and number of iterations, in this order. The rotation error is that of
// kappa, as in the paper: the other two angles are not searched.
std::vector<LoeperRow> LoeperTable(std::span<const LoeperRun> runs,
                                   std::span<const int> iterations);

// The paper's own: 20 x 20 m, +- 20 degrees, 30 pictures.
struct LoeperPrinted {
  std::array<double, kLoeperLimits.size()> recall = {0.0385, 0.2308, 0.3462};
  double mean_translation_m = 8.9;
  double mean_kappa_deg = -2.23;
  double mad_translation_m = 4.88;
  double mad_kappa_deg = 14.02;
};

}  // namespace ridgeline
