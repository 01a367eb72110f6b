// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "camera/pose.h"

namespace ridgeline {

enum class LocalizationStatus : std::uint8_t {
  kOk,
  kTooFewLines,     // the picture shows too little to compare
  kNoVisibleModel,  // no admissible pose of the box sees the model
  kAmbiguous,       // poses far apart explain the picture about equally well
};

// "ok", "too_few_lines", "no_visible_model", "ambiguous".
const char* NameOf(LocalizationStatus status);

// A distinct local minimum of the energy.
struct PoseMode {
  Pose pose;  // world frame
  double energy = 1.0;
};

// Energy over the positions of the search box, the least over all orientations.
struct EnergyMap {
  Eigen::Vector2d first = Eigen::Vector2d::Zero();  // world east, north of value (0, 0), lower left
  double spacing_m = 1.0;
  int columns = 0;
  int rows = 0;
  std::vector<float> energies;      // row-major from south to north; NaN: not admissible
  std::vector<float> headings_deg;  // best heading at each position

  float At(int column, int row) const {
    return energies[static_cast<std::size_t>(row) * columns + column];
  }
};

// 95 % region of a pose.
struct PoseSpread {
  Eigen::Matrix2d position_covariance = Eigen::Matrix2d::Zero();  // east, north [m^2]
  double heading_sigma_deg = 0.0;
};

// Wall-clock time of a stage.
struct StageTime {
  std::string name;
  double seconds = 0.0;
};

struct Localization {
  LocalizationStatus status = LocalizationStatus::kNoVisibleModel;
  std::string reason;        // of an abstention, in words
  std::optional<Pose> pose;  // world frame; absent unless status is kOk
  double energy = 1.0;       // of the best mode, [0, 1]
  double confidence = 0.0;   // probability that the pose is within 2 m and 2 degrees
  PoseSpread spread;
  std::vector<PoseMode> modes;  // best first; filled for kAmbiguous too
  EnergyMap map;
  std::uint64_t evaluations = 0;  // energies computed
  std::vector<StageTime> times;
  std::vector<std::string> warnings;
};

}  // namespace ridgeline
