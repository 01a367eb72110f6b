// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "city/source_model.h"

namespace ridgeline {

// Collects the faces of a mesh file (OBJ, PLY) as buildings. Axes: x east, y north, z up [m].
//
// Meshes are stored with small numbers: where they lie comes from a comment in the file or a line
// in
// "<file>.offset" beside it, either as "offset E N H" or, in the sidecar, as three bare numbers;
// "crs EPSG:25832" in either place names the reference system.
class MeshSource {
 public:
  explicit MeshSource(const std::string& file);

  std::vector<Eigen::Vector3d>& vertices() { return vertices_; }
  // Text of a comment: "offset E N H", "crs NAME", or anything else, which is ignored.
  void Comment(std::string_view text);
  // Faces that follow belong to the object of this name. Names may come again.
  void BeginObject(std::string_view name);
  // Faces that follow are of this class ("roof", "Dach", "wall", ... in a group or material name).
  void SetClassFromName(std::string_view name);
  // A face of vertex indices; degenerate ones are counted. Indices must be valid.
  void AddFace(std::span<const std::uint32_t> corners);

  // The model: each object a building; a mesh without objects is split into its connected parts.
  SourceModel Finish();

 private:
  struct MeshFace {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    int object = -1;
    SurfaceClass surface_class = SurfaceClass::kOther;
    bool has_class = false;
  };

  void ReadSidecar();
  std::vector<int> BuildingOfFaces(std::vector<std::string>& names) const;

  SourceModel model_;
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<std::uint32_t> corners_;
  std::vector<MeshFace> faces_;
  std::vector<std::string> objects_;
  std::unordered_map<std::string, int> object_index_;
  int object_ = -1;
  SurfaceClass surface_class_ = SurfaceClass::kOther;
  bool has_class_ = false;
  std::optional<Eigen::Vector3d> offset_;
};

}  // namespace ridgeline
