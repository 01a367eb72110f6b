// SPDX-License-Identifier: Apache-2.0
#include "city/projected_sources.h"

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <utility>

#include "base/decimals.h"
#include "base/error.h"
#include "city/crs.h"
#include "city/units.h"

namespace ridgeline {
namespace {

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
  const std::string metres = undulation
                                 ? "about " + ShortestText(std::round(*undulation)) + " m here"
                                 : "tens of metres, 35 to 50 m in Central Europe";
  source.tally.Add("files with heights above the ellipsoid; heights above sea level differ by " +
                       metres + " (city.height_offset_m moves the model)",
                   source.file);
}

// Says what was done to coordinates that are not metres east and north, and doubts those that lie
// far from where their system is used.
void WarnOfSystem(SourceModel& source, const Crs& written, const ToProjected& projection) {
  if (written.horizontal_epsg == 0) return;
  if (projection.swaps() && !projection.transforms()) {
    source.tally.Add("files with north before east, swapped", source.file);
  }
  const LengthUnit horizontal = HorizontalUnit(written);
  const LengthUnit height = HeightUnit(written);
  if (!horizontal.IsMetre()) {
    source.tally.Add("files in " + CrsName(written) + ", whose unit is the " + horizontal.name +
                         ", moved to " + CrsName(projection.crs()),
                     source.file);
  }
  if (!height.IsMetre()) {
    source.tally.Add("files with heights in the unit " + height.name +
                         (written.vertical_epsg == 0 ? " (of their horizontal system, since they "
                                                       "name no vertical one)"
                                                     : "") +
                         ", converted to metres",
                     source.file);
  }
  const std::optional<CrsFit> fit = FitAt(projection.crs(), source.points.front().head<2>());
  if (fit && fit->outside_deg > kReachDeg) {
    source.tally.Add("files with coordinates " + ShortestText(std::round(fit->outside_deg)) +
                         " degrees outside of where " + CrsName(projection.crs()) +
                         " is used (is the system right? --model-crs overrides it)",
                     source.file);
  }
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

// What a file says itself of its units (uomLabels) decides where its system does not: heights
// without a vertical system.
void ApplyAxisUnits(SourceModel& source, const Crs& written, double height_unit_m) {
  if (source.axis_units.size() < 2 || written.horizontal_epsg == 0) return;
  const std::optional<double> horizontal = MetresPerUnit(source.axis_units[0]);
  if (horizontal && std::abs(*horizontal / HorizontalUnit(written).metres - 1.0) > 1e-5) {
    source.tally.Add("files whose uomLabels (" + source.axis_units[0] +
                         ") contradict the unit of " + CrsName(written) + ", which was taken",
                     source.file);
  }
  if (source.axis_units.size() < 3 || written.vertical_epsg != 0) return;
  const std::optional<double> height = MetresPerUnit(source.axis_units[2]);
  if (!height || *height == height_unit_m) return;
  source.tally.Add("files with heights in the unit " + source.axis_units[2] +
                       " (their uomLabels), converted to metres",
                   source.file);
  for (Eigen::Vector3d& point : source.points) point.z() *= *height / height_unit_m;
}

// Moves all sources to one projected system and returns it.
Crs ToOneSystem(std::vector<SourceModel>& sources, const CityOptions& options) {
  const std::optional<Crs> forced = ParseCrsOption("model_crs", options.model_crs);
  const std::optional<Crs> wanted = ParseCrsOption("project_to", options.project_to);
  std::optional<Crs> target = wanted;
  std::optional<Crs> common;
  std::string common_file;
  for (SourceModel& source : sources) {
    if (source.points.empty()) continue;
    Crs written = CrsOfSource(source, forced);
    if (written.horizontal_epsg == 0 && wanted) written = *wanted;
    const ToProjected projection(
        written, target.value_or(Crs{}), source.points.front(), source.file);
    ApplyAxisUnits(source, written, projection.height_unit_m());
    projection.Apply(source.points);
    WarnOfSystem(source, written, projection);
    for (Eigen::Vector3d& point : source.points) point.z() += options.height_offset_m;
    if (HasEllipsoidalHeights(written)) {
      WarnOfEllipsoidalHeights(source, projection.crs(), options);
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

std::optional<Crs> ParseCrsOption(const char* field, const std::string& text) {
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

ProjectedSources ProjectSources(std::vector<SourceModel> sources, const CityOptions& options) {
  ProjectedSources result;
  result.sources = std::move(sources);
  result.crs = ToOneSystem(result.sources, options);
  for (SourceModel& source : result.sources) {
    result.extent.extend(source.whole_extent);
    for (const Eigen::Vector3d& point : source.points) {
      result.extent.extend(Eigen::Vector2d(point.head<2>()));
    }
    if (options.region) KeepRegion(*options.region, source);
  }
  return result;
}

}  // namespace ridgeline
