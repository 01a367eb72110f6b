// SPDX-License-Identifier: Apache-2.0
#include "city/build_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "city/face_set.h"
#include "city/feature_edges.h"
#include "city/joint_seams.h"
#include "city/orient_faces.h"
#include "city/point_welder.h"
#include "city/select_lod.h"
#include "city/triangulate.h"

namespace ridgeline {
namespace {

constexpr double kMinArea = 1e-4;      // [m²]: smaller polygons are noise
constexpr double kSteep = 0.1;         // |normal.z| below it: a wall, when nothing says otherwise
constexpr double kGroundLevel = 1.0;   // [m] above the lowest point of a building
constexpr double kOriginGrid = 100.0;  // [m]: the local origin is a round number

// Collects the faces of all sources in one frame.
class FaceCollector {
 public:
  FaceCollector(CityModel& model, const CityOptions& options)
      : model_(model), options_(options), welder_(options.weld_m) {}

  void Add(SourceModel& source, const std::vector<std::int8_t>& lods) {
    source_ = &source;
    for (std::size_t b = 0; b < source.buildings.size(); ++b) {
      const SourceBuilding& building = source.buildings[b];
      if (lods[b] < 0) continue;
      if (!building.id.empty() && IsInEarlierFile(building)) {
        source.tally.Add("buildings that an earlier file holds too, taken once", building.id);
        continue;
      }
      const std::size_t old_faces = set_.faces.size();
      AddBuilding(building, static_cast<std::uint32_t>(model_.buildings.size()), lods[b]);
      if (set_.faces.size() == old_faces) {
        source.tally.Add("buildings without any usable surface dropped", building.id);
        lowest_of_building_.pop_back();
        continue;
      }
      AppendBuilding(source, building);
    }
    for (const SourceBuilding& building : source.buildings) earlier_ids_.insert(building.id);
  }

  FaceSet Release() {
    set_.vertices = welder_.Release();
    return std::move(set_);
  }
  const std::vector<std::uint32_t>& roots() const { return roots_; }

 private:
  bool IsInEarlierFile(const SourceBuilding& building) const {
    return earlier_ids_.contains(building.id);
  }

  void AppendBuilding(const SourceModel& source, const SourceBuilding& building) {
    const std::uint32_t number = static_cast<std::uint32_t>(model_.buildings.size());
    Building out;
    out.id = building.id.empty() ? "building-" + std::to_string(number + 1) : building.id;
    int top = -1;
    for (int p = building.parent; p >= 0;
         p = source.buildings[static_cast<std::size_t>(p)].parent) {
      if (out.parent_id.empty()) out.parent_id = source.buildings[static_cast<std::size_t>(p)].id;
      top = p;
    }
    model_.buildings.push_back(std::move(out));
    // Buildings of one whole share its first member as root.
    if (top < 0) top = static_cast<int>(&building - source.buildings.data());
    const auto [it, is_new] = first_of_top_.try_emplace({&source, top}, number);
    roots_.push_back(it->second);
  }

  void AddBuilding(const SourceBuilding& building, std::uint32_t index, int lod) {
    faces_seen_.clear();
    double lowest = std::numeric_limits<double>::infinity();
    const std::size_t first_face = set_.faces.size();
    for (const SourceMember& member : building.members) {
      if (member.lod == lod) AddFace(member, building, index);
    }
    for (std::size_t f = first_face; f < set_.faces.size(); ++f) {
      for (const std::uint32_t v : set_.Ring(set_.faces[f].first_ring)) {
        lowest = std::min(lowest, welder_.points()[v].z());
      }
    }
    lowest_of_building_.push_back(lowest);
  }

  void AddFace(const SourceMember& member, const SourceBuilding& building, std::uint32_t index) {
    const SourcePolygon& polygon = source_->polygons[member.polygon];
    Face face;
    face.building = index;
    face.surface_class = member.surface_class;
    face.has_class = member.has_class;
    face.first_ring = static_cast<std::uint32_t>(set_.rings.size());
    const std::size_t old_corners = set_.corners.size();
    for (std::uint32_t r = 0; r < polygon.ring_count; ++r) {
      const bool usable = AddRing(source_->rings[polygon.first_ring + r], member.reversed);
      if (r == 0 && !usable) break;
      if (!usable) source_->tally.Add("degenerate holes dropped", building.id);
    }
    face.ring_count = static_cast<std::uint32_t>(set_.rings.size()) - face.first_ring;
    const char* problem = nullptr;
    if (face.ring_count == 0 || !Measure(face)) {
      problem = "polygons without area dropped";
    } else if (!faces_seen_.insert(SortedCorners(face)).second) {
      problem = "polygons given twice dropped";
    }
    if (problem != nullptr) {
      source_->tally.Add(problem, building.id);
      set_.corners.resize(old_corners);
      set_.rings.resize(face.first_ring);
      return;
    }
    set_.faces.push_back(face);
  }

