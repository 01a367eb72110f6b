// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/options.h"
#include "city/city_model.h"

namespace ridgeline {

struct CityOptions {
  // "EPSG:25832" or any spelling of an srsName; overrides what the files say. Empty: the files'.
  std::string model_crs;
  // Feature edges: smallest angle between the normals of the two faces [deg].
  double min_dihedral_deg = 10.0;
  // Vertices closer than this are one [m].
  double weld_m = 0.005;

  void Visit(OptionVisitor& v) {
    v.Field("model_crs", model_crs);
    v.Field("min_dihedral_deg", min_dihedral_deg);
    v.Field("weld_m", weld_m);
  }
  // Throws InputError naming the field, e.g. "city.weld_m".
  void Validate() const;
};

// Reads model files (folders: every model file in them) into one model. Throws InputError for a
// missing, truncated or unreadable file, for files in different systems, and for a model without
// any LoD2 building.
CityModel ReadCity(const std::vector<std::filesystem::path>& paths, const CityOptions& options);

}  // namespace ridgeline
