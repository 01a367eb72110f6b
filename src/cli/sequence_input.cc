// SPDX-License-Identifier: Apache-2.0
#include "cli/sequence_input.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "input/query_request.h"
#include "input/dataset.h"
#include "input/picture_input.h"
#include "input/prior_pose.h"
#include "input/world.h"
#include "track/gyroscope.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

void TakeModel(const WorldRequest& request, SequenceInput& input) {
  World world = ReadWorld(request);
  input.model = std::move(world.model);
  input.dtm = std::move(world.dtm);
  input.warnings.insert(input.warnings.end(), world.warnings.begin(), world.warnings.end());
  input.scene =
      std::make_unique<Scene>(*input.model, input.dtm ? &*input.dtm : nullptr, ProjectionOptions{});
}

std::optional<double> TerrainHeight(const SequenceInput& input, const Eigen::Vector2d& world) {
  if (!input.dtm) return std::nullopt;
  const Eigen::Vector3d& origin = input.model->origin_in_world;
  const std::optional<double> height = input.dtm->HeightAt(world - origin.head<2>());
  if (!height) return std::nullopt;
  return *height + origin.z();
}

void StartFromPrior(const std::optional<PosePrior>& prior,
                    const SequenceInput& input,
                    double camera_height_m,
                    SequenceFrame& frame) {
  if (!prior) {
    frame.missing = "no prior";
    return;
  }
  if (!prior->heading_deg) {
    frame.missing = "no heading";
    return;
  }
  frame.start = PoseOfPrior(
      *prior, input.dtm ? &*input.dtm : nullptr, input.model->origin_in_world, camera_height_m);
  if (!frame.start) frame.missing = "no height";
}

// The reading of every frame, as indices; -1: none. By id; frames of a video by time, or by number
// where the readings have no times.
std::vector<int> ReadingOfFrames(const std::vector<SensorReading>& readings,
                                 const FrameSource& source) {
  std::vector<int> reading(source.size(), -1);
  std::map<std::string, int> by_id;
  for (std::size_t i = 0; i < readings.size(); ++i) by_id[readings[i].id] = static_cast<int>(i);
  const std::optional<double> rate = source.frames_per_second();
  const bool timed = rate && *rate > 0.0 && readings.front().time_s.has_value();
  for (std::size_t f = 0; f < source.size(); ++f) {
    const auto it = by_id.find(source.id(f));
    if (!timed && it != by_id.end()) reading[f] = it->second;
  }
  if (!timed) return reading;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (!readings[i].time_s) continue;
    const double frame = std::round((*readings[i].time_s - *readings.front().time_s) * *rate);
    if (frame >= 0.0 && frame < static_cast<double>(reading.size())) {
      reading[static_cast<std::size_t>(frame)] = static_cast<int>(i);
    }
  }
  return reading;
}

void StartFromSensors(const std::string& file, const SensorOptions& options, SequenceInput& input) {
  std::vector<SensorReading> readings = ReadSensors(file);
  if (options.attitude == "gyroscope") {
    readings = IntegrateGyroscope(std::move(readings), options, file);
  }
  const std::vector<int> reading_of = ReadingOfFrames(readings, *input.source);
  SensorPriors priors(input.model->crs, options);
  const auto terrain = [&](const Eigen::Vector2d& world) { return TerrainHeight(input, world); };
  std::size_t used = 0;
  for (std::size_t f = 0; f < input.frames.size(); ++f) {
    SequenceFrame& frame = input.frames[f];
    frame.start.reset();
    frame.missing = "no row in the sensor file";
    if (reading_of[f] < 0) continue;
    ++used;
    std::string missing;
    const std::optional<PosePrior> prior =
        priors.PriorOf(readings[static_cast<std::size_t>(reading_of[f])], terrain, missing);
    frame.missing = "no " + missing;
    if (prior) StartFromPrior(prior, input, options.camera_height_m, frame);
  }
  if (used == 0) {
    throw InputError(file,
                     "id",
                     "no row for any frame",
                     "ids like the frames' names, e.g. \"" + input.source->id(0) + "\"");
  }
}

