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
  std::vector<std::string> warnings;
};

// Reads the model, and the terrain around the places [world: east, north] that will be searched.
// `crs` as in Dataset. Throws InputError as ReadCity and ReadDtm.
World ReadWorld(const std::vector<std::filesystem::path>& model,
                const std::optional<std::filesystem::path>& dtm,
                const std::string& crs,
                const Eigen::AlignedBox2d& places);

// The model and terrain of a dataset; places are those of its priors and truths, widened by
// `margin_m`.
World ReadWorld(const Dataset& dataset, double margin_m);

}  // namespace ridgeline
