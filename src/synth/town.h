// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/options.h"

namespace ridgeline {

// A made-up town: blocks between the streets of a jittered lattice on rolling ground, with rows of
// buildings along their sides. Everything follows from the seed and the block's place in the
// lattice, so that a block is the same in a town of any size.
struct TownOptions {
  int seed = 1;
  // Blocks in each direction; a block has about 8 buildings.
  int blocks_east = 3;
  int blocks_north = 3;
  // Mean spacing of the streets [m].
  double block_m = 80.0;
  // Height of the hills [m]; 0: level ground.
  double relief_m = 4.0;
  // Kind of town: "mixed", "suburb" (detached, low), "centre" (closed rows, high), "village",
  // "estate" (long flat blocks).
  std::string style = "mixed";
  // Trees along the streets, as a factor on the usual number.
  double trees = 1.0;

  void Visit(OptionVisitor& v);
};

enum class RoofType : std::uint8_t { kFlat, kGable, kHip, kPyramid, kShed };

// A building or building part on a rectangle. Its own axes: x along the street, y away from it. The
// ridge of gable and hip roofs runs along x, or along y; sheds rise along y, or along x.
struct TownBuilding {
  std::string id;
  int parent = -1;                                   // index of the building this is a part of
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  // local frame [m]
  double direction_rad = 0.0;                        // of x, counter-clockwise from east
  double length_m = 0.0;                             // along x
  double depth_m = 0.0;                              // along y
  double base_m = 0.0;                               // height of the ground surface, local frame
  double floor_m = 0.0;                              // height of the ground floor
  double eaves_m = 0.0;
  double ridge_m = 0.0;  // equal to eaves_m for flat roofs
  int storeys = 1;
  RoofType roof = RoofType::kFlat;
  bool ridge_along_x = true;
  std::uint64_t look = 0;  // key of colours and details

  // Corners of the footprint, counter-clockwise from (-x, -y), local frame.
  std::array<Eigen::Vector2d, 4> Footprint() const;
};

// The ground between the streets, its curb as a counter-clockwise quadrilateral in the local frame.
struct TownBlock {
  std::array<Eigen::Vector2d, 4> curb;
};

struct Town {
  TownOptions options;
  int epsg = 25832;
  Eigen::Vector3d origin_in_world{654000.0, 5412000.0, 400.0};  // local = world - origin
  std::vector<TownBlock> blocks;                                // row-major from the south-west
  std::vector<TownBuilding> buildings;

  // Terrain height in the local frame [m]; defined everywhere.
  double TerrainHeight(const Eigen::Vector2d& xy) const;
  // Crossing (column, row) of two street axes, local frame.
  Eigen::Vector2d Crossing(int column, int row) const;
  // Box around all blocks, local frame.
  Eigen::Vector2d Lower() const;
  Eigen::Vector2d Upper() const;
  // Whether a point is in a building, or closer to one than `margin_m`.
  bool InBuilding(const Eigen::Vector2d& xy, double margin_m = 0.0) const;
};

// Width of the pavement between curb and facades [m].
inline constexpr double kPavementM = 2.6;

// The whole town.
Town MakeTown(const TownOptions& options);

// The part of the town in the blocks [column, column_end) x [row, row_end): for tiles of large
// towns.
Town MakeTownPart(const TownOptions& options, int column, int row, int column_end, int row_end);

}  // namespace ridgeline
