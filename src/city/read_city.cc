// SPDX-License-Identifier: Apache-2.0
#include "city/read_city.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "base/error.h"
#include "city/box_text.h"
#include "city/city_sources.h"
#include "city/format/model_files.h"
#include "city/mesh/build_model.h"
#include "city/store/city_store.h"

namespace ridgeline {
namespace fs = std::filesystem;

void CityOptions::Validate() const {
  CheckOptions(*this, "city");
  ParseCrsOption("model_crs", model_crs);
  ParseCrsOption("project_to", project_to);
}

CityModel ReadCity(const std::vector<fs::path>& paths, const CityOptions& options) {
  CitySources city = ReadCitySources(paths, options);
  ProjectedSources& projected = city.projected;
  CityModel model = BuildModel(projected.sources, projected.crs, options);
  model.warnings.insert(model.warnings.begin(), city.warnings.begin(), city.warnings.end());
  if (model.triangles.empty() && options.region && !projected.extent.isEmpty()) {
    throw InputError(paths.front().string(),
                     "extent",
                     BoxText(projected.extent),
                     "buildings near the places asked for, " + BoxText(options.region->positions));
  }
  if (model.triangles.empty()) {
    std::string found = "no building with a volume";
    for (const std::string& warning : model.warnings) found += "; " + warning;
    throw InputError(paths.front().string(), "", found, "buildings of LoD1 to LoD4");
  }
  if (projected.crs.horizontal_epsg == 0) {
    model.warnings.push_back(
        "no reference system in the model: its coordinates are taken as east, north, height in "
        "metres (--model-crs EPSG:... says which)");
  }
  return model;
}

Crs ReadCityCrs(const std::vector<fs::path>& paths, const CityOptions& options) {
  if (const auto target = ParseCrsOption("project_to", options.project_to)) return *target;
  const std::vector<fs::path> files = ListModelFiles(paths).files;
  if (files.empty()) throw InputError("--model", "", "no file", "one or more model files");
  if (IsCityStore(files.front())) {
    CityRegion nowhere;
    nowhere.positions = Eigen::AlignedBox2d(Eigen::Vector2d::Constant(-1e9));
    const SourceModel store = ReadCityStore(files.front(), nowhere);
    return CrsOfSource(store, ParseCrsOption("model_crs", options.model_crs));
  }
  CityOptions crs_options = options;
  crs_options.region.reset();
  return ReadCitySources({files.front()}, crs_options).projected.crs;
}

}  // namespace ridgeline
