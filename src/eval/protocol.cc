// SPDX-License-Identifier: Apache-2.0
#include "eval/protocol.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "base/random.h"

namespace ridgeline {
namespace {

// A hand holds a camera 1.2 to 2.0 m above ground; terrain models are off by some decimetres, and
// vans carry theirs higher.
constexpr double kHandHeightM = 1.6;
constexpr double kHandHeightRangeM = 1.0;
// A camera higher than this above the terrain flies, and knows its height as barometers do.
constexpr double kFlyingM = 5.0;
constexpr double kFlyingErrorM = 10.0;

// The box of kBesideTruth: its middle is so far from the truth [m].
constexpr double kNearestBesideM = 25.0;
constexpr double kFarthestBesideM = 40.0;
// Draws until the middle of a box is a place for a camera; then it is taken as it is.
constexpr int kMaxDraws = 200;

// Streams of one query beside that of DrawPrior, which is 0.
enum Stream : std::uint64_t { kBesideStream = 1, kElsewhereStream = 2 };

const std::array<Protocol, 6> kProtocols = {{
    {"paper",
     "position ±10 m, terrain + one height for the set, heading ±20°, level (Loeper et al.)",
     PriorPlace::kNearTruth,
     {10.0, 10.0, 0.0, 20.0, 0.0, 0.0},
     PriorHeight::kTerrainOffset,
     true,
     false},
    {"known-tilt",
     "position ±10 m, true height, heading ±20°, true pitch and roll",
     PriorPlace::kNearTruth,
     {10.0, 10.0, 0.0, 20.0, 0.0, 0.0},
     PriorHeight::kDrawn,
     true,
     true},
    {"phone",
     "position ±20 m, height and heading unknown, pitch and roll ±8°",
     PriorPlace::kNearTruth,
     {20.0, 20.0, kFlyingErrorM, 180.0, 8.0, 8.0},
     PriorHeight::kTerrain,
     false,
     true},
    {"photo",
     "what the file says (GNSS, EXIF; camera too), else position ±20 m and nothing more",
     PriorPlace::kPicture,
     {20.0, 20.0, kFlyingErrorM, 180.0, 0.0, 0.0},
     PriorHeight::kTerrain,
     false,
     false},
    {"outside",
     "box of ±10 m, 25 to 40 m beside the truth; height unknown, heading ±20°, pitch and roll ±8°",
     PriorPlace::kBesideTruth,
     {10.0, 10.0, kFlyingErrorM, 20.0, 8.0, 8.0},
     PriorHeight::kTerrain,
     true,
     true},
    {"elsewhere",
     "box of ±20 m in another place; height and heading unknown, pitch and roll ±8°",
     PriorPlace::kOtherWorld,
     {20.0, 20.0, kFlyingErrorM, 180.0, 8.0, 8.0},
     PriorHeight::kTerrain,
     false,
     true},
}};

bool Flies(const DrawContext& context) {
  return context.height_above_terrain.value_or(0.0) > kFlyingM;
}

// The search's half-ranges, where the protocol says nothing those of the configuration.
PoseSpaceOptions SearchRanges(const Protocol& protocol, const DrawContext& context) {
  PoseSpaceOptions ranges = context.configured;
  ranges.east_m = protocol.error.east_m;
  ranges.north_m = protocol.error.north_m;
  ranges.height_m = protocol.error.height_m;
  ranges.heading_deg = protocol.error.heading_deg;
  if (protocol.tells_tilt) {
    ranges.pitch_deg = protocol.error.pitch_deg;
    ranges.roll_deg = protocol.error.roll_deg;
  }
  if (protocol.height == PriorHeight::kTerrainOffset) {
    ranges.camera_height_m = context.set_offset_m;
  } else if (protocol.height == PriorHeight::kTerrain && !Flies(context)) {
    ranges.camera_height_m = kHandHeightM;
    ranges.height_m = ranges.camera_height_range_m = kHandHeightRangeM;
  }
  return ranges;
}

// Drops what the protocol does not tell.
void Forget(const Protocol& protocol, const DrawContext& context, PosePrior& prior) {
  const bool tells_height = protocol.height == PriorHeight::kDrawn ||
                            (protocol.height == PriorHeight::kTerrain && Flies(context));
  if (!tells_height) prior.height_in_world.reset();
  if (!protocol.tells_heading) prior.heading_deg.reset();
  if (!protocol.tells_tilt) {
    prior.pitch_deg.reset();
    prior.roll_deg.reset();
  }
}

Eigen::Vector2d DrawBeside(const Eigen::Vector2d& truth,
                           const DrawContext& context,
                           Random random) {
  Eigen::Vector2d place = truth;
  for (int i = 0; i < kMaxDraws; ++i) {
    const double distance_m = random.Uniform(kNearestBesideM, kFarthestBesideM);
    const double azimuth = random.Uniform(0.0, 2.0 * std::numbers::pi);
    place = truth + distance_m * Eigen::Vector2d(std::sin(azimuth), std::cos(azimuth));
    if (context.is_free(place)) break;
  }
  return place;
}

}  // namespace

std::span<const Protocol> Protocols() { return kProtocols; }

const Protocol& FindProtocol(const std::string& name) {
  std::vector<std::string> names;
  std::string list;
  for (const Protocol& protocol : kProtocols) {
    if (protocol.name == name) return protocol;
    names.push_back(protocol.name);
    list += (list.empty() ? "" : ", ") + protocol.name;
  }
  throw InputError("--protocol",
                   "",
                   "\"" + name + "\"",
                   list + " (nearest: \"" + NearestName(name, names) + "\")");
}

Protocol PerturbedProtocol(const std::string& text) {
  Protocol protocol;
  protocol.name = "perturb " + text;
  protocol.words = "drawn around the truth within ±(east, north, height, heading[, pitch, roll]) " +
                   text + " m and degrees";
  protocol.place = PriorPlace::kNearTruth;
  protocol.error = ParsePerturbation(text);
  return protocol;
}

SearchStart DrawStart(const Protocol& protocol,
                      const Pose& truth,
                      const DrawContext& context,
                      std::uint64_t seed,
                      const std::string& query_id) {
  SearchStart start{DrawPrior(truth, protocol.error, seed, query_id),
                    SearchRanges(protocol, context)};
  if (protocol.place == PriorPlace::kBesideTruth) {
    start.prior.position_in_world = DrawBeside(
        truth.center_in_world.head<2>(), context, Random(seed, HashText(query_id), kBesideStream));
  }
  Forget(protocol, context, start.prior);
  return start;
}

SearchStart DrawElsewhere(
    const Protocol& protocol,
    const std::optional<ViewAngles>& tilt,
    std::span<const Eigen::Vector2d> places,
    const std::function<std::optional<double>(const Eigen::Vector2d&)>& terrain,
    const DrawContext& context,
    std::uint64_t seed,
    const std::string& query_id) {
  constexpr double kAroundPlaceM = 10.0;
  Random random(seed, HashText(query_id), kElsewhereStream);
  Eigen::Vector2d place = places.front();
  for (int i = 0; i < kMaxDraws; ++i) {
    place = places[random.Below(places.size())];
    place.x() += random.Uniform(-kAroundPlaceM, kAroundPlaceM);
    place.y() += random.Uniform(-kAroundPlaceM, kAroundPlaceM);
    if (context.is_free(place)) break;
  }
  // A picture of the same tilt and height above ground as the query, in the other place.
  Pose taken;
  taken.cam_from_world = CamFromWorld(tilt.value_or(ViewAngles{}));
  taken.center_in_world << place, 0.0;
  if (Flies(context)) {
    taken.center_in_world.z() = terrain(place).value_or(0.0) + *context.height_above_terrain;
  }
  SearchStart start{DrawPrior(taken, protocol.error, seed, query_id),
                    SearchRanges(protocol, context)};
  start.prior.position_in_world = place;
  Forget(protocol, context, start.prior);
  if (!tilt) {
    start.prior.pitch_deg.reset();
    start.prior.roll_deg.reset();
  }
  return start;
}

}  // namespace ridgeline
