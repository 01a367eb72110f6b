// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "city/city_model.h"
#include "city/terrain.h"
#include "cli/frame_source.h"
#include "projection/scene.h"
#include "track/sensors.h"

namespace ridgeline {

// A sequence of frames in a model, named on the command line: a dataset, or frames, model, camera
// and sensors one by one.
struct SequenceArguments {
  std::string dataset;
  std::string frames;
  std::vector<std::string> model;
  std::string crs;
  std::string dtm;
  std::string camera;
  std::string sensors;
};

// What is known of a frame besides its picture.
struct SequenceFrame {
  std::string id;
  std::optional<CameraIntrinsics> camera;  // nullopt: not known
  std::optional<Pose> start;               // world; nullopt: `missing` says why
  std::string missing;
  std::optional<Pose> truth;  // world
};

struct SequenceInput {
  std::unique_ptr<FrameSource> source;
  std::vector<SequenceFrame> frames;  // as many as the source has
  // Absent without a model: then skylines can be extracted, and no more.
  std::optional<CityModel> model;
  std::optional<HeightGrid> dtm;
  std::unique_ptr<Scene> scene;    // refers to model and dtm
  std::vector<std::string> notes;  // what was made of the pictures' own words
  std::vector<std::string> warnings;
};

void AddSequenceOptions(CLI::App& command, SequenceArguments& arguments);

// Throws InputError for anything missing or unreadable; frames without a picture or without sensors
// are no error.
std::unique_ptr<SequenceInput> ReadSequence(const SequenceArguments& arguments,
                                            const SensorOptions& sensors,
                                            int threads);

}  // namespace ridgeline
