// SPDX-License-Identifier: Apache-2.0
#include "city/mesh/build_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "city/mesh/face_collector.h"
#include "city/mesh/face_set.h"
#include "city/mesh/feature_edges.h"
#include "city/mesh/joint_seams.h"
#include "city/mesh/orient_faces.h"
#include "city/mesh/select_lod.h"
#include "city/mesh/triangulate.h"

namespace ridgeline {
namespace {

constexpr double kOriginGrid = 100.0;  // [m]: the local origin is a round number

Eigen::Vector3d RoundOrigin(const std::vector<SourceModel>& sources) {
  Eigen::AlignedBox3d box;
  for (const SourceModel& source : sources) {
    for (const Eigen::Vector3d& point : source.points) box.extend(point);
  }
  if (box.isEmpty()) return Eigen::Vector3d::Zero();
  return (box.center() / kOriginGrid).array().round().matrix() * kOriginGrid;
}

// A face in its plane.
PlanarPolygon Flatten(const FaceSet& set, const Face& face, std::vector<std::uint32_t>& corners) {
  PlanarPolygon polygon;
  const Eigen::Vector3d u = face.normal.unitOrthogonal();
  const Eigen::Vector3d v = face.normal.cross(u);
  corners.clear();
  for (std::uint32_t r = face.first_ring; r < face.first_ring + face.ring_count; ++r) {
    for (const std::uint32_t corner : set.Ring(r)) {
      const Eigen::Vector3d relative = set.vertices[corner] - face.centroid;
      polygon.points.emplace_back(relative.dot(u), relative.dot(v));
      corners.push_back(corner);
    }
    polygon.ring_ends.push_back(static_cast<std::uint32_t>(polygon.points.size()));
  }
  return polygon;
}

struct FaceTriangles {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  bool crosses_itself = false;
};

FaceTriangles TriangulateFace(const FaceSet& set, const Face& face) {
  FaceTriangles result;
  std::vector<std::uint32_t> corners;
  const PlanarPolygon polygon = Flatten(set, face, corners);
  double area = 0.0;
  for (const TriangleIndices& t : Triangulate(polygon)) {
    area += 0.5 * Cross(polygon.points[t[0]], polygon.points[t[1]], polygon.points[t[2]]);
    result.triangles.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
  }
  constexpr double kAreaTolerance = 0.01;
  result.crosses_itself = std::abs(area - face.area) > kAreaTolerance * face.area + kMinFaceArea;
  return result;
}

void AppendMesh(const FaceSet& set, int threads, CityModel& model, Tally& tally) {
  std::vector<FaceTriangles> triangulated(set.faces.size());
  constexpr std::size_t kBlock = 1024;
  ParallelFor((set.faces.size() + kBlock - 1) / kBlock, threads, [&](std::size_t block) {
    const std::size_t end = std::min(set.faces.size(), (block + 1) * kBlock);
    for (std::size_t f = block * kBlock; f < end; ++f) {
      triangulated[f] = TriangulateFace(set, set.faces[f]);
    }
  });
  model.surfaces.reserve(set.faces.size());
  for (std::size_t f = 0; f < set.faces.size(); ++f) {
    const Face& face = set.faces[f];
    const auto surface = static_cast<std::uint32_t>(model.surfaces.size());
    model.surfaces.push_back({face.surface_class, face.building, face.normal.cast<float>()});
    for (const auto& t : triangulated[f].triangles) model.triangles.push_back({t, surface});
    if (triangulated[f].crosses_itself) {
      tally.Add("polygons whose outline crosses itself, filled as far as possible",
                model.buildings[face.building].id);
    }
  }
}

}  // namespace

CityModel BuildModel(std::vector<SourceModel>& sources,
                     const Crs& crs,
                     const MeshOptions& options,
                     BuildStatistics* statistics) {
  CityModel model;
  model.crs = crs;
  model.origin_in_world = RoundOrigin(sources);
  FaceCollector collector(model, options.weld_m);
  BuildStatistics stats;
  for (SourceModel& source : sources) {
    collector.Add(source, SelectLod(source, options.lod));
    stats.tally.Merge(source.tally);
    source = SourceModel{};
  }
  FaceSet set = collector.Release();
  std::vector<std::string> ids;
  for (const Building& building : model.buildings) ids.push_back(building.id);
  OrientFaces(set, ids, stats.tally);
  stats.classified_by_normal = collector.Classify(set);
  AppendMesh(set, options.threads, model, stats.tally);
  const FeatureEdgeOptions edge_options{
      options.min_dihedral_deg, options.adjoin_m, options.threads};
  model.feature_edges = FindFeatureEdges(set, collector.roots(), edge_options);
  MarkJointSeams(set, collector.roots(), options.joint_m, model.feature_edges);
  model.vertices = std::move(set.vertices);
  model.warnings = stats.tally.Lines();
  if (statistics != nullptr) *statistics = std::move(stats);
  return model;
}

}  // namespace ridgeline
