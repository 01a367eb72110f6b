// SPDX-License-Identifier: Apache-2.0
#include "study/reliability.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace ridgeline {
namespace {

bool InNeighbourhood(const ScoredMap& map, std::size_t pose) {
  return map.TranslationM(pose) <= kNeighbourhoodM && map.RotationDeg(pose) <= kNeighbourhoodDeg;
}

// Distance of two poses of a map, in units of the neighbourhood's larger limit.
bool FarApart(const PoseVolume& volume, std::size_t a, std::size_t b) {
  const PoseSpace::Offset p = volume.OffsetOf(a, {});
  const PoseSpace::Offset q = volume.OffsetOf(b, {});
  const double distance =
      std::hypot(p.east_m - q.east_m, p.north_m - q.north_m, p.height_m - q.height_m);
  const double angle = std::hypot(HeadingDifferenceDeg(p.heading_deg, q.heading_deg),
                                  p.pitch_deg - q.pitch_deg,
                                  p.roll_deg - q.roll_deg);
  return distance > kNeighbourhoodM || angle > kNeighbourhoodDeg;
}

double BetterShare(const ScoredMap& map, std::uint64_t admissible) {
  const std::vector<float>& values = map.volume.log_ratios;
  std::optional<float> best_near;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!map.Admissible(i) || !InNeighbourhood(map, i)) continue;
    best_near = std::max(best_near.value_or(values[i]), values[i]);
  }
  if (!best_near) return std::numeric_limits<double>::quiet_NaN();
  double better = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!map.Admissible(i) || InNeighbourhood(map, i)) continue;
    better += values[i] > *best_near ? 1.0 : values[i] == *best_near ? 0.5 : 0.0;
  }
  return better / static_cast<double>(admissible);
}

void AddMargin(const ScoredMap& map, Reliability& figures) {
  const PoseVolume& volume = map.volume;
  const double best = volume.log_ratios[figures.minimum];
  std::optional<double> second;
  std::vector<double> finite;
  for (std::size_t i = 0; i < volume.log_ratios.size(); ++i) {
    const double value = volume.log_ratios[i];
    if (!std::isfinite(value)) continue;
    finite.push_back(value);
    if (second && value <= *second) continue;
    if (FarApart(volume, i, figures.minimum) && BestNeighbour(volume, i) == i) second = value;
  }
  if (!second) return;
  figures.margin_log_ratio = best - *second;
  const double depth = best - MedianOf(std::move(finite));
  figures.margin = depth > 0.0 ? std::min(1.0, figures.margin_log_ratio / depth) : 0.0;
}

double CorrelationAround(const ScoredMap& map) {
  std::vector<double> energy;
  std::vector<double> error;
  for (std::size_t i = 0; i < map.poses(); ++i) {
    const double m = map.TranslationM(i);
    const double deg = map.RotationDeg(i);
    if (!map.Admissible(i) || m > kAroundM || deg > kAroundDeg) continue;
    energy.push_back(-map.volume.log_ratios[i]);
    error.push_back(std::hypot(m / kNeighbourhoodM, deg / kNeighbourhoodDeg));
  }
  return RankCorrelation(energy, error);
}

// Ranks from 0; equal values share the mean of theirs.
std::vector<double> RanksOf(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t from = 0; from < order.size();) {
    std::size_t to = from + 1;
    while (to < order.size() && values[order[to]] == values[order[from]]) ++to;
    for (std::size_t i = from; i < to; ++i) {
      ranks[order[i]] = 0.5 * static_cast<double>(from + to - 1);
    }
    from = to;
  }
  return ranks;
}

