// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/options.h"
#include "city/city_model.h"
#include "city/city_region.h"

namespace ridgeline {

struct CityOptions {
  // "EPSG:25832" or any spelling of an srsName; overrides what the files say. Empty: the files'.
  std::string model_crs;
  // Projected system that the model is moved to, and that files which name none are taken to be in.
  // Empty: the files' own; for geographic coordinates the UTM zone of their middle.
  std::string project_to;
  // Added to the model's heights [m], e.g. minus the geoid undulation where a model has heights
  // above the ellipsoid and the terrain model has not.
  double height_offset_m = 0.0;
  // Level of detail wanted, 1 to 4. A building without it is read in its next one, with a warning.
  int lod = 2;
  // Feature edges: smallest angle between the normals of the two faces [deg].
  double min_dihedral_deg = 10.0;
  // Vertices closer than this are one [m].
  double weld_m = 0.005;
  // Faces and edges closer than this touch, e.g. the walls that adjoining buildings share [m].
  double adjoin_m = 0.05;
  // A corner where the facade goes on in another building's, no farther than this in front of it or
  // behind it, is a seam [m]; 0: only corners without any step are.
  double joint_m = 0.35;
  // Threads; 0: all.
  int threads = 0;
  // Not of the configuration: the part of the city that is wanted. Empty: all of it.
  std::optional<CityRegion> region;

  void Visit(OptionVisitor& v) {
    v.Field("model_crs", model_crs);
    v.Field("project_to", project_to);
    v.Field("height_offset_m", height_offset_m);
    v.Field("lod", lod);
    v.Field("min_dihedral_deg", min_dihedral_deg);
    v.Field("weld_m", weld_m);
    v.Field("adjoin_m", adjoin_m);
    v.Field("joint_m", joint_m);
    v.Field("threads", threads);
  }
  // Throws InputError naming the field, e.g. "city.weld_m".
  void Validate() const;
};

// Reads model files (folders: every model file in them) into one model: CityGML 1.0, 2.0, 3.0 (also
// gzipped), CityJSON 1.0 to 2.0 and CityJSONSeq, OBJ, PLY, and stores of WriteCityStore. Throws
// InputError for a missing, truncated or unreadable file, for files in different systems, and for a
// model without any building that has a volume. What is dropped or repaired is named in
// CityModel::warnings.
CityModel ReadCity(const std::vector<std::filesystem::path>& paths, const CityOptions& options);

// The system that ReadCity puts the model in; horizontal_epsg 0: the model names none. Reads the
// first file only, of a store its table of contents. Throws InputError as ReadCity.
Crs ReadCityCrs(const std::vector<std::filesystem::path>& paths, const CityOptions& options);

}  // namespace ridgeline
