// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "study/scored_map.h"

namespace ridgeline {

// The truth's neighbourhood: a pose within both limits is right (Loeper et al., table 1).
inline constexpr double kNeighbourhoodM = 2.0;
inline constexpr double kNeighbourhoodDeg = 2.0;
// Where the rank correlation is taken.
inline constexpr double kAroundM = 5.0;
inline constexpr double kAroundDeg = 5.0;

// How far a score can be trusted on one picture, from a dense map of it. NaN: not defined.
struct Reliability {
  std::uint64_t poses = 0;  // admissible
  std::size_t minimum = 0;  // the pose of the least energy, the first of equals
  double minimum_m = 0.0;   // its error
  double minimum_deg = 0.0;
  // Share of the admissible poses that score better than the best one of the truth's neighbourhood;
  // those outside it that score the same count half, so that a score that says nothing gets 1/2.
  // NaN: no pose of the map lies in the neighbourhood.
  double better_share = std::numeric_limits<double>::quiet_NaN();
  // Width of the basin: up to this error at least half of the poses at every distance come home, if
  // each moves to the best of its neighbours in the map until none is better. Position: of poses
  // within 2 degrees; heading: of poses within 2 m. 0: not even from the truth's own surroundings.
  double basin_m = 0.0;
  double basin_deg = 0.0;
  // By how much the best mode stands out from the second (the best local minimum farther than the
  // neighbourhood from it), in log ratios; and as a share of how much it stands out from the median
  // pose, which is comparable between scores. 0: a tie; 1: nothing else stands out.
  double margin_log_ratio = std::numeric_limits<double>::quiet_NaN();
  double margin = 1.0;
  // Spearman's rank correlation of energy with error over the poses within 5 m and 5 degrees of the
  // truth; error in units of the neighbourhood: sqrt((m / 2)^2 + (deg / 2)^2).
  double rank_correlation = std::numeric_limits<double>::quiet_NaN();
};

// nullopt: no admissible pose sees the model.
std::optional<Reliability> ReliabilityOf(const ScoredMap& map);

// Whether a local search from each pose of the map ends in the truth's neighbourhood.
std::vector<char> ComesHome(const ScoredMap& map);

// The poses of a map at one error.
struct ErrorBin {
  double lower = 0.0;  // [m] or [deg]
  double upper = 0.0;
  int poses = 0;
  double home_share = 0.0;
  double best_log_ratio = 0.0;  // -infinity: none sees the model
  double median_log_ratio = 0.0;
};

// By distance from the truth, of the poses within 2 degrees; by angle, of those within 2 m. Bins as
// wide as the map's spacing; without those that hold no pose.
std::vector<ErrorBin> ByDistance(const ScoredMap& map, std::span<const char> comes_home);
std::vector<ErrorBin> ByAngle(const ScoredMap& map, std::span<const char> comes_home);

// Upper end of the last of the bins from the first on in which at least half come home; 0: none.
double BasinWidth(std::span<const ErrorBin> bins);

// Of pairs (x[i], y[i]); equal values share their mean rank. NaN for fewer than three pairs, or if
// one of them does not vary.
double RankCorrelation(std::span<const double> x, std::span<const double> y);

// Middle value, the mean of two; NaN without values. NaNs are left out.
double MedianOf(std::vector<double> values);

}  // namespace ridgeline