std::vector<ErrorBin> Bins(const ScoredMap& map,
                           std::span<const char> comes_home,
                           double width,
                           double (ScoredMap::*error)(std::size_t) const,
                           double (ScoredMap::*other)(std::size_t) const,
                           double other_limit) {
  std::map<int, std::vector<std::size_t>> poses;
  for (std::size_t i = 0; i < map.poses(); ++i) {
    if (!map.Admissible(i) || (map.*other)(i) > other_limit) continue;
    poses[static_cast<int>((map.*error)(i) / width)].push_back(i);
  }
  std::vector<ErrorBin> bins;
  for (const auto& [k, members] : poses) {
    ErrorBin bin;
    bin.lower = k * width;
    bin.upper = (k + 1) * width;
    bin.poses = static_cast<int>(members.size());
    std::vector<double> values;
    for (const std::size_t i : members) {
      bin.home_share += comes_home[i] ? 1.0 : 0.0;
      values.push_back(map.volume.log_ratios[i]);
    }
    bin.home_share /= bin.poses;
    bin.best_log_ratio = *std::max_element(values.begin(), values.end());
    bin.median_log_ratio = MedianOf(std::move(values));
    bins.push_back(bin);
  }
  return bins;
}

double StepOf(const std::vector<double>& axis, double fallback) {
  return axis.size() > 1 ? axis[1] - axis[0] : fallback;
}

}  // namespace

std::vector<char> ComesHome(const ScoredMap& map) {
  const PoseVolume& volume = map.volume;
  std::vector<std::size_t> order(map.poses());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return volume.log_ratios[a] > volume.log_ratios[b];
  });
  // Best first: where a pose moves to is known before the pose is.
  std::vector<char> home(map.poses(), 0);
  for (const std::size_t pose : order) {
    if (!map.Admissible(pose)) continue;
    const std::size_t next = BestNeighbour(volume, pose);
    home[pose] = next == pose ? InNeighbourhood(map, pose) : home[next];
  }
  return home;
}

std::vector<ErrorBin> ByDistance(const ScoredMap& map, std::span<const char> comes_home) {
  return Bins(map,
              comes_home,
              StepOf(map.volume.east_m, 1.0),
              &ScoredMap::TranslationM,
              &ScoredMap::RotationDeg,
              kNeighbourhoodDeg);
}

std::vector<ErrorBin> ByAngle(const ScoredMap& map, std::span<const char> comes_home) {
  return Bins(map,
              comes_home,
              StepOf(map.volume.heading_deg, 1.0),
              &ScoredMap::RotationDeg,
              &ScoredMap::TranslationM,
              kNeighbourhoodM);
}

double BasinWidth(std::span<const ErrorBin> bins) {
  double width = 0.0;
  for (const ErrorBin& bin : bins) {
    if (bin.home_share < 0.5) break;
    width = bin.upper;
  }
  return width;
}

std::optional<Reliability> ReliabilityOf(const ScoredMap& map) {
  const std::vector<float>& values = map.volume.log_ratios;
  const auto best = std::max_element(values.begin(), values.end());
  if (best == values.end() || !std::isfinite(*best)) return std::nullopt;
  Reliability figures;
  figures.minimum = static_cast<std::size_t>(best - values.begin());
  figures.minimum_m = map.TranslationM(figures.minimum);
  figures.minimum_deg = map.RotationDeg(figures.minimum);
  figures.poses =
      map.volume.orientations() *
      static_cast<std::uint64_t>(std::count(map.admissible.begin(), map.admissible.end(), char{1}));
  figures.better_share = BetterShare(map, figures.poses);
  const std::vector<char> home = ComesHome(map);
  figures.basin_m = BasinWidth(ByDistance(map, home));
  figures.basin_deg = BasinWidth(ByAngle(map, home));
  AddMargin(map, figures);
  figures.rank_correlation = CorrelationAround(map);
  return figures;
}

double RankCorrelation(std::span<const double> x, std::span<const double> y) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  if (x.size() < 3) return kNan;
  const std::vector<double> rx = RanksOf(x);
  const std::vector<double> ry = RanksOf(y);
  const double mean = 0.5 * static_cast<double>(x.size() - 1);
  double xy = 0.0;
  double xx = 0.0;
  double yy = 0.0;
  for (std::size_t i = 0; i < rx.size(); ++i) {
    xy += (rx[i] - mean) * (ry[i] - mean);
    xx += (rx[i] - mean) * (rx[i] - mean);
    yy += (ry[i] - mean) * (ry[i] - mean);
  }
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : kNan;
}

double MedianOf(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  // Without arithmetic on equal infinities.
  if (values.size() % 2 == 1 || values[half - 1] == values[half]) return values[half];
  return 0.5 * (values[half - 1] + values[half]);
}

}  // namespace ridgeline
