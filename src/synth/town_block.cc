// SPDX-License-Identifier: Apache-2.0
#include "synth/town_block.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/angle.h"
#include "base/random.h"
#include "synth/town_style.h"

namespace ridgeline {
namespace {

using Eigen::Vector2d;

constexpr std::uint64_t kBlockStage = 0x20;
// Rows on the east and west side leave room for the buildings at the corners [m].
constexpr double kCornerRoomM = 15.5;
constexpr double kCornerMarginM = 2.0;

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
Vector2d Left(const Vector2d& v) { return {-v.y(), v.x()}; }

// Moves side i of a counter-clockwise quadrilateral inwards by inset_m[i].
std::array<Vector2d, 4> Inset(const std::array<Vector2d, 4>& quad,
                              const std::array<double, 4>& inset_m) {
  std::array<Vector2d, 4> start;
  std::array<Vector2d, 4> along;
  for (int i = 0; i < 4; ++i) {
    along[i] = (quad[(i + 1) % 4] - quad[i]).normalized();
    start[i] = quad[i] + inset_m[i] * Left(along[i]);
  }
  std::array<Vector2d, 4> result;
  for (int i = 0; i < 4; ++i) {
    const int before = (i + 3) % 4;
    const double t = Cross(start[i] - start[before], along[i]) / Cross(along[before], along[i]);
    result[i] = start[before] + t * along[before];
  }
  return result;
}

// Whether two rectangles overlap by more than 2 cm (separating axes).
bool Overlap(const TownBuilding& a, const TownBuilding& b) {
  const auto corners_a = a.Footprint();
  const auto corners_b = b.Footprint();
  for (const double direction : {a.direction_rad, b.direction_rad}) {
    for (const double turn : {0.0, std::numbers::pi / 2}) {
      const Vector2d axis(std::cos(direction + turn), std::sin(direction + turn));
      double low_a = 1e300, high_a = -1e300, low_b = 1e300, high_b = -1e300;
      for (int i = 0; i < 4; ++i) {
        low_a = std::min(low_a, axis.dot(corners_a[i]));
        high_a = std::max(high_a, axis.dot(corners_a[i]));
        low_b = std::min(low_b, axis.dot(corners_b[i]));
        high_b = std::max(high_b, axis.dot(corners_b[i]));
      }
      if (low_a > high_b - 0.02 || low_b > high_a - 0.02) return false;
    }
  }
  return true;
}

class BlockBuilder {
 public:
  BlockBuilder(int column, int row, Town& town)
      : town_(town),
        style_(FindTownStyle(town.options.style)),
        random_(static_cast<std::uint64_t>(town.options.seed),
                kBlockStage,
                (static_cast<std::uint64_t>(column) << 32) | static_cast<std::uint32_t>(row)),
        prefix_("TOWN_" + std::to_string(column) + "_" + std::to_string(row) + "_"),
        first_(town.buildings.size()) {
    const std::array<Vector2d, 4> axes = {town.Crossing(column, row),
                                          town.Crossing(column + 1, row),
                                          town.Crossing(column + 1, row + 1),
                                          town.Crossing(column, row + 1)};
    curb_ = Inset(
        axes,
        {HalfRoadM(row, 1), HalfRoadM(column + 1, 0), HalfRoadM(row + 1, 1), HalfRoadM(column, 0)});
    front_ = Inset(curb_, {kPavementM, kPavementM, kPavementM, kPavementM});
  }

  void Build() {
    town_.blocks.push_back({curb_});
    if (random_.Uniform() < style_.church_share) AddChurch();
    for (const int side : {0, 2}) AddRow(side, kCornerMarginM);
    for (const int side : {1, 3}) AddRow(side, kCornerRoomM);
  }

 private:
  // Half the width of a street's roadway [m]; one value along the whole street.
  double HalfRoadM(int line, int orientation) const {
    Random random(static_cast<std::uint64_t>(town_.options.seed),
                  kBlockStage + 1,
                  static_cast<std::uint64_t>(2 * line + orientation));
    return random.Uniform(3.4, 5.6);
  }

  // Buildings along one side, from its start to its end.
  void AddRow(int side, double margin_m) {
    const Vector2d start = front_[side];
    const Vector2d end = front_[(side + 1) % 4];
    const Vector2d along = (end - start).normalized();
    const double length = (end - start).norm() - margin_m;
    const bool terraced = random_.Uniform() < style_.terraced_share;
    const double setback = random_.Uniform() < style_.at_pavement_share
                               ? 0.0
                               : random_.Uniform(0.5, style_.most_setback_m);
    double at = margin_m;
    while (length - at > 8.0) {
      TownBuilding building = DrawBuilding();
      building.length_m = std::min(building.length_m, length - at);
      const double back = terraced ? setback : setback + random_.Uniform(0.0, 1.5);
      building.direction_rad = std::atan2(along.y(), along.x());
      building.center = start + (at + 0.5 * building.length_m) * along +
                        (back + 0.5 * building.depth_m) * Left(along);
      at += building.length_m +
            (terraced && random_.Uniform() < 0.85 ? 0.0 : random_.Uniform(2.5, style_.most_gap_m));
      PutOnGround(building);
      if (Add(building) && random_.Uniform() < 0.3) AddAnnex();
    }
  }

