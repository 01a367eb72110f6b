// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "camera/pose.h"
#include "localize/goodness.h"

namespace ridgeline {

enum class LocalizationStatus : std::uint8_t {
  kOk,
  kTooFewLines,     // the picture shows too little to compare
  kNoVisibleModel,  // no admissible pose of the box sees the model
  kAmbiguous,       // poses far apart explain the picture about equally well
  kNotExplained,    // no pose that was looked at shows what the picture shows
  kUnprotected,     // the protection level is above the alert limit
  kDoubtful,        // a pose, with the doubts named
};

// "ok", "too_few_lines", "no_visible_model", "ambiguous", "not_explained", "unprotected",
// "doubtful".
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

// How far a pose may be off.
struct PoseSpread {
  Eigen::Matrix2d position_covariance = Eigen::Matrix2d::Zero();  // east, north [m^2]
  double heading_sigma_deg = 0.0;
  // Of east, north, height [m], heading, pitch, roll [deg], in this order.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

// Bounds that at most one of a thousand answers exceeds, as in the integrity of GNSS (RTCA DO-229:
// protection level).
struct ProtectionLevel {
  double position_m = 0.0;  // horizontal
  double heading_deg = 0.0;
};

// Wall-clock time of a stage.
struct StageTime {
  std::string name;
  double seconds = 0.0;
};

struct Localization {
  LocalizationStatus status = LocalizationStatus::kNoVisibleModel;
  std::string reason;               // of an abstention, in words
  std::vector<std::string> doubts;  // in words
  std::optional<Pose> pose;         // world frame; present for kOk and kDoubtful
  // The focal length that the picture agrees with best, where it was not known for sure [px].
  std::optional<double> focal_px;
  double energy = 1.0;       // of the best mode, [0, 1]
  double confidence = 0.0;   // probability that the pose is within 2 m and 2 degrees
  double posterior_mass = 0.0;  // of the poses near the answer among those of the box
  std::optional<double> above_background;  // SearchedPoses::above_background [nat]
  Goodness goodness;            // of the best mode; not known for scores that judge no buildings
  PoseSpread spread;
  std::optional<ProtectionLevel> protection;  // absent: none can be given
  std::vector<PoseMode> modes;  // best first; filled for kAmbiguous too
  EnergyMap map;
  std::uint64_t evaluations = 0;  // energies computed
  std::vector<StageTime> times;
  std::vector<std::string> notes;  // what was done beyond the box asked for
  std::vector<std::string> warnings;

  // Adds the work of a localization that came before.
  void Include(const Localization& earlier) {
    evaluations += earlier.evaluations;
    times.insert(times.begin(), earlier.times.begin(), earlier.times.end());
    notes.insert(notes.begin(), earlier.notes.begin(), earlier.notes.end());
  }
};

}  // namespace ridgeline
