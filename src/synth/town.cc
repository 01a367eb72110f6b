// SPDX-License-Identifier: Apache-2.0
#include "synth/town.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "synth/town_block.h"
#include "synth/town_style.h"

namespace ridgeline {
namespace {

constexpr std::uint64_t kCrossingStage = 0x10;
constexpr std::uint64_t kTerrainStage = 0x11;
// Crossings leave the regular lattice by this share of the spacing at most, in each direction.
constexpr double kJitter = 0.11;

}  // namespace

void TownOptions::Visit(OptionVisitor& v) {
  v.Field("seed", seed, NotNegative());
  v.Field("blocks_east", blocks_east, Closed(1, 1000));
  v.Field("blocks_north", blocks_north, Closed(1, 1000));
  v.Field("block_m", block_m, Closed(60.0, 200.0));
  v.Field("relief_m", relief_m, Closed(0.0, 30.0));
  v.Field("style", style, OneOf{TownStyleNames()});
  v.Field("trees", trees, Closed(0.0, 2.0));
}

std::array<Eigen::Vector2d, 4> TownBuilding::Footprint() const {
  const Eigen::Vector2d x(std::cos(direction_rad), std::sin(direction_rad));
  const Eigen::Vector2d y(-x.y(), x.x());
  const Eigen::Vector2d dx = 0.5 * length_m * x;
  const Eigen::Vector2d dy = 0.5 * depth_m * y;
  return {center - dx - dy, center + dx - dy, center + dx + dy, center - dx + dy};
}

double Town::TerrainHeight(const Eigen::Vector2d& xy) const {
  // Four plane waves of 150 to 520 m; their amplitudes sum to the relief.
  constexpr std::array<double, 4> kWavelengthM = {520.0, 330.0, 210.0, 150.0};
  constexpr std::array<double, 4> kShare = {0.5, 0.28, 0.14, 0.08};
  double height = 0.0;
  for (std::size_t i = 0; i < kWavelengthM.size(); ++i) {
    Random random(static_cast<std::uint64_t>(options.seed), kTerrainStage, i);
    const double direction = random.Uniform(0.0, 2.0 * std::numbers::pi);
    const double phase = random.Uniform(0.0, 2.0 * std::numbers::pi);
    const double along = xy.x() * std::cos(direction) + xy.y() * std::sin(direction);
    height += kShare[i] * std::sin(2.0 * std::numbers::pi * along / kWavelengthM[i] + phase);
  }
  return options.relief_m * height;
}

Eigen::Vector2d Town::Crossing(int column, int row) const {
  const auto key = (static_cast<std::uint64_t>(column) << 32) | static_cast<std::uint32_t>(row);
  Random random(static_cast<std::uint64_t>(options.seed), kCrossingStage, key);
  const double reach = kJitter * options.block_m;
  const double east = random.Uniform(-reach, reach);
  const double north = random.Uniform(-reach, reach);
  return {column * options.block_m + east, row * options.block_m + north};
}

Eigen::Vector2d Town::Lower() const {
  Eigen::Vector2d lower = blocks.front().curb[0];
  for (const TownBlock& block : blocks) {
    for (const Eigen::Vector2d& corner : block.curb) lower = lower.cwiseMin(corner);
  }
  return lower;
}

Eigen::Vector2d Town::Upper() const {
  Eigen::Vector2d upper = blocks.front().curb[0];
  for (const TownBlock& block : blocks) {
    for (const Eigen::Vector2d& corner : block.curb) upper = upper.cwiseMax(corner);
  }
  return upper;
}

bool Town::InBuilding(const Eigen::Vector2d& xy, double margin_m) const {
  return std::any_of(buildings.begin(), buildings.end(), [&](const TownBuilding& b) {
    const Eigen::Vector2d x(std::cos(b.direction_rad), std::sin(b.direction_rad));
    const Eigen::Vector2d offset = xy - b.center;
    const double along = std::abs(offset.dot(x));
    const double across = std::abs(offset.x() * x.y() - offset.y() * x.x());
    return along < 0.5 * b.length_m + margin_m && across < 0.5 * b.depth_m + margin_m;
  });
}

Town MakeTown(const TownOptions& options) {
  return MakeTownPart(options, 0, 0, options.blocks_east, options.blocks_north);
}

Town MakeTownPart(const TownOptions& options, int column, int row, int column_end, int row_end) {
  CheckOptions(options, "town");
  Town town;
  town.options = options;
  for (int r = row; r < row_end; ++r) {
    for (int c = column; c < column_end; ++c) AddBlock(c, r, town);
  }
  return town;
}

}  // namespace ridgeline
