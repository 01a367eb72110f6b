// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "eval/protocol.h"
#include "input/dataset.h"
#include "input/picture_input.h"
#include "localize/localizer.h"

namespace ridgeline {

// The queries of a dataset as a protocol gives them to a search: the truth goes in here, and only
// priors come out.
class BenchQueries {
 public:
  // Queries with the dataset's own priors.
  explicit BenchQueries(Dataset dataset);

  // @param configured  Half-ranges of the search where the protocol says nothing.
  // @param places  Of kOtherWorld: where pictures could have been taken there [its east, north].
  // Throws InputError if no query can be run, for pictures that cannot be read, and where heights
  // of the ground are needed that neither a terrain model nor the city model gives.
  BenchQueries(Protocol protocol,
               Dataset dataset,
               const PoseSpaceOptions& configured,
               std::vector<Eigen::Vector2d> places = {});

  // Leaves only queries of these ids, and of these sets; an empty list leaves all. The others still
  // count in what a protocol draws of the whole set. Throws InputError for an id or a set that is
  // none, with the nearest, for a query that cannot be run, and if none is left.
  void Choose(const std::vector<std::string>& ids, const std::vector<std::string>& sets);

  const Protocol& protocol() const { return protocol_; }
  // Queries with the cameras that the search is given, and the truths that its answers are judged
  // by: none where no answer is right.
  const Dataset& dataset() const { return dataset_; }
  // Indices into dataset().queries of those that can be run.
  const std::vector<std::size_t>& usable() const { return usable_; }
  // Whether priors leave heights to the terrain.
  bool NeedsTerrain() const { return protocol_.height != PriorHeight::kDrawn; }

  // Prior and half-ranges of a usable query.
  SearchStart Start(std::size_t query, std::uint64_t seed, const Localizer& localizer) const;

 private:
  void LeaveToPictures(const PoseSpaceOptions& configured);
  void ChooseUsable();
  void MeasureHeights();

  Protocol protocol_;
  Dataset dataset_;
  std::optional<PoseSpaceOptions> configured_;        // absent: the localizer's
  std::vector<std::optional<Pose>> truths_;           // of all queries
  std::vector<PictureInput> pictures_;                // of kPicture
  std::vector<std::optional<double>> above_terrain_;  // of the truths [m]
  double set_offset_m_ = 0.0;
  std::vector<Eigen::Vector2d> places_;
  std::vector<std::size_t> usable_;
};

// Indices of the queries of these ids and sets; an empty list: all. Throws InputError for an id or
// a set that is none, with the nearest, and if none is left.
std::vector<std::size_t> ChooseQueries(const Dataset& dataset,
                                       const std::vector<std::string>& ids,
                                       const std::vector<std::string>& sets);

// The places of a dataset's queries [world: east, north]: of its truths, or else of its priors.
// Throws InputError if there is none.
std::vector<Eigen::Vector2d> PlacesOf(const Dataset& dataset);

}  // namespace ridgeline
