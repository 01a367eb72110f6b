// SPDX-License-Identifier: Apache-2.0
// What libcitygml and ridgeline make of CityGML files, beside a plain count of their tags: one row
// of a table per file. See docs/city_data.md.
//
//   city_compare tile.gml ...
#include <citygml/citygml.h>
#include <citygml/citygmllogger.h>
#include <citygml/citymodel.h>
#include <citygml/cityobject.h>
#include <citygml/geometry.h>
#include <citygml/polygon.h>

#include <Eigen/Geometry>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "city/city_info.h"
#include "city/format/formats.h"
#include "city/xml_count.h"

namespace {

using ridgeline::CityInfo;

class CountingLogger final : public citygml::CityGMLLogger {
 public:
  CountingLogger() : CityGMLLogger(LOGLEVEL::LL_ERROR) {}
  void log(LOGLEVEL, const std::string&, const char*, int) const override { ++errors; }
  mutable std::atomic<int> errors{0};
};

struct Peer {
  std::size_t polygons = 0;
  double area = 0.0;
  int errors = 0;
  double seconds = 0.0;
  std::string failure;
};

using PolygonsOfLod = std::map<unsigned, std::set<const citygml::Polygon*>>;

void Collect(const citygml::Geometry& geometry, unsigned lod, PolygonsOfLod& polygons) {
  for (unsigned i = 0; i < geometry.getPolygonsCount(); ++i) {
    polygons[lod].insert(geometry.getPolygon(i).get());
  }
  for (unsigned i = 0; i < geometry.getGeometriesCount(); ++i) {
    Collect(geometry.getGeometry(i), lod, polygons);
  }
}

void Collect(const citygml::CityObject& object, PolygonsOfLod& polygons) {
  if (object.getType() == citygml::CityObject::CityObjectsType::COT_Room) return;
  for (unsigned i = 0; i < object.getGeometriesCount(); ++i) {
    Collect(object.getGeometry(i), object.getGeometry(i).getLOD(), polygons);
  }
  for (unsigned i = 0; i < object.getChildCityObjectsCount(); ++i) {
    Collect(object.getChildCityObject(i), polygons);
  }
}

double AreaOf(const citygml::Polygon& polygon) {
  const std::vector<TVec3d>& v = polygon.getVertices();
  const std::vector<unsigned>& index = polygon.getIndices();
  const auto point = [&](unsigned i) { return Eigen::Vector3d(v[i].x, v[i].y, v[i].z); };
  double area = 0.0;
  for (std::size_t i = 0; i + 2 < index.size(); i += 3) {
    const Eigen::Vector3d a = point(index[i]);
    area += 0.5 * (point(index[i + 1]) - a).cross(point(index[i + 2]) - a).norm();
  }
  return area;
}

double Seconds(std::chrono::steady_clock::time_point since) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
}

Peer ReadWithPeer(const std::string& file) {
  Peer peer;
  const auto logger = std::make_shared<CountingLogger>();
  const auto start = std::chrono::steady_clock::now();
  try {
    const auto model = citygml::load(file, citygml::ParserParams(), logger);
    peer.seconds = Seconds(start);
    if (model == nullptr) {
      peer.failure = "no model";
    } else {
      for (unsigned i = 0; i < model->getNumRootCityObjects(); ++i) {
        const citygml::CityObject& object = model->getRootCityObject(static_cast<int>(i));
        if (object.getType() != citygml::CityObject::CityObjectsType::COT_Building) continue;
        PolygonsOfLod of_lod;
        Collect(object, of_lod);
        for (const unsigned lod : {2u, 3u, 4u, 1u}) {
          if (of_lod[lod].empty()) continue;
          peer.polygons += of_lod[lod].size();
          for (const citygml::Polygon* polygon : of_lod[lod]) peer.area += AreaOf(*polygon);
          break;
        }
      }
    }
  } catch (const std::exception& e) {
    peer.seconds = Seconds(start);
    peer.failure = e.what();
  }
  peer.errors = logger->errors;
  return peer;
}

void Row(const std::string& file) {
  const ridgeline::testing::XmlCount expected = ridgeline::testing::CountXml(file);
  const Peer peer = ReadWithPeer(file);
  const auto start = std::chrono::steady_clock::now();
  ridgeline::ReadModelFile(file);
  const double parse_seconds = Seconds(start);
  const CityInfo info = ridgeline::DescribeCity({file}, {});
  std::size_t surfaces = 0;
  double area = 0.0;
  for (std::size_t c = 0; c < info.surfaces_of_class.size(); ++c) {
    surfaces += info.surfaces_of_class[c];
    area += info.area_of_class[c];
  }
  const double megabytes = static_cast<double>(std::filesystem::file_size(file)) / 1e6;
  std::printf("| %s | %.1f | %zu | %.0f | %zu | %.0f | %d | %.0f | %zu | %.0f | %.0f |%s\n",
              std::filesystem::path(file).filename().c_str(),
              megabytes,
              expected.polygons,
              expected.area,
              peer.polygons,
              peer.area,
              peer.errors,
              megabytes / peer.seconds,
              surfaces,
              area,
              megabytes / parse_seconds,
              peer.failure.empty() ? "" : (" " + peer.failure).c_str());
}

}  // namespace

int main(int count, char** arguments) {
  std::printf(
      "| file | MB | polygons | m2 | libcitygml | m2 | errors logged | MB/s | ridgeline | m2 | "
      "MB/s |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (int i = 1; i < count; ++i) {
    try {
      Row(arguments[i]);
    } catch (const std::exception& e) {
      std::printf("| %s | %s |\n", arguments[i], e.what());
    }
    std::fflush(stdout);
  }
  return 0;
}