  // Welds a ring and takes out repetitions and spikes. False if nothing of it remains.
  bool AddRing(const SourceRing& ring, bool reversed) {
    FaceRing out{static_cast<std::uint32_t>(set_.corners.size()), 0};
    std::vector<std::uint32_t>& corners = set_.corners;
    for (std::uint32_t i = 0; i < ring.point_count; ++i) {
      const std::uint32_t k = reversed ? ring.point_count - 1 - i : i;
      const std::uint32_t v =
          welder_.Add(source_->points[ring.first_point + k] - model_.origin_in_world);
      const std::size_t n = corners.size() - out.first;
      if (n > 0 && corners.back() == v) continue;
      if (n > 1 && corners[corners.size() - 2] == v) {
        corners.pop_back();
        continue;
      }
      corners.push_back(v);
    }
    const auto size = [&] { return corners.size() - out.first; };
    while (size() > 2) {
      const std::uint32_t* const first = corners.data() + out.first;
      if (first[0] == corners.back()) {
        corners.pop_back();
      } else if (first[0] == corners[corners.size() - 2]) {
        corners.resize(corners.size() - 2);
      } else if (first[1] == corners.back()) {
        corners.erase(corners.begin() + out.first);
      } else {
        break;
      }
    }
    out.count = static_cast<std::uint32_t>(size());
    if (out.count < 3) {
      corners.resize(out.first);
      return false;
    }
    set_.rings.push_back(out);
    return true;
  }

  // Normal, area and centroid; turns holes against the outer ring. False without area.
  bool Measure(Face& face) {
    const auto newell = [this](std::uint32_t ring) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      const std::span<const std::uint32_t> corners = set_.Ring(ring);
      const Eigen::Vector3d& first = welder_.points()[corners.front()];
      for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum +=
            (welder_.points()[corners[i]] - first).cross(welder_.points()[corners[i + 1]] - first);
      }
      return sum;
    };
    const Eigen::Vector3d outer = newell(face.first_ring);
    const double outer_area = 0.5 * outer.norm();
    if (outer_area < kMinArea) return false;
    face.normal = outer.normalized();
    face.area = outer_area;
    for (std::uint32_t r = face.first_ring + 1; r < face.first_ring + face.ring_count; ++r) {
      const double hole = 0.5 * newell(r).dot(face.normal);
      if (hole > 0.0) {
        const auto begin = set_.corners.begin() + set_.rings[r].first;
        std::reverse(begin, begin + set_.rings[r].count);
      }
      face.area -= std::abs(hole);
    }
    face.area = std::max(face.area, kMinArea);
    const std::span<const std::uint32_t> corners = set_.Ring(face.first_ring);
    for (const std::uint32_t v : corners) face.centroid += welder_.points()[v];
    face.centroid /= static_cast<double>(corners.size());
    return true;
  }

  std::vector<std::uint32_t> SortedCorners(const Face& face) const {
    const FaceRing& last = set_.rings[face.first_ring + face.ring_count - 1];
    std::vector<std::uint32_t> corners(set_.corners.begin() + set_.rings[face.first_ring].first,
                                       set_.corners.begin() + last.first + last.count);
    std::sort(corners.begin(), corners.end());
    return corners;
  }

 public:
  // Classes for the faces whose source gave none, after all have been turned outwards.
  void Classify(FaceSet& set) const {
    for (Face& face : set.faces) {
      if (face.has_class) continue;
      const double z = face.normal.z();
      const bool low = face.centroid.z() < lowest_of_building_[face.building] + kGroundLevel;
      if (std::abs(z) < kSteep) {
        face.surface_class = SurfaceClass::kWall;
      } else if (z > 0.0) {
        face.surface_class = SurfaceClass::kRoof;
      } else {
        face.surface_class = low ? SurfaceClass::kGround : SurfaceClass::kOther;
      }
    }
  }

 private:
  CityModel& model_;
  const CityOptions& options_;
  PointWelder welder_;
  FaceSet set_;
  SourceModel* source_ = nullptr;
  std::vector<std::uint32_t> roots_;
  std::vector<double> lowest_of_building_;
  std::map<std::pair<const SourceModel*, int>, std::uint32_t> first_of_top_;
  std::set<std::string> earlier_ids_;
  std::set<std::vector<std::uint32_t>> faces_seen_;  // of the present building
};

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
  result.crosses_itself = std::abs(area - face.area) > kAreaTolerance * face.area + kMinArea;
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
                     const CityOptions& options) {
  CityModel model;
  model.crs = crs;
  model.origin_in_world = RoundOrigin(sources);
  FaceCollector collector(model, options);
  Tally tally;
  for (SourceModel& source : sources) {
    const std::vector<std::int8_t> lods = SelectLod(source, options.lod);
    collector.Add(source, lods);
    tally.Merge(source.tally);
  }
  FaceSet set = collector.Release();
  std::vector<std::string> ids;
  for (const Building& building : model.buildings) ids.push_back(building.id);
  OrientFaces(set, ids, tally);
  collector.Classify(set);
  AppendMesh(set, options.threads, model, tally);
  const FeatureEdgeOptions edge_options{
      options.min_dihedral_deg, options.adjoin_m, options.threads};
  model.feature_edges = FindFeatureEdges(set, collector.roots(), edge_options);
  MarkJointSeams(set, collector.roots(), options.joint_m, model.feature_edges);
  model.vertices = std::move(set.vertices);
  const std::vector<std::string> lines = tally.Lines();
  model.warnings.insert(model.warnings.end(), lines.begin(), lines.end());
  return model;
}

}  // namespace ridgeline
