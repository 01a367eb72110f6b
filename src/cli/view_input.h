// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "city/city_model.h"
#include "city/terrain.h"
#include "cli/query_input.h"
#include "input/assumption.h"
#include "projection/scene.h"

namespace ridgeline {

// A camera at a pose in a model, named on the command line.
struct ViewArguments {
  QueryArguments query;
  std::string at;    // of the query: "truth" or "prior"; "": truth
  std::string pose;  // result or pose file, or "east,north,height,heading,pitch,roll"
};

struct ViewInput {
  CityModel model;
  std::optional<HeightGrid> dtm;
  std::unique_ptr<Scene> scene;  // refers to model and dtm
  PinholeCamera camera;
  cv::Mat photo;  // undistorted, 8-bit BGR; empty: none given
  Pose cam_from_local;
  std::vector<Assumption> assumptions;
  std::vector<std::string> warnings;
};

void AddViewOptions(CLI::App& command, ViewArguments& arguments);

// Throws InputError for anything missing or unreadable.
std::unique_ptr<ViewInput> ReadView(const ViewArguments& arguments, int threads);

}  // namespace ridgeline
