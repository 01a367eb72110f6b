// SPDX-License-Identifier: Apache-2.0
#include "cli/track_input.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <utility>

#include "base/error.h"
#include "city/crs.h"
#include "input/query_request.h"
#include "cli/track_stream.h"
#include "input/picture_input.h"
#include "input/world.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

// Frames that are all there.
class ListedFrames final : public TrackFrames {
 public:
  ListedFrames(std::unique_ptr<FrameSource> source, std::vector<TrackFrameFacts> facts)
      : source_(std::move(source)), facts_(std::move(facts)) {}

  bool Next(TrackFrameFacts& facts, cv::Mat& picture) override {
    if (next_ == facts_.size()) return false;
    picture = source_->Read(next_);
    facts = facts_[next_++];
    return true;
  }
  std::optional<std::size_t> size() const override { return facts_.size(); }
  std::optional<double> frames_per_second() const override {
    return source_->frames_per_second();
  }

 private:
  std::unique_ptr<FrameSource> source_;
  std::vector<TrackFrameFacts> facts_;
  std::size_t next_ = 0;
};

bool IsDataset(const std::string& input, fs::path& file) {
  std::error_code error;
  file = input;
  if (fs::is_directory(file, error)) {
    file /= "dataset.json";
    return fs::exists(file, error);
  }
  return file.extension() == ".json";
}

void Refuse(const char* option, const char* found, const char* expected) {
  throw InputError(option, "", found, expected);
}

void TakeWorld(WorldRequest request, int threads, TrackWorld& world) {
  request.whole_model = true;
  request.threads = threads;
  World read = ReadWorld(request);
  world.model = std::move(read.model);
  world.dtm = std::move(read.dtm);
  world.warnings = std::move(read.warnings);
}

std::vector<TrackFrameFacts> FactsOf(const FrameSource& source) {
  std::vector<TrackFrameFacts> facts(source.size());
  const std::optional<double> rate = source.frames_per_second();
  for (std::size_t i = 0; i < facts.size(); ++i) {
    facts[i].id = source.id(i);
    if (rate && *rate > 0.0) facts[i].time_s = static_cast<double>(i) / *rate;
  }
  return facts;
}

std::optional<double> TerrainHeight(const TrackWorld& world, const Eigen::Vector2d& place) {
  if (!world.dtm) return std::nullopt;
  const Eigen::Vector3d& origin = world.model.origin_in_world;
  const std::optional<double> height = world.dtm->HeightAt(place - origin.head<2>());
  if (!height) return std::nullopt;
  return *height + origin.z();
}

// The reading of each frame: by id, else by time for frames that have one.
std::map<std::size_t, const SensorReading*> ReadingsOf(const std::vector<SensorReading>& readings,
                                                       const std::vector<TrackFrameFacts>& facts) {
  std::map<std::string, const SensorReading*> by_id;
  for (const SensorReading& reading : readings) by_id[reading.id] = &reading;
  std::map<std::size_t, const SensorReading*> found;
  for (std::size_t i = 0; i < facts.size(); ++i) {
    const auto it = by_id.find(facts[i].id);
    if (it != by_id.end()) found[i] = it->second;
  }
  if (!found.empty()) return found;
  constexpr double kNearS = 0.02;
  for (std::size_t i = 0; i < facts.size(); ++i) {
    for (const SensorReading& reading : readings) {
      if (!facts[i].time_s || !reading.time_s) continue;
      const double since = *reading.time_s - *readings.front().time_s;
      if (std::abs(since - *facts[i].time_s) <= kNearS) found[i] = &reading;
    }
  }
  return found;
}

void TakeSensors(const std::string& file,
                 const SensorOptions& options,
                 std::vector<TrackFrameFacts>& facts,
                 std::optional<PosePrior>& first,
                 const TrackWorld& world) {
  const std::vector<SensorReading> readings = ReadSensors(file);
  const auto found = ReadingsOf(readings, facts);
  if (found.empty()) {
    throw InputError(file,
                     "id",
                     "no row for any frame",
                     "ids like the frames' names, e.g. \"" + facts.front().id + "\"");
  }
  SensorPriors priors(world.model.crs, options);
  for (const auto& [i, reading] : found) {
    TrackFrameFacts& frame = facts[i];
    if (reading->time_s) frame.time_s = reading->time_s;
    frame.speed_m_s = reading->speed_m_s;
    frame.pitch_deg = reading->pitch_deg;
    frame.roll_deg = reading->roll_deg;
    if (frame.roll_deg && options.roll_sense == "counterclockwise") *frame.roll_deg *= -1.0;
    if (reading->latitude_deg && reading->longitude_deg) {
      frame.fix = EastNorth(world.model.crs, *reading->latitude_deg, *reading->longitude_deg);
    }
    std::string missing;
    const std::optional<PosePrior> prior = priors.PriorOf(
        *reading, [&](const Eigen::Vector2d& p) { return TerrainHeight(world, p); }, missing);
    if (!prior) continue;
    frame.heading_deg = prior->heading_deg;
    if (!frame.pitch_deg) frame.pitch_deg = prior->pitch_deg;
    if (!frame.roll_deg) frame.roll_deg = prior->roll_deg;
    if (!first) first = prior;
  }
}

