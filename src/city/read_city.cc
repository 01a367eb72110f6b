// SPDX-License-Identifier: Apache-2.0
#include "city/read_city.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "base/error.h"
#include "base/parallel.h"
#include "city/build_model.h"
#include "city/crs.h"
#include "city/read_source.h"

namespace ridgeline {
namespace fs = std::filesystem;
namespace {

std::string Number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

void CheckRange(const char* field, double value, double lowest, double highest) {
  if (value >= lowest && value <= highest) return;  // false for NaN
  throw InputError(
      "", std::string("city.") + field, Number(value), Number(lowest) + " to " + Number(highest));
}

std::optional<Crs> ParseOption(const char* field, const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::optional<Crs> crs = ParseCrs(text);
  if (!crs) {
    throw InputError("",
                     std::string("city.") + field,
                     "\"" + text + "\"",
                     "a reference system such as EPSG:25832 or EPSG:25832+7837");
  }
  return crs;
}

std::vector<fs::path> ListFiles(const std::vector<fs::path>& paths) {
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
      files.push_back(path);
      continue;
    }
    std::vector<fs::path> found;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path)) {
      if (entry.is_regular_file() && LooksLikeModelFile(entry.path())) {
        found.push_back(entry.path());
      }
    }
    if (found.empty())
      throw InputError(path.string(),
                       "",
                       "a folder without model files",
                       "*.gml, *.xml, *.json, *.jsonl, *.obj or *.ply");
    std::sort(found.begin(), found.end());
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

// The system of one file: the option's, or what its srsNames agree on.
Crs CrsOfSource(const SourceModel& source, const std::optional<Crs>& forced) {
  if (forced) return *forced;
  std::optional<Crs> crs;
  std::string first_name;
  for (const std::string& name : source.srs_names) {
    const std::optional<Crs> parsed = ParseCrs(name);
    if (!parsed) {
      throw InputError(source.file,
                       "srsName",
                       "\"" + name + "\"",
                       "a known reference system (--model-crs EPSG:... overrides it)");
    }
    if (crs && crs->horizontal_epsg != parsed->horizontal_epsg) {
      throw InputError(source.file,
                       "srsName",
                       "\"" + name + "\" beside \"" + first_name + "\"",
                       "one reference system per file (--model-crs overrides them)");
    }
    if (!crs) {
      crs = parsed;
      first_name = name;
    }
    if (crs->vertical_epsg == 0) crs->vertical_epsg = parsed->vertical_epsg;
  }
  return crs.value_or(Crs{});
}

// Says how many metres are at stake where heights are above the ellipsoid, unless an offset is
// given.
void WarnOfEllipsoidalHeights(SourceModel& source,
                              const Crs& projected,
                              const CityOptions& options) {
  if (options.height_offset_m != 0.0) return;
  const std::optional<Eigen::Vector2d> place =
      LatitudeLongitude(projected, source.points.front().head<2>());
  const std::optional<double> undulation =
      place ? GeoidUndulation(place->x(), place->y()) : std::nullopt;
  const std::string metres = undulation ? "about " + Number(std::round(*undulation)) + " m here"
                                        : "tens of metres, 35 to 50 m in Central Europe";
  source.tally.Add("files with heights above the ellipsoid; heights above sea level differ by " +
                       metres + " (city.height_offset_m moves the model)",
                   source.file);
}

// Moves all sources to one projected system and returns it.
Crs ProjectSources(std::vector<SourceModel>& sources, const CityOptions& options) {
  const std::optional<Crs> forced = ParseOption("model_crs", options.model_crs);
  std::optional<Crs> target = ParseOption("project_to", options.project_to);
  std::optional<Crs> common;
  std::string common_file;
  for (SourceModel& source : sources) {
    if (source.points.empty()) continue;
    const Crs written = CrsOfSource(source, forced);
    const ToProjected projection(
        written, target.value_or(Crs{}), source.points.front(), source.file);
    projection.Apply(source.points);
    for (Eigen::Vector3d& point : source.points) point.z() += options.height_offset_m;
    if (HasEllipsoidalHeights(written)) {
      WarnOfEllipsoidalHeights(source, projection.crs(), options);
    }
    if (projection.swaps() && !projection.transforms()) {
      source.tally.Add("files with north before east, swapped", source.file);
    }
    // Later files follow the first one's zone.
    if (projection.transforms() && !target) target = projection.crs();
    if (!common) {
      common = projection.crs();
      common_file = source.file;
    } else if (common->horizontal_epsg != projection.crs().horizontal_epsg) {
      throw InputError(source.file,
                       "CRS",
                       CrsName(projection.crs()),
                       CrsName(*common) + " (from " + common_file +
                           "; --project-to moves files of several systems into one)");
    } else if (common->vertical_epsg == 0) {
      common->vertical_epsg = projection.crs().vertical_epsg;
    }
  }
  return common.value_or(Crs{});
}

}  // namespace

void CityOptions::Validate() const {
  ParseOption("model_crs", model_crs);
  ParseOption("project_to", project_to);
  CheckRange("height_offset_m", height_offset_m, -10000.0, 10000.0);
  CheckRange("lod", lod, 1, 4);
  CheckRange("min_dihedral_deg", min_dihedral_deg, 0.1, 170.0);
  CheckRange("weld_m", weld_m, 1e-6, 0.5);
  CheckRange("adjoin_m", adjoin_m, 1e-3, 1.0);
  CheckRange("joint_m", joint_m, 0.0, 2.0);
  CheckRange("threads", threads, 0, 4096);
}

ProjectedSources ReadProjectedSources(const std::vector<fs::path>& paths,
                                      const CityOptions& options) {
  options.Validate();
  const std::vector<fs::path> files = ListFiles(paths);
  if (files.empty()) throw InputError("--model", "", "no file", "one or more model files");
  ProjectedSources result;
  result.sources.resize(files.size());
  ParallelFor(files.size(), options.threads, [&](std::size_t i) {
    result.sources[i] = ReadSource(files[i]);
  });
  result.crs = ProjectSources(result.sources, options);
  return result;
}

CityModel ReadCity(const std::vector<fs::path>& paths, const CityOptions& options) {
  ProjectedSources projected = ReadProjectedSources(paths, options);
  CityModel model = BuildModel(projected.sources, projected.crs, options);
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

}  // namespace ridgeline
