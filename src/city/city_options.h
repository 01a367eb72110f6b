// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "base/options.h"
#include "city/city_region.h"
#include "city/mesh/mesh_options.h"

namespace ridgeline {

// The keys of "city" in the configuration; those of the mesh are among them.
struct CityOptions : MeshOptions {
  // "EPSG:25832" or any spelling of an srsName; overrides what the files say. Empty: the files'.
  std::string model_crs;
  // Projected system that the model is moved to, and that files which name none are taken to be in.
  // Empty: the files' own; for geographic coordinates the UTM zone of their middle.
  std::string project_to;
  // Added to the model's heights [m], e.g. minus the geoid undulation where a model has heights
  // above the ellipsoid and the terrain model has not.
  double height_offset_m = 0.0;
  // Not of the configuration: the part of the city that is wanted. Empty: all of it.
  std::optional<CityRegion> region;

  void Visit(OptionVisitor& v) {
    v.Field("model_crs", model_crs);
    v.Field("project_to", project_to);
    v.Field("height_offset_m", height_offset_m, Closed(-10000.0, 10000.0));
    MeshOptions::Visit(v);
  }
  // Throws InputError naming the field, e.g. "city.weld_m".
  void Validate() const;
};

}  // namespace ridgeline
