// SPDX-License-Identifier: Apache-2.0
#include "eval/bench_task.h"

#include <optional>
#include <utility>

#include "base/error.h"
#include "eval/protocol.h"
#include "input/picture_input.h"

namespace ridgeline {
namespace {

// Absent: the dataset's own priors.
std::optional<Protocol> ProtocolOf(const BenchRequest& request) {
  std::optional<Protocol> protocol;
  if (!request.perturb.empty()) protocol = PerturbedProtocol(request.perturb);
  if (!request.protocol.empty()) protocol = FindProtocol(request.protocol);
  const bool elsewhere = protocol && protocol->place == PriorPlace::kOtherWorld;
  if (elsewhere && request.world.empty()) {
    throw InputError("--world", "", "nothing", "the dataset.json of the place that is searched");
  }
  if (!elsewhere && !request.world.empty()) {
    throw InputError("--world", "", request.world, "--protocol elsewhere with it");
  }
  return protocol;
}

}  // namespace

BenchTask ReadBenchTask(const BenchRequest& request, const LocalizerOptions& options) {
  Dataset dataset = ReadDataset(request.dataset);
  const std::optional<Protocol> protocol = ProtocolOf(request);
  const PriorPlace place = protocol ? protocol->place : PriorPlace::kDataset;
  std::size_t asked = 0;
  if (place != PriorPlace::kPicture) {
    PictureInputOptions pictures;
    pictures.camera_height_m = options.search.space.camera_height_m;
    asked = CompleteFromPictures(dataset, place == PriorPlace::kDataset, pictures);
  }
  if (!protocol) return {BenchQueries(dataset), dataset, asked};
  if (place != PriorPlace::kOtherWorld) {
    BenchQueries queries(*protocol, std::move(dataset), options.search.space);
    Dataset searched = queries.dataset();
    return {std::move(queries), std::move(searched), asked};
  }
  Dataset other = ReadDataset(request.world);
  dataset.name += " in " + other.name;
  BenchQueries queries(
      *protocol, std::move(dataset), options.search.space, PlacesOf(other));
  return {std::move(queries), std::move(other), asked};
}

World ReadWorldOf(const BenchTask& task) {
  // Places are those of truths and priors; a box beside the truth reaches further.
  const bool is_beside = task.queries.protocol().place == PriorPlace::kBesideTruth;
  WorldRequest request = RequestFor(task.searched, is_beside ? 100.0 : 50.0);
  request.needs_terrain = request.needs_terrain || task.queries.NeedsTerrain();
  return ReadWorld(request);
}

}  // namespace ridgeline
