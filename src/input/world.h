// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "city/city_model.h"
#include "city/read_city.h"
#include "city/terrain.h"
#include "input/dataset.h"

namespace ridgeline {

// Model and terrain of a dataset, in memory.
struct World {
  CityModel model;
  std::optional<HeightGrid> dtm;
  bool dtm_of_model = false;  // made from the model's ground surfaces
  std::vector<std::string> warnings;
};

// Files of a world, and what is asked of it.
struct WorldRequest {
  std::vector<std::filesystem::path> model;
  std::optional<std::filesystem::path> dtm;
  std::string crs;  // as in Dataset
  // Places that will be looked from [world: east, north]. The model is read as far as it can be
  // seen from there; all of it with `whole_model`, and where no place is known.
  Eigen::AlignedBox2d places;
  bool whole_model = false;
  // Whether heights of the ground are wanted: without a terrain model they are made from the
  // model's ground surfaces then, with a warning.
  bool needs_terrain = false;
  int threads = 0;  // 0: all
};

// Reads the model in the request's system, and the terrain around the places. Throws InputError as
// ReadCity and ReadDtm, and where terrain is needed that neither a file nor the model gives.
World ReadWorld(const WorldRequest& request);

// The request for a dataset: places are those of its priors and truths, widened by `margin_m`;
// terrain is needed if a prior has no height.
WorldRequest RequestFor(const Dataset& dataset, double margin_m);

// The world of a dataset.
World ReadWorld(const Dataset& dataset, double margin_m);

}  // namespace ridgeline