  TownBuilding DrawBuilding() {
    TownBuilding building;
    building.length_m = random_.Uniform(style_.length_m[0], style_.length_m[1]);
    building.depth_m = random_.Uniform(style_.depth_m[0], style_.depth_m[1]);
    building.storeys = style_.fewest_storeys + static_cast<int>(random_.Below(style_.storeys));
    const double kind = random_.Uniform();
    building.roof = kind < style_.gable_below  ? RoofType::kGable
                    : kind < style_.hip_below  ? RoofType::kHip
                    : kind < style_.flat_below ? RoofType::kFlat
                                               : RoofType::kShed;
    building.ridge_along_x = random_.Uniform() < 0.75;
    building.look = random_.Next();
    return building;
  }

  // Base on the lowest ground around, floor on the highest, eaves and ridge above it.
  void PutOnGround(TownBuilding& building) {
    double lowest = 1e300;
    double highest = -1e300;
    for (const Vector2d& corner : building.Footprint()) {
      const double height = town_.TerrainHeight(corner);
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
    }
    building.base_m = lowest - 0.1;
    building.floor_m = highest + random_.Uniform(0.1, 0.5);
    building.eaves_m =
        building.floor_m + building.storeys * random_.Uniform(2.9, 3.5) + random_.Uniform(0.1, 0.6);
    const double span = building.ridge_along_x ? building.depth_m : building.length_m;
    double rise = 0.0;
    switch (building.roof) {
      case RoofType::kFlat:
        break;
      case RoofType::kGable:
        rise = 0.5 * span * std::tan(random_.Uniform(32.0, 48.0) * kRadPerDeg);
        break;
      case RoofType::kHip:
        rise = 0.5 * std::min(building.length_m, building.depth_m) *
               std::tan(random_.Uniform(30.0, 45.0) * kRadPerDeg);
        break;
      case RoofType::kPyramid:
        rise = 0.5 * span * std::tan(random_.Uniform(60.0, 72.0) * kRadPerDeg);
        break;
      case RoofType::kShed:
        rise = span * std::tan(random_.Uniform(8.0, 16.0) * kRadPerDeg);
        break;
    }
    building.ridge_m = building.eaves_m + rise;
  }

  // A lower flat part behind the building added last.
  void AddAnnex() {
    const int parent = static_cast<int>(town_.buildings.size()) - 1;
    const TownBuilding& main = town_.buildings.back();
    const Vector2d along(std::cos(main.direction_rad), std::sin(main.direction_rad));
    TownBuilding annex = main;
    annex.parent = parent;
    annex.length_m = main.length_m * random_.Uniform(0.4, 0.8);
    annex.depth_m = random_.Uniform(3.0, 6.0);
    annex.center =
        main.center + 0.5 * (main.depth_m + annex.depth_m) * Left(along) +
        0.5 * (main.length_m - annex.length_m) * (random_.Uniform() < 0.5 ? -1 : 1) * along;
    annex.storeys = 1;
    annex.roof = RoofType::kFlat;
    PutOnGround(annex);
    Add(annex);
  }

  // Nave and tower in the middle of the block: a landmark above the roofs.
  void AddChurch() {
    const Vector2d along = (front_[1] - front_[0]).normalized();
    const Vector2d middle = 0.25 * (front_[0] + front_[1] + front_[2] + front_[3]);
    TownBuilding nave;
    nave.length_m = random_.Uniform(16.0, 22.0);
    nave.depth_m = random_.Uniform(9.0, 11.0);
    nave.storeys = 3;
    nave.roof = RoofType::kGable;
    nave.direction_rad = std::atan2(along.y(), along.x());
    nave.center = middle + 3.0 * along;
    nave.look = random_.Next();
    PutOnGround(nave);
    if (!Add(nave)) return;
    TownBuilding tower = nave;
    tower.parent = static_cast<int>(town_.buildings.size()) - 1;
    tower.length_m = tower.depth_m = random_.Uniform(5.5, 7.0);
    tower.center = nave.center - 0.5 * (nave.length_m + tower.length_m) * along;
    tower.storeys = 7;
    tower.roof = RoofType::kPyramid;
    PutOnGround(tower);
    Add(tower);
  }

  // Adds the building unless it overlaps another one of this block.
  bool Add(TownBuilding building) {
    for (std::size_t i = first_; i < town_.buildings.size(); ++i) {
      if (Overlap(building, town_.buildings[i])) return false;
    }
    building.id = prefix_ + std::to_string(town_.buildings.size() - first_);
    town_.buildings.push_back(std::move(building));
    return true;
  }

  Town& town_;
  const TownStyle& style_;
  Random random_;
  std::string prefix_;
  std::size_t first_;
  std::array<Vector2d, 4> curb_;
  std::array<Vector2d, 4> front_;
};

}  // namespace

void AddBlock(int column, int row, Town& town) { BlockBuilder(column, row, town).Build(); }

}  // namespace ridgeline
