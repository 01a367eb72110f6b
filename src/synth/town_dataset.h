// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>

#include "base/options.h"
#include "synth/town.h"
#include "synth/trouble.h"

namespace ridgeline {

struct TownDatasetOptions {
  TownOptions town;
  // Pictures of each kind; without any, only the model and the DTM are written.
  int street = 8;
  int tilted = 2;
  int portrait = 2;
  int drone = 2;
  int low = 0;    // from 10 to 40 m, between and over the houses
  int nadir = 0;  // from 25 to 60 m, straight down
  // Size of the pictures [px]; portraits are turned.
  int width = 1280;
  int height = 960;
  int jpeg_quality = 90;
  // One camera for all pictures; else each has its own.
  bool one_camera = false;
  // Pictures without colour, as of a thermal camera.
  bool grey = false;
  // Mean overhang of the eaves, which the model does not have [m].
  double overhang_m = 0.3;
  // Errors of the model: sigma of each building's east, north and roof height [m].
  double survey_sigma_m = 0.05;
  TroubleOptions trouble;
  // Half-ranges of the priors around the truth: position, heading, pitch and roll.
  double prior_m = 10.0;
  double prior_heading_deg = 20.0;
  double prior_tilt_deg = 1.0;

  void Visit(OptionVisitor& v) {
    v.Group("town", [&](OptionVisitor& g) { town.Visit(g); });
    v.Field("street", street, Closed(0, 1000));
    v.Field("tilted", tilted, Closed(0, 1000));
    v.Field("portrait", portrait, Closed(0, 1000));
    v.Field("drone", drone, Closed(0, 1000));
    v.Field("low", low, Closed(0, 1000));
    v.Field("nadir", nadir, Closed(0, 1000));
    v.Field("width", width, Closed(64, 10000));
    v.Field("height", height, Closed(64, 10000));
    v.Field("jpeg_quality", jpeg_quality, Closed(1, 100));
    v.Field("one_camera", one_camera);
    v.Field("grey", grey);
    v.Field("overhang_m", overhang_m, Closed(0.0, 1.5));
    v.Field("survey_sigma_m", survey_sigma_m, Closed(0.0, 2.0));
    v.Group("trouble", [&](OptionVisitor& g) { trouble.Visit(g); });
    v.Field("prior_m", prior_m, Closed(0.0, 1000.0));
    v.Field("prior_heading_deg", prior_heading_deg, Closed(0.0, 180.0));
    v.Field("prior_tilt_deg", prior_tilt_deg, Closed(0.0, 30.0));
  }
};

struct TownDatasetSummary {
  std::size_t buildings = 0;  // with parts
  std::size_t model_files = 0;
  std::size_t pictures = 0;
};

// Called after each file: files done, files in all.
using FileProgress = std::function<void(std::size_t, std::size_t)>;

// Writes a town as a dataset (docs/dataset.md) into the existing folder `folder`: city.gml or,
// beyond 36 blocks, city/tile_*.gml; dtm.tif; images/*.jpg and dataset.json if there are pictures.
// Pictures of large towns are taken in their middle. Priors are outside buildings and, apart from
// that, drawn uniformly around the truth. Same files for the same options on any number of threads.
TownDatasetSummary WriteTownDataset(const TownDatasetOptions& options,
                                    const std::filesystem::path& folder,
                                    int threads,
                                    const FileProgress& progress);

}  // namespace ridgeline
