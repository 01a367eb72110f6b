// SPDX-License-Identifier: Apache-2.0
#include "eval/localize_task.h"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "base/error.h"

namespace ridgeline {
namespace {

// A prior of the picture's own is searched as far as it may be off, unless the user says otherwise.
void WidenRanges(const PictureInput& made, PoseSpaceOptions& ranges) {
  if (!made.prior) return;
  const PoseSpaceOptions defaults;
  const auto widen = [](double& range, double default_range, double wanted) {
    if (range == default_range) range = std::max(range, wanted);
  };
  widen(ranges.east_m, defaults.east_m, made.horizontal_m);
  widen(ranges.north_m, defaults.north_m, made.horizontal_m);
  widen(ranges.height_m, defaults.height_m, made.height_m);
  widen(ranges.pitch_deg, defaults.pitch_deg, made.pitch_deg);
  widen(ranges.roll_deg, defaults.roll_deg, made.roll_deg);
}

std::string RangesText(const PosePrior& prior, const PoseSpaceOptions& ranges) {
  char text[200];
  std::snprintf(text,
                sizeof(text),
                "within %.0f m east and north, %.0f m up and down, %.0f deg heading, %.0f pitch, "
                "%.0f roll (--set search.pitch_deg=... and the like)",
                std::max(ranges.east_m, ranges.north_m),
                ranges.height_m,
                prior.heading_deg ? ranges.heading_deg : 180.0,
                ranges.pitch_deg,
                ranges.roll_deg);
  return text;
}

}  // namespace

void CompleteTask(LocalizeTask& task, PictureReader& pictures) {
  PictureInputOptions options;
  options.declination_deg = task.declination_deg;
  options.camera_height_m = task.options.search.space.camera_height_m;
  Query& query = task.query();
  std::optional<Crs> crs;
  const PictureInput made =
      CompleteFromPicture(task.dataset, true, options, pictures, crs, query);
  if (!query.prior) {
    throw InputError(query.image.string(),
                     "position",
                     "none in its EXIF or XMP",
                     "--prior FILE with {\"position\": [east, north], \"heading_deg\": ...}");
  }
  if (task.declination_deg && !made.magnetic) {
    throw InputError("--declination",
                     "",
                     "a heading that is not from magnetic north",
                     "no declination (it turns a picture's own magnetic heading)");
  }
  PoseSpaceOptions& ranges = task.options.search.space;
  WidenRanges(made, ranges);
  query.assumptions.push_back({"search", RangesText(*query.prior, ranges), "options"});
  if (task.lines.empty()) return;
  query.lines = task.lines;
  query.assumptions.push_back({"lines", "those of the file; none are detected", task.lines});
}

World ReadWorldOf(LocalizeTask& task) {
  const PoseSpaceOptions& ranges = task.options.search.space;
  World world = ReadWorld(task.dataset, std::max(ranges.east_m, ranges.north_m));
  if (world.dtm_of_model) {
    task.query().assumptions.push_back({"terrain",
                                        "where the model's buildings stand",
                                        task.dataset.model.front().string()});
  }
  return world;
}

void CheckPlace(const LocalizeTask& task, const Localizer& localizer) {
  const PosePrior& prior = *task.query().prior;
  const PoseSpaceOptions& ranges = task.options.search.space;
  const Eigen::Vector2d local =
      prior.position_in_world - localizer.scene().model().origin_in_world.head<2>();
  if (!local.allFinite() || !ranges.free_space) return;
  char place[80];
  std::snprintf(
      place, sizeof(place), "%.1f, %.1f", prior.position_in_world.x(), prior.position_in_world.y());
  const HeightGrid* const dtm = localizer.dtm();
  const auto on_terrain = [&](const Eigen::Vector2d& xy) {
    return dtm == nullptr || dtm->HeightAt(xy).has_value();
  };
  bool terrain_near = false;
  std::optional<PoseSpace> space;
  if (prior.height_in_world || on_terrain(local)) {
    space.emplace(prior, ranges, localizer.scene(), dtm, localizer.footprints());
  }
  constexpr int kSteps = 10;  // each way from the middle
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int j = -kSteps; j <= kSteps; ++j) {
      const double east = ranges.east_m * i / kSteps;
      const double north = ranges.north_m * j / kSteps;
      if (!on_terrain(local + Eigen::Vector2d(east, north))) continue;
      terrain_near = true;
      for (const double height : {0.0, ranges.height_m, -ranges.height_m}) {
        if (space && space->PositionAt(east, north, height)) return;
      }
    }
  }
  if (!terrain_near || !space) {
    throw InputError(task.dataset.dtm ? task.dataset.dtm->string() : "prior",
                     "position",
                     std::string("no terrain at the prior, ") + place,
                     "a terrain model that covers the prior");
  }
  throw InputError("prior",
                   "position",
                   std::string("a place in a building or under ground, ") + place +
                       ", and none outside of it within the search ranges",
                   "a place where a camera can be (or larger search.east_m, search.north_m)");
}

BenchRun RunTask(const LocalizeTask& task,
                 const Localizer& localizer,
                 std::uint64_t seed,
                 int threads,
                 PictureReader& pictures) {
  BenchOptions bench;
  bench.seeds = {static_cast<int>(seed)};
  bench.threads = threads;
  bench.pictures = &pictures;
  return RunBench(BenchQueries(task.dataset), localizer, bench, {}).front();
}

}  // namespace ridgeline
