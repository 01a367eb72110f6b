// SPDX-License-Identifier: Apache-2.0
#include "eval/bench_queries.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "camera/picture_facts.h"
#include "city/read_city.h"
#include "city/terrain.h"
#include "input/read_picture.h"
#include "input/world.h"

namespace ridgeline {
namespace {

bool NeedsTruth(const Protocol& protocol) {
  return protocol.place == PriorPlace::kNearTruth || protocol.place == PriorPlace::kBesideTruth;
}

// A camera turned clockwise with its picture by EXIF's orientation.
Pose Turned(Pose pose, int orientation) {
  ViewAngles angles = ViewAnglesOf(pose.cam_from_world);
  angles.roll_deg -= OrientationRollDeg(orientation);
  pose.cam_from_world = CamFromWorld(angles);
  return pose;
}

// A place for a camera: on the terrain, if there is one, and in no building.
bool IsFree(const Localizer& localizer, const Eigen::Vector2d& place) {
  const Eigen::Vector2d local = place - localizer.scene().model().origin_in_world.head<2>();
  if (localizer.dtm() != nullptr && !localizer.dtm()->HeightAt(local)) return false;
  return !localizer.footprints().Contains(local);
}

// The terrain around the places of a request and its frame's origin: of the terrain model, or else of
// the model's ground surfaces.
std::pair<HeightGrid, Eigen::Vector3d> TerrainOf(WorldRequest request) {
  if (!request.dtm) {
    request.needs_terrain = true;
    World world = ReadWorld(request);
    return {std::move(world.dtm.value()), world.model.origin_in_world};
  }
  CityOptions city;
  city.project_to = request.crs;
  CityModel frame;
  frame.crs = ReadCityCrs(request.model, city);
  frame.origin_in_world << request.places.min().array().floor().matrix(), 0.0;
  const Eigen::Vector2d origin = frame.origin_in_world.head<2>();
  std::vector<std::string> warnings;  // come again when the world is read
  return {ReadDtm(*request.dtm,
                  frame,
                  request.places.min() - origin,
                  request.places.max() - origin,
                  0.0,
                  warnings),
          frame.origin_in_world};
}

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace

BenchQueries::BenchQueries(Dataset dataset) : dataset_(std::move(dataset)) {
  protocol_.name = "dataset";
  protocol_.words = "the dataset's own priors";
  ChooseUsable();
}

BenchQueries::BenchQueries(Protocol protocol,
                           Dataset dataset,
                           const PoseSpaceOptions& configured,
                           std::vector<Eigen::Vector2d> places)
    : protocol_(std::move(protocol)),
      dataset_(std::move(dataset)),
      configured_(configured),
      places_(std::move(places)) {
  if (protocol_.place == PriorPlace::kPicture) LeaveToPictures(configured);
  ChooseUsable();
  if (protocol_.height != PriorHeight::kDrawn) MeasureHeights();
  if (protocol_.place != PriorPlace::kOtherWorld) return;
  for (Query& query : dataset_.queries) query.truth.reset();
}

void BenchQueries::LeaveToPictures(const PoseSpaceOptions& configured) {
  PictureInputOptions options;
  options.camera_height_m = configured.camera_height_m;
  PictureReader pictures;
  std::optional<Crs> crs;
  for (Query& query : dataset_.queries) {
    const bool stored = query.camera.has_value();  // a truth of the picture as it is stored
    query.camera.reset();
    query.prior.reset();
    pictures_.push_back(CompleteFromPicture(dataset_, true, options, pictures, crs, query));
    if (stored && query.truth) query.truth = Turned(*query.truth, query.orientation);
  }
}

void BenchQueries::ChooseUsable() {
  for (std::size_t q = 0; q < dataset_.queries.size(); ++q) {
    const Query& query = dataset_.queries[q];
    truths_.push_back(query.truth);
    bool is_usable = true;
    if (NeedsTruth(protocol_)) is_usable = query.truth.has_value();
    if (protocol_.place == PriorPlace::kDataset) is_usable = query.prior.has_value();
    if (protocol_.place == PriorPlace::kPicture) {
      is_usable = pictures_[q].prior.has_value() || query.truth.has_value();
    }
    if (is_usable) usable_.push_back(q);
  }
  if (!usable_.empty()) return;
  const bool own = protocol_.place == PriorPlace::kDataset;
  throw InputError(dataset_.file.string(),
                   "queries",
                   own ? "no query with a prior" : "no query with a truth",
                   own ? "priors, --protocol or --perturb" : "a truth to draw priors around");
}

void BenchQueries::Choose(const std::vector<std::string>& ids,
                          const std::vector<std::string>& sets) {
  const std::vector<std::size_t> chosen = ChooseQueries(dataset_, ids, sets);
  std::vector<std::size_t> usable;
  for (const std::size_t q : chosen) {
    const bool is_usable = std::find(usable_.begin(), usable_.end(), q) != usable_.end();
    if (is_usable) usable.push_back(q);
    if (is_usable || ids.empty()) continue;
    throw InputError("--query",
                     "",
                     "\"" + dataset_.queries[q].id + "\"",
                     "a query with what protocol " + protocol_.name + " needs of it");
  }
  if (usable.empty()) {
    throw InputError("--set-name", "", "sets without a query that can be run", "another set");
  }
  usable_ = std::move(usable);
}

void BenchQueries::MeasureHeights() {
  above_terrain_.resize(truths_.size());
  Dataset places = dataset_;
  for (Query& query : places.queries) query.prior.reset();
  constexpr double kMarginM = 5.0;
  WorldRequest request = RequestFor(places, kMarginM);
  if (request.places.isEmpty()) return;
  const auto [dtm, origin] = TerrainOf(request);
  std::vector<double> known;
  for (std::size_t q = 0; q < truths_.size(); ++q) {
    if (!truths_[q]) continue;
    const auto ground = dtm.HeightAt(truths_[q]->center_in_world.head<2>() - origin.head<2>());
    if (!ground) continue;
    above_terrain_[q] = truths_[q]->center_in_world.z() - origin.z() - *ground;
    known.push_back(*above_terrain_[q]);
  }
  if (protocol_.height != PriorHeight::kTerrainOffset) return;
  if (known.empty()) {
    throw InputError(
        dataset_.file.string(), "dtm", "no height at any truth", "a terrain model under the truths");
  }
  set_offset_m_ = Median(std::move(known));
}

SearchStart BenchQueries::Start(std::size_t query,
                                std::uint64_t seed,
                                const Localizer& localizer) const {
  const Query& of = dataset_.queries[query];
  const PoseSpaceOptions& configured =
      configured_ ? *configured_ : localizer.options().search.space;
  if (protocol_.place == PriorPlace::kDataset) return {*of.prior, configured};
  DrawContext context;
  context.configured = configured;
  if (!above_terrain_.empty()) context.height_above_terrain = above_terrain_[query];
  context.set_offset_m = set_offset_m_;
  context.is_free = [&](const Eigen::Vector2d& place) { return IsFree(localizer, place); };
  const std::optional<Pose>& truth = truths_[query];
  if (protocol_.place == PriorPlace::kOtherWorld) {
    std::optional<ViewAngles> tilt;
    if (truth) {
      tilt = ViewAnglesOf(truth->cam_from_world);
    } else if (of.prior && of.prior->pitch_deg && of.prior->roll_deg) {
      tilt = ViewAngles{0.0, *of.prior->pitch_deg, *of.prior->roll_deg};
    }
    const Eigen::Vector3d origin = localizer.scene().model().origin_in_world;
    const auto terrain = [&](const Eigen::Vector2d& place) -> std::optional<double> {
      if (localizer.dtm() == nullptr) return std::nullopt;
      const auto height = localizer.dtm()->HeightAt(place - origin.head<2>());
      return height ? std::optional<double>(*height + origin.z()) : std::nullopt;
    };
    return DrawElsewhere(protocol_, tilt, places_, terrain, context, seed, of.id);
  }
  if (protocol_.place == PriorPlace::kPicture && pictures_[query].prior) {
    const PictureInput& made = pictures_[query];
    SearchStart start = DrawStart(protocol_, Pose{}, context, seed, of.id);
    start.prior = *made.prior;
    start.ranges.east_m = start.ranges.north_m = made.horizontal_m;
    if (made.prior->height_in_world) start.ranges.height_m = made.height_m;
    start.ranges.heading_deg = configured.heading_deg;
    start.ranges.pitch_deg = std::max(configured.pitch_deg, made.pitch_deg);
    start.ranges.roll_deg = std::max(configured.roll_deg, made.roll_deg);
    return start;
  }
  return DrawStart(protocol_, *truth, context, seed, of.id);
}

std::vector<std::size_t> ChooseQueries(const Dataset& dataset,
                                       const std::vector<std::string>& ids,
                                       const std::vector<std::string>& sets) {
  const auto holds = [](const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  std::vector<std::string> known_sets;
  for (const Query& query : dataset.queries) {
    if (!query.set.empty() && !holds(known_sets, query.set)) known_sets.push_back(query.set);
  }
  for (const std::string& id : ids) FindQuery(dataset, id, "--query");
  for (const std::string& set : sets) {
    if (holds(known_sets, set)) continue;
    const std::string nearest = NearestName(set, known_sets);
    throw InputError("--set-name",
                     "",
                     "\"" + set + "\"",
                     nearest.empty() ? "nothing: the queries of " + dataset.file.string() +
                                           " have no sets"
                                     : "a set of " + dataset.file.string() + ", e.g. \"" +
                                           nearest + "\"");
  }
  std::vector<std::size_t> chosen;
  for (std::size_t q = 0; q < dataset.queries.size(); ++q) {
    const Query& query = dataset.queries[q];
    const bool of_ids = ids.empty() || holds(ids, query.id);
    if (of_ids && (sets.empty() || holds(sets, query.set))) chosen.push_back(q);
  }
  if (chosen.empty()) {
    throw InputError("--query", "", "no query that is of these sets, too", "ids of --set-name");
  }
  return chosen;
}

std::vector<Eigen::Vector2d> PlacesOf(const Dataset& dataset) {
  std::vector<Eigen::Vector2d> places;
  for (const Query& query : dataset.queries) {
    if (query.truth) {
      places.emplace_back(query.truth->center_in_world.head<2>());
    } else if (query.prior) {
      places.push_back(query.prior->position_in_world);
    }
  }
  if (places.empty()) {
    throw InputError(dataset.file.string(),
                     "queries",
                     "none with a truth or a prior",
                     "places at which pictures of another dataset are searched");
  }
  return places;
}

}  // namespace ridgeline
