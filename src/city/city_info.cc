// SPDX-License-Identifier: Apache-2.0
#include "city/city_info.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "city/city_sources.h"
#include "city/crs.h"
#include "city/mesh/build_model.h"
#include "city/mesh/shell_check.h"

namespace ridgeline {
namespace {

ModelFileInfo DescribeSource(const SourceModel& source) {
  ModelFileInfo info;
  info.file = source.file;
  info.format = source.format;
  std::error_code error;
  info.bytes = std::filesystem::file_size(source.file, error);
  if (error) info.bytes = 0;
  info.srs_names = source.srs_names;
  info.buildings = source.buildings.size();
  info.polygons = source.polygons_of_lod;
  for (const SourceBuilding& building : source.buildings) {
    std::set<int> lods;
    for (const SourceMember& member : building.members) {
      lods.insert(member.lod);
      ++info.polygons_of_lod[member.lod];
    }
    for (const int lod : lods) ++info.buildings_of_lod[lod];
  }
  return info;
}

void DescribeMesh(const CityModel& model, CityInfo& info) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : model.vertices) box.extend(v + model.origin_in_world);
  if (!box.isEmpty()) {
    info.lowest = box.min();
    info.highest = box.max();
    info.center_lat_lon = LatitudeLongitude(model.crs, box.center().head<2>());
  }
  std::set<std::string> wholes;
  for (const Building& building : model.buildings) {
    wholes.insert(building.parent_id.empty() ? building.id : building.parent_id);
    if (!building.parent_id.empty()) ++info.parts;
  }
  info.buildings = wholes.size();
  for (const Surface& surface : model.surfaces) {
    ++info.surfaces_of_class[static_cast<std::size_t>(surface.surface_class)];
  }
  for (const Triangle& t : model.triangles) {
    const Eigen::Vector3d& a = model.vertices[t.vertices[0]];
    const Eigen::Vector3d cross =
        (model.vertices[t.vertices[1]] - a).cross(model.vertices[t.vertices[2]] - a);
    const auto c = static_cast<std::size_t>(model.surfaces[t.surface].surface_class);
    info.area_of_class[c] += 0.5 * cross.norm();
  }
  info.vertices = model.vertices.size();
  info.triangles = model.triangles.size();
  for (const FeatureEdge& edge : model.feature_edges) {
    if (edge.seam) {
      ++info.seams;
    } else {
      ++info.edges;
      info.edge_length += (edge.b - edge.a).norm();
    }
  }
}

}  // namespace

CityInfo DescribeCity(const std::vector<std::filesystem::path>& paths, const CityOptions& options) {
  CityInfo info;
  CitySources city = ReadCitySources(paths, options);
  ProjectedSources& projected = city.projected;
  for (const SourceModel& source : projected.sources) {
    info.files.push_back(DescribeSource(source));
    for (const auto& [lod, count] : source.polygons_of_lod) {
      if (count.met == count.read + count.named) continue;
      info.warnings.push_back(
          source.file + ": LoD" + std::to_string(lod) + " has " + std::to_string(count.met) +
          " polygons, but " + std::to_string(count.read) + " were read and " +
          std::to_string(count.named) + " named as passed over (a fault of ridgeline)");
    }
  }
  BuildStatistics statistics;
  const CityModel model = BuildModel(projected.sources, projected.crs, options, &statistics);
  info.crs = model.crs;
  info.classified_by_normal = statistics.classified_by_normal;
  info.dropped = std::move(statistics.tally);
  info.warnings.insert(info.warnings.end(), city.warnings.begin(), city.warnings.end());
  info.warnings.insert(info.warnings.end(), model.warnings.begin(), model.warnings.end());
  DescribeMesh(model, info);
  for (const std::uint32_t b : FindOpenShells(model)) {
    info.open_shells.push_back(model.buildings[b].id);
  }
  for (const std::uint32_t b : FindCrossingShells(model, options.threads)) {
    info.crossing_shells.push_back(model.buildings[b].id);
  }
  return info;
}

const char* SurfaceClassName(SurfaceClass surface_class) {
  switch (surface_class) {
    case SurfaceClass::kWall:
      return "wall";
    case SurfaceClass::kRoof:
      return "roof";
    case SurfaceClass::kGround:
      return "ground";
    case SurfaceClass::kClosure:
      return "closure";
    case SurfaceClass::kOther:
      return "other";
    case SurfaceClass::kTerrain:
      return "terrain";
  }
  return "other";
}

}  // namespace ridgeline
