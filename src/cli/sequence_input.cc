// SPDX-License-Identifier: Apache-2.0
#include "cli/sequence_input.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "city/read_city.h"
#include "input/dataset.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

// Margin around the model in which the terrain is read [m].
constexpr double kTerrainMarginM = 200.0;

void ReadModel(const std::vector<fs::path>& files,
               const std::string& crs,
               const std::optional<fs::path>& dtm,
               int threads,
               SequenceInput& input) {
  CityOptions city;
  city.model_crs = crs;
  city.threads = threads;
  input.model = ReadCity(files, city);
  input.warnings = input.model->warnings;
  if (dtm) {
    Eigen::Vector2d lower = input.model->vertices.front().head<2>();
    Eigen::Vector2d upper = lower;
    for (const Eigen::Vector3d& vertex : input.model->vertices) {
      lower = lower.cwiseMin(vertex.head<2>());
      upper = upper.cwiseMax(vertex.head<2>());
    }
    input.dtm = ReadDtm(*dtm, *input.model, lower, upper, kTerrainMarginM, input.warnings);
  }
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
  std::optional<double> height = prior->height_in_world;
  if (!height) {
    height = TerrainHeight(input, prior->position_in_world);
    if (height) *height += camera_height_m;
  }
  if (!height || !prior->heading_deg) {
    frame.missing = height ? "no heading" : "no height";
    return;
  }
  frame.start =
      Pose{CamFromWorld(ViewAngles{
               *prior->heading_deg, prior->pitch_deg.value_or(0.0), prior->roll_deg.value_or(0.0)}),
           {prior->position_in_world.x(), prior->position_in_world.y(), *height}};
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
  const std::vector<SensorReading> readings = ReadSensors(file);
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

void ReadFromDataset(const SequenceArguments& arguments,
                     const SensorOptions& sensors,
                     int threads,
                     SequenceInput& input) {
  const Dataset dataset = ReadDataset(arguments.dataset);
  std::vector<std::string> ids;
  std::vector<fs::path> files;
  for (const Query& query : dataset.queries) {
    ids.push_back(query.id);
    files.push_back(query.image);
    input.frames.push_back({query.id, query.camera, std::nullopt, "no prior", query.truth});
  }
  input.source = FramesOfFiles(ids, files);
  ReadModel(dataset.model, dataset.crs, dataset.dtm, threads, input);
  for (std::size_t i = 0; i < dataset.queries.size(); ++i) {
    StartFromPrior(dataset.queries[i].prior, input, sensors.camera_height_m, input.frames[i]);
  }
}

void ReadFromParts(const SequenceArguments& arguments, int threads, SequenceInput& input) {
  if (arguments.frames.empty()) {
    throw InputError("--frames", "", "nothing", "a picture, folder or video, or --dataset");
  }
  input.source = OpenFrames(arguments.frames);
  std::optional<CameraIntrinsics> camera;
  if (!arguments.camera.empty()) camera = ReadCamera(arguments.camera);
  for (std::size_t i = 0; i < input.source->size(); ++i) {
    input.frames.push_back({input.source->id(i), camera, std::nullopt, "no sensors", std::nullopt});
  }
  if (arguments.model.empty()) return;
  if (!camera) throw InputError("--camera", "", "nothing", "a camera file (JSON)");
  if (arguments.sensors.empty())
    throw InputError("--sensors", "", "nothing", "a sensor file (CSV)");
  const std::vector<fs::path> model(arguments.model.begin(), arguments.model.end());
  std::optional<fs::path> dtm;
  if (!arguments.dtm.empty()) dtm = arguments.dtm;
  ReadModel(model, arguments.crs, dtm, threads, input);
}

}  // namespace

void AddSequenceOptions(CLI::App& command, SequenceArguments& arguments) {
  command.add_option("--dataset", arguments.dataset, "dataset.json whose queries are the frames");
  command.add_option("--frames", arguments.frames, "Picture, folder of pictures, or video");
  command.add_option("--model", arguments.model, "City model files or folders")->type_name("PATH");
  command.add_option("--crs", arguments.crs, "System of the model, where it does not say");
  command.add_option("--dtm", arguments.dtm, "Terrain raster");
  command.add_option("--camera", arguments.camera, "Camera file (JSON)");
  command.add_option("--sensors", arguments.sensors, "Sensor readings per frame (CSV)");
}

std::unique_ptr<SequenceInput> ReadSequence(const SequenceArguments& arguments,
                                            const SensorOptions& sensors,
                                            int threads) {
  auto input = std::make_unique<SequenceInput>();
  if (arguments.dataset.empty()) {
    ReadFromParts(arguments, threads, *input);
  } else {
    ReadFromDataset(arguments, sensors, threads, *input);
  }
  if (input->model && !arguments.sensors.empty()) {
    StartFromSensors(arguments.sensors, sensors, *input);
  }
  return input;
}

}  // namespace ridgeline
