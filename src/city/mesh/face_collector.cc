// SPDX-License-Identifier: Apache-2.0
#include "city/mesh/face_collector.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace ridgeline {
namespace {

constexpr double kSteep = 0.1;        // |normal.z| below it: a wall, when nothing says otherwise
constexpr double kGroundLevel = 1.0;  // [m] above the lowest point of a building
constexpr double kSamePlace = 1.0;    // [m]: a building of the same id nearer than this is the same

}  // namespace

void FaceCollector::Add(SourceModel& source, const std::vector<std::int8_t>& lods) {
  source_ = &source;
  ++source_number_;
  std::vector<std::pair<std::string, Eigen::Vector3d>> here;
  for (std::size_t b = 0; b < source.buildings.size(); ++b) {
    const SourceBuilding& building = source.buildings[b];
    if (lods[b] < 0) continue;
    const Eigen::Vector3d middle = MiddleOf(building, lods[b]);
    if (IsInEarlierFile(building, middle)) {
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
    AppendBuilding(building);
    if (!building.id.empty()) here.emplace_back(building.id, middle);
  }
  earlier_.insert(here.begin(), here.end());
}

FaceSet FaceCollector::Release() {
  set_.vertices = welder_.Release();
  return std::move(set_);
}

// Tiles overlap, and then hold the same building; ids such as "1" also come again by chance.
bool FaceCollector::IsInEarlierFile(const SourceBuilding& building,
                                    const Eigen::Vector3d& middle) const {
  const auto [first, last] = earlier_.equal_range(building.id);
  return std::any_of(
      first, last, [&](const auto& entry) { return (entry.second - middle).norm() < kSamePlace; });
}

Eigen::Vector3d FaceCollector::MiddleOf(const SourceBuilding& building, int lod) const {
  Eigen::AlignedBox3d box;
  for (const SourceMember& member : building.members) {
    if (member.lod != lod) continue;
    const SourceRing& ring = source_->rings[source_->polygons[member.polygon].first_ring];
    for (std::uint32_t i = 0; i < ring.point_count; ++i) {
      box.extend(source_->points[ring.first_point + i]);
    }
  }
  return box.isEmpty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(box.center());
}

void FaceCollector::AppendBuilding(const SourceBuilding& building) {
  const std::vector<SourceBuilding>& all = source_->buildings;
  const auto number = static_cast<std::uint32_t>(model_.buildings.size());
  Building out;
  out.id = building.id.empty() ? "building-" + std::to_string(number + 1) : building.id;
  auto top = static_cast<int>(&building - all.data());
  if (building.parent >= 0) out.parent_id = all[static_cast<std::size_t>(building.parent)].id;
  while (all[static_cast<std::size_t>(top)].parent >= 0) {
    top = all[static_cast<std::size_t>(top)].parent;
  }
  model_.buildings.push_back(std::move(out));
  // The parts of one whole share its first member as root.
  roots_.push_back(first_of_top_.try_emplace({source_number_, top}, number).first->second);
}

void FaceCollector::AddBuilding(const SourceBuilding& building, std::uint32_t index, int lod) {
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

void FaceCollector::AddFace(const SourceMember& member,
                            const SourceBuilding& building,
                            std::uint32_t index) {
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
  if (face.ring_count > 1) PutOuterRingFirst(face, building.id);
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
bool FaceCollector::AddRing(const SourceRing& ring, bool reversed) {
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

// Puts the largest ring first: files exist whose outer ring and hole have changed places.
void FaceCollector::PutOuterRingFirst(const Face& face, const std::string& building_id) {
  std::uint32_t largest = face.first_ring;
  for (std::uint32_t r = face.first_ring + 1; r < face.first_ring + face.ring_count; ++r) {
    if (NewellVector(r).norm() > NewellVector(largest).norm()) largest = r;
  }
  if (largest == face.first_ring) return;
  source_->tally.Add("polygons whose hole was larger than their outline, exchanged", building_id);
  const bool same_way = NewellVector(largest).dot(NewellVector(face.first_ring)) > 0.0;
  std::swap(set_.rings[largest], set_.rings[face.first_ring]);
  if (!same_way) ReverseRing(face.first_ring);
}

void FaceCollector::ReverseRing(std::uint32_t ring) {
  const auto begin = set_.corners.begin() + set_.rings[ring].first;
  std::reverse(begin, begin + set_.rings[ring].count);
}

// Normal, area and centroid; turns holes against the outer ring. False without area.
bool FaceCollector::Measure(Face& face) {
  const Eigen::Vector3d outer = NewellVector(face.first_ring);
  const double outer_area = 0.5 * outer.norm();
  if (outer_area < kMinFaceArea) return false;
  face.normal = outer.normalized();
  face.area = outer_area;
  for (std::uint32_t r = face.first_ring + 1; r < face.first_ring + face.ring_count; ++r) {
    const double hole = 0.5 * NewellVector(r).dot(face.normal);
    if (hole > 0.0) ReverseRing(r);
    face.area -= std::abs(hole);
  }
  face.area = std::max(face.area, kMinFaceArea);
  const std::span<const std::uint32_t> corners = set_.Ring(face.first_ring);
  for (const std::uint32_t v : corners) face.centroid += welder_.points()[v];
  face.centroid /= static_cast<double>(corners.size());
  return true;
}

Eigen::Vector3d FaceCollector::NewellVector(std::uint32_t ring) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const std::span<const std::uint32_t> corners = set_.Ring(ring);
  const Eigen::Vector3d& first = welder_.points()[corners.front()];
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    sum += (welder_.points()[corners[i]] - first).cross(welder_.points()[corners[i + 1]] - first);
  }
  return sum;
}

std::vector<std::uint32_t> FaceCollector::SortedCorners(const Face& face) const {
  std::vector<std::uint32_t> corners;
  for (std::uint32_t r = face.first_ring; r < face.first_ring + face.ring_count; ++r) {
    const std::span<const std::uint32_t> ring = set_.Ring(r);
    corners.insert(corners.end(), ring.begin(), ring.end());
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

std::size_t FaceCollector::Classify(FaceSet& set) const {
  std::size_t count = 0;
  for (Face& face : set.faces) {
    if (face.has_class) continue;
    ++count;
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
  return count;
}

}  // namespace ridgeline
