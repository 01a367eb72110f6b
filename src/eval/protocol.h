// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "camera/pose.h"
#include "camera/pose_prior.h"
#include "eval/perturb.h"
#include "localize/pose_space.h"

namespace ridgeline {

// Where a protocol's priors lie.
enum class PriorPlace : std::uint8_t {
  kDataset,      // where the dataset says, or the picture itself
  kNearTruth,    // drawn around the truth, which is in the search box
  kBesideTruth,  // so far from the truth that it is not in the box
  kOtherWorld,   // in another place, where the picture was not taken
  kPicture,      // where the picture's own EXIF and XMP say; without a position, as kNearTruth
};

// What is known of the height of a prior.
enum class PriorHeight : std::uint8_t {
  kDrawn,         // drawn around the truth
  kTerrain,       // nothing: the terrain and what a hand's height may be
  kTerrainOffset  // one height above the terrain for the whole set: the median of its truths
};

// What a search is told, and how far it may be off (docs/dataset.md, Named protocols).
struct Protocol {
  std::string name;
  std::string words;  // for people, one line
  PriorPlace place = PriorPlace::kDataset;
  Perturbation error;  // half-ranges of the drawn error and of the search
  PriorHeight height = PriorHeight::kDrawn;
  bool tells_heading = true;
  bool tells_tilt = true;  // else level is assumed, and searched as far as the configuration says

  // Whether a right answer lies in the box, so that recall is defined.
  bool HasRecall() const {
    return place != PriorPlace::kBesideTruth && place != PriorPlace::kOtherWorld;
  }
};

// The named protocols: paper, known-tilt, phone, photo, outside, elsewhere.
std::span<const Protocol> Protocols();
// Throws InputError("--protocol", ...) with the nearest name.
const Protocol& FindProtocol(const std::string& name);
// Of `--perturb TEXT`. Throws InputError("--perturb", ...).
Protocol PerturbedProtocol(const std::string& text);

// What a search is given instead of the truth.
struct SearchStart {
  PosePrior prior;
  PoseSpaceOptions ranges;  // half-ranges around the prior
};

// What a draw may look at.
struct DrawContext {
  PoseSpaceOptions configured;                 // what the protocol does not say
  std::optional<double> height_above_terrain;  // of the truth [m]
  double set_offset_m = 0.0;                   // of kTerrainOffset
  // Whether a camera can stand at a place [world: east, north]: on the terrain, in no building.
  std::function<bool(const Eigen::Vector2d&)> is_free;
};

// The prior of a query around its truth, by (seed, query id) alone, so that adding a query changes
// no other. For kNearTruth, kBesideTruth and, for what the picture does not say, kPicture.
SearchStart DrawStart(const Protocol& protocol,
                      const Pose& truth,
                      const DrawContext& context,
                      std::uint64_t seed,
                      const std::string& query_id);

// The prior of a query in another world, at or within 10 m of one of `places` [east, north].
// @param tilt  Of the picture, as far as known; a heading is never told.
// @param terrain  Of the other world; asked for pictures from the air only.
SearchStart DrawElsewhere(
    const Protocol& protocol,
    const std::optional<ViewAngles>& tilt,
    std::span<const Eigen::Vector2d> places,
    const std::function<std::optional<double>(const Eigen::Vector2d&)>& terrain,
    const DrawContext& context,
    std::uint64_t seed,
    const std::string& query_id);

}  // namespace ridgeline
