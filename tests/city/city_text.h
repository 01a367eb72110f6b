// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "city/city_model.h"
#include "city/read_city.h"

namespace ridgeline::testing {

// A folder that is removed with its content at the end of a test.
class TestFolder {
 public:
  TestFolder();
  ~TestFolder();
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  std::filesystem::path path() const { return path_; }
  // Writes a file and returns its path.
  std::filesystem::path Write(const std::string& name, const std::string& content) const;

 private:
  std::filesystem::path path_;
};

using Ring = std::vector<Eigen::Vector3d>;

// "<gml:Polygon ...>" of an outer ring and holes; rings are closed by this function.
std::string GmlPolygon(const Ring& outer,
                       const std::vector<Ring>& holes = {},
                       const std::string& id = "");
// A boundary surface, e.g. "WallSurface", with the given geometry members at LoD2.
std::string GmlBoundary(const std::string& type, const std::string& polygons, int lod = 2);
std::string GmlBuilding(const std::string& id, const std::string& content);
// A CityGML 2.0 document; no envelope if `srs_name` is empty.
std::string GmlDocument(const std::string& members, const std::string& srs_name = "EPSG:25832");

// Outer rings of a box's walls (4), roof and ground, seen from outside.
std::vector<Ring> BoxRings(const Eigen::Vector3d& low, const Eigen::Vector3d& high);
// A building of boundary surfaces.
std::string GmlBox(const std::string& id, const Eigen::Vector3d& low, const Eigen::Vector3d& high);

// Writes the text to a file and reads it.
CityModel ReadGml(const std::string& document, const CityOptions& options = {});

// Sum of the triangles' areas [m²], all or of one class.
double Area(const CityModel& model);
double Area(const CityModel& model, SurfaceClass surface_class);
// Volume that the triangles enclose [m³], positive if they face outwards.
double Volume(const CityModel& model);

// A corner somewhere in UTM zone 32.
inline const Eigen::Vector3d kCorner(691000.0, 5336000.0, 500.0);

}  // namespace ridgeline::testing
