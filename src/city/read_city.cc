// SPDX-License-Identifier: Apache-2.0
#include "city/read_city.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "base/error.h"
#include "base/parallel.h"
#include "city/crs.h"
#include "city/format/read_source.h"
#include "city/mesh/build_model.h"
#include "city/store/city_store.h"

namespace ridgeline {
namespace fs = std::filesystem;
namespace {

std::string Number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

// "654021..654296 E, 5411980..5412250 N".
std::string BoxText(const Eigen::AlignedBox2d& box) {
  const auto whole = [](double value) {
    return std::isfinite(value) ? std::to_string(static_cast<long long>(std::floor(value)))
                                : Number(value);
  };
  return whole(box.min().x()) + ".." + whole(box.max().x()) + " E, " + whole(box.min().y()) + ".." +
         whole(box.max().y()) + " N";
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

// Buildings without geometry of their own count by their parts; without those they stay, so that
// they are named.
bool IsInRegion(const CityRegion& region,
                const SourceModel& source,
                const SourceBuilding& building,
                bool has_parts) {
  Eigen::AlignedBox3d box;
  for (const SourceMember& member : building.members) {
    const SourceRing& ring = source.rings[source.polygons[member.polygon].first_ring];
    for (std::uint32_t p = 0; p < ring.point_count; ++p) {
      box.extend(source.points[ring.first_point + p]);
    }
  }
  if (box.isEmpty()) return !has_parts;
  return region.Includes(Eigen::AlignedBox2d(box.min().head<2>(), box.max().head<2>()),
                         box.sizes().z());
}

// Removes the buildings that the region leaves out. Wholes stay for the sake of their parts,
// without geometry of their own.
void KeepRegion(const CityRegion& region, SourceModel& source) {
  std::vector<bool> has_parts(source.buildings.size(), false);
  for (const SourceBuilding& building : source.buildings) {
    if (building.parent >= 0) has_parts[static_cast<std::size_t>(building.parent)] = true;
  }
  std::vector<bool> kept(source.buildings.size(), false);
  for (std::size_t b = 0; b < source.buildings.size(); ++b) {
    if (!IsInRegion(region, source, source.buildings[b], has_parts[b])) {
      source.buildings[b].members.clear();
      continue;
    }
    int whole = static_cast<int>(b);
    while (whole >= 0) {
      kept[static_cast<std::size_t>(whole)] = true;
      whole = source.buildings[static_cast<std::size_t>(whole)].parent;
    }
  }
  std::vector<int> new_index(source.buildings.size(), -1);
  std::vector<SourceBuilding> buildings;
  for (std::size_t b = 0; b < source.buildings.size(); ++b) {
    if (!kept[b]) continue;
    new_index[b] = static_cast<int>(buildings.size());
    buildings.push_back(std::move(source.buildings[b]));
  }
  for (SourceBuilding& building : buildings) {
    if (building.parent >= 0)
      building.parent = new_index[static_cast<std::size_t>(building.parent)];
  }
  source.buildings = std::move(buildings);
}

// Moves all sources to one projected system and returns it.
Crs ProjectSources(std::vector<SourceModel>& sources, const CityOptions& options) {
  const std::optional<Crs> forced = ParseOption("model_crs", options.model_crs);
  const std::optional<Crs> wanted = ParseOption("project_to", options.project_to);
  std::optional<Crs> target = wanted;
  std::optional<Crs> common;
  std::string common_file;
  for (SourceModel& source : sources) {
    if (source.points.empty()) continue;
    Crs written = CrsOfSource(source, forced);
    if (written.horizontal_epsg == 0 && wanted) written = *wanted;
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
  ProjectedSources result;
  const std::vector<fs::path> files = ListModelFiles(paths, options.region, &result.warnings);
  if (files.empty()) throw InputError("--model", "", "no file", "one or more model files");
  result.sources.resize(files.size());
  ParallelFor(files.size(), options.threads, [&](std::size_t i) {
    result.sources[i] = ReadSource(files[i], options.region);
  });
  result.crs = ProjectSources(result.sources, options);
  for (SourceModel& source : result.sources) {
    result.extent.extend(source.whole_extent);
    for (const Eigen::Vector3d& point : source.points) {
      result.extent.extend(Eigen::Vector2d(point.head<2>()));
    }
    if (options.region) KeepRegion(*options.region, source);
  }
  return result;
}

CityModel ReadCity(const std::vector<fs::path>& paths, const CityOptions& options) {
  ProjectedSources projected = ReadProjectedSources(paths, options);
  CityModel model = BuildModel(projected.sources, projected.crs, options);
  model.warnings.insert(
      model.warnings.begin(), projected.warnings.begin(), projected.warnings.end());
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
  if (const auto target = ParseOption("project_to", options.project_to)) return *target;
  CityOptions crs_options = options;
  crs_options.region.reset();
  const std::vector<fs::path> files = ListModelFiles(paths);
  if (files.empty()) throw InputError("--model", "", "no file", "one or more model files");
  if (files.front().extension() == ".gpkg") {
    CityRegion nowhere;
    nowhere.positions = Eigen::AlignedBox2d(Eigen::Vector2d::Constant(-1e9));
    const SourceModel store = ReadCityStore(files.front(), nowhere);
    return CrsOfSource(store, ParseOption("model_crs", options.model_crs));
  }
  return ReadProjectedSources({files.front()}, crs_options).crs;
}

}  // namespace ridgeline