bool IsFile(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

// Refuses what would be passed over.
void CheckArguments(const SequenceArguments& arguments) {
  const auto refuse = [](const char* option, const std::string& found, const char* expected) {
    throw InputError(option, "", found, expected);
  };
  if (!arguments.dataset.empty()) {
    if (!arguments.frames.empty()) refuse("--frames", "frames beside --dataset", "one of the two");
    if (!arguments.camera.empty()) {
      refuse("--camera", "a camera beside --dataset", "the cameras of the dataset");
    }
    return;
  }
  if (arguments.frames.empty()) {
    refuse("--frames", "nothing", "a picture, folder or video, or --dataset");
  }
  if (!arguments.model.empty()) {
    if (arguments.sensors.empty()) refuse("--sensors", "nothing", "a sensor file (CSV)");
    return;
  }
  if (!arguments.crs.empty()) refuse("--crs", "a system without a model", "--model PATH");
  if (!arguments.dtm.empty()) refuse("--dtm", "a terrain without a model", "--model PATH");
  if (!arguments.sensors.empty()) refuse("--sensors", "sensors without a model", "--model PATH");
}

void ReadFromDataset(const SequenceArguments& arguments,
                     const SensorOptions& sensors,
                     int threads,
                     SequenceInput& input) {
  Dataset dataset = ReadDataset(arguments.dataset);
  if (!arguments.model.empty()) {
    dataset.model.assign(arguments.model.begin(), arguments.model.end());
  }
  if (!arguments.dtm.empty()) dataset.dtm = arguments.dtm;
  SetCrs(arguments.crs, dataset);
  PictureInputOptions picture_options;
  picture_options.camera_height_m = sensors.camera_height_m;
  PictureReader pictures;
  std::optional<Crs> crs;
  for (Query& query : dataset.queries) {
    if (!IsFile(query.image)) continue;
    const bool wants_prior = arguments.sensors.empty();
    CompleteFromPicture(dataset, wants_prior, picture_options, pictures, crs, query);
  }
  for (const Query& query : dataset.queries) {
    input.frames.push_back({query.id, query.camera, std::nullopt, "no prior", query.truth});
    for (const Assumption& assumption : query.assumptions) {
      input.notes.push_back(query.id + ": " + TextOf(assumption));
    }
  }
  input.source = FramesOfQueries(dataset.queries);
  WorldRequest request = RequestFor(dataset, 0.0);
  request.whole_model = true;
  request.needs_terrain =
      request.needs_terrain || (!arguments.sensors.empty() && sensors.height_source != "gnss");
  request.threads = threads;
  TakeModel(request, input);
  for (std::size_t i = 0; i < dataset.queries.size(); ++i) {
    StartFromPrior(dataset.queries[i].prior, input, sensors.camera_height_m, input.frames[i]);
  }
}

// Frames of a model need a camera; skylines alone do not.
std::optional<CameraIntrinsics> CameraOfFrames(const SequenceArguments& arguments) {
  if (!arguments.camera.empty()) return ReadCamera(arguments.camera);
  if (arguments.model.empty()) return std::nullopt;
  throw InputError("--camera", "", "nothing", "a camera file (JSON)");
}

void ReadFromParts(const SequenceArguments& arguments,
                   const SensorOptions& sensors,
                   int threads,
                   SequenceInput& input) {
  const std::optional<CameraIntrinsics> camera = CameraOfFrames(arguments);
  input.source = OpenFrames(arguments.frames);
  for (std::size_t i = 0; i < input.source->size(); ++i) {
    input.frames.push_back({input.source->id(i), camera, std::nullopt, "no sensors", std::nullopt});
  }
  if (arguments.model.empty()) return;
  WorldRequest request;
  request.model.assign(arguments.model.begin(), arguments.model.end());
  if (!arguments.dtm.empty()) request.dtm = arguments.dtm;
  Dataset named;
  SetCrs(arguments.crs, named);
  request.crs = named.crs;
  request.whole_model = true;
  request.needs_terrain = sensors.height_source != "gnss";
  request.threads = threads;
  TakeModel(request, input);
}

}  // namespace

void AddSequenceOptions(CLI::App& command, SequenceArguments& arguments) {
  command.add_option("--dataset", arguments.dataset, "dataset.json whose queries are the frames");
  command.add_option("--frames", arguments.frames, "Picture, folder of pictures, or video");
  command.add_option("--model", arguments.model, "City model files or folders")->type_name("PATH");
  command.add_option("--crs", arguments.crs, "Projected system of the positions");
  command.add_option("--dtm", arguments.dtm, "Terrain raster");
  command.add_option("--camera", arguments.camera, "Camera file (JSON)");
  command.add_option("--sensors", arguments.sensors, "Sensor readings per frame (CSV)");
}

std::unique_ptr<SequenceInput> ReadSequence(const SequenceArguments& arguments,
                                            const SensorOptions& sensors,
                                            int threads) {
  CheckArguments(arguments);
  auto input = std::make_unique<SequenceInput>();
  if (arguments.dataset.empty()) {
    ReadFromParts(arguments, sensors, threads, *input);
  } else {
    ReadFromDataset(arguments, sensors, threads, *input);
  }
  if (input->model && !arguments.sensors.empty()) {
    StartFromSensors(arguments.sensors, sensors, *input);
  }
  return input;
}

}  // namespace ridgeline
