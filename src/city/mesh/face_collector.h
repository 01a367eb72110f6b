// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "city/city_model.h"
#include "city/mesh/face_set.h"
#include "city/mesh/point_welder.h"
#include "city/source_model.h"

namespace ridgeline {

// Polygons smaller than this are noise [m²].
inline constexpr double kMinFaceArea = 1e-4;

// Gathers the faces and buildings of source models in the local frame of `model`: chosen levels of
// detail only, vertices welded, degenerate and repeated polygons taken out (and counted in the
// source's tally), holes turned against their outer rings.
class FaceCollector {
 public:
  // Appends to model.buildings; the model's origin must be set.
  FaceCollector(CityModel& model, double weld_m) : model_(model), welder_(weld_m) {}

  // @param lods  Per building of the source: the level to take, -1 for none.
  void Add(SourceModel& source, const std::vector<std::int8_t>& lods);

  // The faces, without classes where the source gave none. Call once, after all Add.
  FaceSet Release();

  // Gives classes by normal to the faces that have none; returns their number. Call after the faces
  // were turned outwards.
  std::size_t Classify(FaceSet& set) const;

  // Index of the whole (or of its first part) of every building.
  const std::vector<std::uint32_t>& roots() const { return roots_; }

 private:
  bool IsInEarlierFile(const SourceBuilding& building, const Eigen::Vector3d& middle) const;
  Eigen::Vector3d MiddleOf(const SourceBuilding& building, int lod) const;
  void AppendBuilding(const SourceBuilding& building);
  void AddBuilding(const SourceBuilding& building, std::uint32_t index, int lod);
  void AddFace(const SourceMember& member, const SourceBuilding& building, std::uint32_t index);
  bool AddRing(const SourceRing& ring, bool reversed);
  void PutOuterRingFirst(const Face& face, const std::string& building_id);
  void ReverseRing(std::uint32_t ring);
  bool Measure(Face& face);
  Eigen::Vector3d NewellVector(std::uint32_t ring) const;
  std::vector<std::uint32_t> SortedCorners(const Face& face) const;

  CityModel& model_;
  PointWelder welder_;
  FaceSet set_;
  SourceModel* source_ = nullptr;
  std::size_t source_number_ = 0;
  std::vector<std::uint32_t> roots_;
  std::vector<double> lowest_of_building_;
  std::map<std::pair<std::size_t, int>, std::uint32_t> first_of_top_;
  std::multimap<std::string, Eigen::Vector3d> earlier_;  // id and middle, of earlier files
  std::set<std::vector<std::uint32_t>> faces_seen_;      // of the present building
};

}  // namespace ridgeline
