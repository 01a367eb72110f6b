// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "city/city_model.h"
#include "city/terrain.h"
#include "synth/town.h"

namespace ridgeline {

// The town as the survey would have it: LoD2 solids with welded vertices and feature edges (all
// folds above 10 degrees within a building). Same content as the CityGML file, without reading one.
CityModel TownModel(const Town& town);

// Terrain on a grid over the town and `margin_m` around it, local frame.
HeightGrid TownTerrain(const Town& town, double margin_m, double spacing_m = 1.0);

// The town with survey errors: every building shifted by N(0, sigma_m) in east and north, its roof
// by N(0, sigma_m) in height; parts move with their building.
Town SurveyedTown(const Town& town, double sigma_m);

}  // namespace ridgeline
