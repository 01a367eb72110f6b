// SPDX-License-Identifier: Apache-2.0
#include "city/city_text.h"

#include <unistd.h>

#include <Eigen/Geometry>
#include <atomic>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace ridgeline::testing {
namespace {

std::string RingText(const Ring& ring) {
  std::ostringstream text;
  text << std::setprecision(15) << "<gml:LinearRing><gml:posList srsDimension=\"3\">";
  for (const Eigen::Vector3d& p : ring) text << p.x() << ' ' << p.y() << ' ' << p.z() << ' ';
  text << ring.front().x() << ' ' << ring.front().y() << ' ' << ring.front().z();
  text << "</gml:posList></gml:LinearRing>";
  return text.str();
}

}  // namespace

TestFolder::TestFolder() {
  static std::atomic<int> counter{0};
  path_ = std::filesystem::temp_directory_path() /
          ("ridgeline_city_" + std::to_string(::getpid()) + "_" + std::to_string(counter++));
  std::filesystem::create_directories(path_);
}

TestFolder::~TestFolder() {
  std::error_code error;
  std::filesystem::remove_all(path_, error);
}

std::filesystem::path TestFolder::Write(const std::string& name, const std::string& content) const {
  const std::filesystem::path file = path_ / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << content;
  return file;
}

std::string GmlPolygon(const Ring& outer, const std::vector<Ring>& holes, const std::string& id) {
  std::string text = "<gml:Polygon" + (id.empty() ? "" : " gml:id=\"" + id + "\"") + ">";
  text += "<gml:exterior>" + RingText(outer) + "</gml:exterior>";
  for (const Ring& hole : holes) text += "<gml:interior>" + RingText(hole) + "</gml:interior>";
  return text + "</gml:Polygon>";
}

std::string GmlBoundary(const std::string& type, const std::string& polygons, int lod) {
  const std::string property = "bldg:lod" + std::to_string(lod) + "MultiSurface";
  return "<bldg:boundedBy><bldg:" + type + "><" + property +
         "><gml:MultiSurface><gml:surfaceMember>" + polygons +
         "</gml:surfaceMember></gml:MultiSurface></" + property + "></bldg:" + type +
         "></bldg:boundedBy>\n";
}

std::string GmlBuilding(const std::string& id, const std::string& content) {
  return "<core:cityObjectMember><bldg:Building" + (id.empty() ? "" : " gml:id=\"" + id + "\"") +
         ">\n" + content + "</bldg:Building></core:cityObjectMember>\n";
}

std::string GmlDocument(const std::string& members, const std::string& srs_name) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<core:CityModel xmlns:core=\"http://www.opengis.net/citygml/2.0\" "
      "xmlns:bldg=\"http://www.opengis.net/citygml/building/2.0\" "
      "xmlns:gml=\"http://www.opengis.net/gml\" xmlns:xlink=\"http://www.w3.org/1999/xlink\">\n";
  if (!srs_name.empty()) {
    text += "<gml:boundedBy><gml:Envelope srsName=\"" + srs_name + "\"/></gml:boundedBy>\n";
  }
  return text + members + "</core:CityModel>\n";
}

std::vector<Ring> BoxRings(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const auto p = [&](int x, int y, int z) {
    return Eigen::Vector3d(x ? b.x() : a.x(), y ? b.y() : a.y(), z ? b.z() : a.z());
  };
  return {{p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1)},
          {p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1)},
          {p(1, 1, 0), p(0, 1, 0), p(0, 1, 1), p(1, 1, 1)},
          {p(0, 1, 0), p(0, 0, 0), p(0, 0, 1), p(0, 1, 1)},
          {p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1)},
          {p(0, 0, 0), p(0, 1, 0), p(1, 1, 0), p(1, 0, 0)}};
}

std::string GmlBox(const std::string& id, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  const std::vector<Ring> rings = BoxRings(low, high);
  std::string content;
  for (int i = 0; i < 4; ++i) content += GmlBoundary("WallSurface", GmlPolygon(rings[i]));
  content += GmlBoundary("RoofSurface", GmlPolygon(rings[4]));
  content += GmlBoundary("GroundSurface", GmlPolygon(rings[5]));
  return GmlBuilding(id, content);
}

CityModel ReadGml(const std::string& document, const CityOptions& options) {
  const TestFolder folder;
  return ReadCity({folder.Write("model.gml", document)}, options);
}

double Area(const CityModel& model) {
  double area = 0.0;
  for (const Triangle& t : model.triangles) {
    const Eigen::Vector3d& a = model.vertices[t.vertices[0]];
    area +=
        0.5 * (model.vertices[t.vertices[1]] - a).cross(model.vertices[t.vertices[2]] - a).norm();
  }
  return area;
}

double Area(const CityModel& model, SurfaceClass surface_class) {
  CityModel part = model;
  std::erase_if(part.triangles, [&](const Triangle& t) {
    return model.surfaces[t.surface].surface_class != surface_class;
  });
  return Area(part);
}

double Volume(const CityModel& model) {
  double volume = 0.0;
  for (const Triangle& t : model.triangles) {
    const Eigen::Vector3d& a = model.vertices[t.vertices[0]];
    volume += a.dot(model.vertices[t.vertices[1]].cross(model.vertices[t.vertices[2]])) / 6.0;
  }
  return volume;
}

}  // namespace ridgeline::testing