void TakeOdometry(const std::string& file, std::vector<TrackFrameFacts>& facts) {
  const Odometry odometry = ReadOdometry(file);
  std::vector<FrameKey> keys;
  std::map<std::string, double> times;
  for (const Odometry::Row& row : odometry.rows) {
    if (!row.id.empty() && row.time_s) times[row.id] = *row.time_s;
  }
  for (TrackFrameFacts& frame : facts) {
    const auto it = times.find(frame.id);
    if (!frame.time_s && it != times.end()) frame.time_s = it->second;
    keys.push_back({frame.id, frame.time_s});
  }
  const std::vector<FrameMotion> motions = MotionsOf(odometry, keys);
  std::size_t known = 0;
  for (std::size_t i = 0; i < facts.size(); ++i) {
    facts[i].motion = motions[i].motion;
    facts[i].motion_missing = motions[i].missing;
    known += motions[i].motion ? 1 : 0;
  }
  if (known == 0 && facts.size() > 1) {
    throw InputError(file,
                     "",
                     "no motion between any two frames",
                     "the frames' ids or times, or one row per frame (" + odometry.format + ")");
  }
}

// Where the search begins.
void TakeStart(const TrackArguments& arguments,
               const std::optional<PosePrior>& of_dataset,
               const std::optional<PosePrior>& of_sensors,
               TrackWorld& world) {
  if (!arguments.prior.empty()) {
    world.start = ReadPrior(arguments.prior);
    world.start_from = arguments.prior;
  } else if (of_sensors) {
    world.start = *of_sensors;
    world.start_from = "the first reading of " + arguments.sensors;
  } else if (of_dataset) {
    world.start = *of_dataset;
    world.start_from = "the first frame's prior";
  } else {
    throw InputError("--prior", "", "nothing", "a prior file, where the search begins (JSON)");
  }
}

void ReadDatasetTrack(const fs::path& file,
                      const TrackArguments& arguments,
                      const SensorOptions& sensors,
                      int threads,
                      TrackWorld& world) {
  if (!arguments.camera.empty()) {
    Refuse("--camera", "a camera beside a dataset", "the cameras of the dataset");
  }
  Dataset dataset = ReadDataset(file);
  if (!arguments.model.empty()) {
    dataset.model.assign(arguments.model.begin(), arguments.model.end());
  }
  if (!arguments.dtm.empty()) dataset.dtm = arguments.dtm;
  if (!arguments.crs.empty()) SetCrs(arguments.crs, dataset);
  WorldRequest request = RequestFor(dataset, 0.0);
  request.needs_terrain = request.needs_terrain ||
                          (!arguments.sensors.empty() && sensors.height_source != "gnss");
  TakeWorld(std::move(request), threads, world);
  PictureInputOptions picture_options;
  PictureReader pictures;
  std::optional<Crs> crs;
  std::error_code error;
  std::vector<TrackFrameFacts> facts;
  for (Query& query : dataset.queries) {
    if (!query.camera && fs::is_regular_file(query.image, error)) {
      CompleteFromPicture(dataset, false, picture_options, pictures, crs, query);
    }
    TrackFrameFacts frame;
    frame.id = query.id;
    frame.camera = query.camera;
    frame.truth = query.truth;
    facts.push_back(std::move(frame));
  }
  std::optional<PosePrior> first;
  if (!arguments.sensors.empty()) TakeSensors(arguments.sensors, sensors, facts, first, world);
  if (!arguments.odometry.empty()) TakeOdometry(arguments.odometry, facts);
  TakeStart(arguments, dataset.queries.front().prior, first, world);
  world.frames =
      std::make_unique<ListedFrames>(FramesOfQueries(dataset.queries), std::move(facts));
}

void ReadPartsTrack(const TrackArguments& arguments,
                    const SensorOptions& sensors,
                    int threads,
                    TrackWorld& world) {
  if (arguments.model.empty()) Refuse("--model", "nothing", "a city model");
  if (arguments.camera.empty()) Refuse("--camera", "nothing", "a camera file (JSON)");
  const CameraIntrinsics camera = ReadCamera(arguments.camera);
  WorldRequest request;
  request.model.assign(arguments.model.begin(), arguments.model.end());
  if (!arguments.dtm.empty()) request.dtm = arguments.dtm;
  Dataset named;
  SetCrs(arguments.crs, named);
  request.crs = named.crs;
  request.needs_terrain = true;
  TakeWorld(request, threads, world);
  std::optional<PosePrior> first;
  const bool streams = arguments.follow || arguments.input == "-";
  if (streams && !arguments.sensors.empty()) {
    Refuse("--sensors", "a file beside frames that are still to come", "none");
  }
  if (arguments.input == "-") {
    if (!arguments.odometry.empty()) {
      Refuse("--odometry", "a file beside lines of frames", "\"motion\" in the lines");
    }
    world.frames = FramesOfLines(std::cin, camera);
  } else if (arguments.follow) {
    world.frames = FollowFolder(arguments.input, arguments.odometry, camera, arguments.idle_s);
  } else {
    std::unique_ptr<FrameSource> source = OpenFrames(arguments.input);
    std::vector<TrackFrameFacts> facts = FactsOf(*source);
    for (TrackFrameFacts& frame : facts) frame.camera = camera;
    if (!arguments.sensors.empty()) TakeSensors(arguments.sensors, sensors, facts, first, world);
    if (!arguments.odometry.empty()) TakeOdometry(arguments.odometry, facts);
    world.frames = std::make_unique<ListedFrames>(std::move(source), std::move(facts));
  }
  TakeStart(arguments, std::nullopt, first, world);
}

}  // namespace

std::unique_ptr<TrackWorld> ReadTrack(const TrackArguments& arguments,
                                      const SensorOptions& sensors,
                                      int threads) {
  auto world = std::make_unique<TrackWorld>();
  world->has_odometry = !arguments.odometry.empty() || arguments.input == "-";
  fs::path file;
  if (!arguments.follow && arguments.input != "-" && IsDataset(arguments.input, file)) {
    ReadDatasetTrack(file, arguments, sensors, threads, *world);
  } else {
    ReadPartsTrack(arguments, sensors, threads, *world);
  }
  return world;
}

}  // namespace ridgeline
