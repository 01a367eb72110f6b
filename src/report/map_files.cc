// SPDX-License-Identifier: Apache-2.0
#include "report/map_files.h"

#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/gdal_handles.h"
#include "report/map_shapes.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;

constexpr double kConeReachM = 25.0;
constexpr double kDefaultFieldDeg = 60.0;

enum class Shape { kPoint, kLine, kPolygon };

struct Feature {
  const char* layer;
  const char* kind;  // of a pose: "prior", "result" or "truth"; else empty
  Shape shape;
  std::vector<Vector2d> points;
  const ReportRun* run;
  const ReportPose* pose;  // its angles are attributes; may be null
};

struct DestroyFeature {
  void operator()(OGRFeature* feature) const { OGRFeature::DestroyFeature(feature); }
};

std::vector<Feature> FeaturesOf(std::span<const ReportRun> runs) {
  std::vector<Feature> features;
  for (const ReportRun& run : runs) {
    const auto add_pose = [&](const char* kind, const std::optional<ReportPose>& pose) {
      if (!pose) return;
      features.push_back({"poses", kind, Shape::kPoint, {pose->position.head<2>()}, &run, &*pose});
      if (!pose->has_heading) return;  // no way to look
      const double field = run.hfov_deg > 0.0 ? run.hfov_deg : kDefaultFieldDeg;
      features.push_back(
          {"view_cones", kind, Shape::kPolygon, ViewCone(*pose, field, kConeReachM), &run, &*pose});
    };
    add_pose("prior", run.prior);
    add_pose("result", run.result);
    add_pose("truth", run.truth);
    if (!run.search_box.empty()) {
      features.push_back({"prior_boxes", "", Shape::kPolygon, run.search_box, &run, nullptr});
    }
    if (run.result && run.truth) {
      features.push_back({"errors",
                          "",
                          Shape::kLine,
                          {run.result->position.head<2>(), run.truth->position.head<2>()},
                          &run,
                          nullptr});
    }
    if (run.result && run.position_covariance) {
      features.push_back({"ellipses",
                          "",
                          Shape::kPolygon,
                          EllipseOutline(run.result->position.head<2>(), *run.position_covariance),
                          &run,
                          nullptr});
    }
  }
  return features;
}

std::unique_ptr<OGRGeometry> GeometryOf(const Feature& feature) {
  if (feature.shape == Shape::kPoint) {
    return std::make_unique<OGRPoint>(feature.points[0].x(), feature.points[0].y());
  }
  if (feature.shape == Shape::kLine) {
    auto line = std::make_unique<OGRLineString>();
    for (const Vector2d& p : feature.points) line->addPoint(p.x(), p.y());
    return line;
  }
  OGRLinearRing ring;
  for (const Vector2d& p : feature.points) ring.addPoint(p.x(), p.y());
  auto polygon = std::make_unique<OGRPolygon>();
  polygon->addRing(&ring);
  return polygon;
}

void AddFields(OGRLayer& layer) {
  const std::array<std::pair<const char*, OGRFieldType>, 14> fields = {{{"layer", OFTString},
                                                                        {"query", OFTString},
                                                                        {"seed", OFTInteger},
                                                                        {"kind", OFTString},
                                                                        {"status", OFTString},
                                                                        {"confidence", OFTReal},
                                                                        {"energy", OFTReal},
                                                                        {"error_m", OFTReal},
                                                                        {"error_deg", OFTReal},
                                                                        {"east", OFTReal},
                                                                        {"north", OFTReal},
                                                                        {"height", OFTReal},
                                                                        {"heading", OFTReal},
                                                                        {"pitch", OFTReal}}};
  for (const auto& [name, type] : fields) {
    OGRFieldDefn definition(name, type);
    layer.CreateField(&definition);
  }
}

bool AddFeature(const Feature& feature, OGRCoordinateTransformation* to_wgs84, OGRLayer& layer) {
  const std::unique_ptr<OGRFeature, DestroyFeature> row(
      OGRFeature::CreateFeature(layer.GetLayerDefn()));
  const ReportRun& run = *feature.run;
  row->SetField("layer", feature.layer);
  row->SetField("query", run.id.c_str());
  row->SetField("seed", run.seed);
  row->SetField("kind", feature.kind);
  row->SetField("status", run.status.c_str());
  if (std::isfinite(run.confidence)) row->SetField("confidence", run.confidence);
  if (std::isfinite(run.energy)) row->SetField("energy", run.energy);
  if (run.translation_m) row->SetField("error_m", *run.translation_m);
  if (run.rotation_deg) row->SetField("error_deg", *run.rotation_deg);
  if (feature.pose != nullptr) {
    row->SetField("east", feature.pose->position.x());
    row->SetField("north", feature.pose->position.y());
    row->SetField("height", feature.pose->position.z());
    if (feature.pose->has_heading) row->SetField("heading", feature.pose->heading_deg);
    row->SetField("pitch", feature.pose->pitch_deg);
  }
  std::unique_ptr<OGRGeometry> geometry = GeometryOf(feature);
  if (to_wgs84 != nullptr && geometry->transform(to_wgs84) != OGRERR_NONE) return false;
  row->SetGeometryDirectly(geometry.release());
  return layer.CreateFeature(row.get()) == OGRERR_NONE;
}

OGRwkbGeometryType TypeOf(Shape shape) {
  switch (shape) {
    case Shape::kPoint:
      return wkbPoint;
    case Shape::kLine:
      return wkbLineString;
    case Shape::kPolygon:
      return wkbPolygon;
  }
  return wkbUnknown;
}

OGRSpatialReference SystemOf(int epsg) {
  OGRSpatialReference system;
  if (epsg != 0) system.importFromEPSG(epsg);
  system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return system;
}

[[noreturn]] void FailWriting(const fs::path& path) {
  const std::string message = CPLGetLastErrorMsg();
  throw InputError(path.string(),
                   "",
                   message.empty() ? "a failed write" : message,
                   "a folder with space and permission to write");
}

const char* DriverOf(const fs::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".gpkg") return "GPKG";
  if (extension == ".geojson" || extension == ".json") return "GeoJSON";
  if (extension == ".kml") return "KML";
  throw InputError(
      path.string(), "", "\"" + extension + "\"", "a name that ends in .gpkg, .geojson or .kml");
}

}  // namespace

void CheckMapName(const std::filesystem::path& path) { DriverOf(path); }

void WriteMap(std::span<const ReportRun> runs, int epsg, const fs::path& path) {
  GDALAllRegister();
  const std::string driver_name = DriverOf(path);
  const bool kml = driver_name == "KML";
  const bool many_layers = driver_name == "GPKG";
  const bool geographic = kml || (driver_name == "GeoJSON" && epsg != 0);
  if (kml && epsg == 0) {
    throw InputError(path.string(), "", "a model without a known CRS", "--model-crs EPSG:...");
  }
  OGRSpatialReference system = SystemOf(epsg);
  OGRSpatialReference wgs84 = SystemOf(4326);
  const std::unique_ptr<OGRCoordinateTransformation> to_wgs84(
      geographic ? OGRCreateCoordinateTransformation(&system, &wgs84) : nullptr);
  if (geographic && !to_wgs84) FailWriting(path);

  const fs::path temporary = TemporaryBeside(path);
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(driver_name.c_str());
  GdalDatasetPtr dataset(driver->Create(temporary.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!dataset) FailWriting(path);
  // One transaction for the whole file: SQLite flushes the disk for each.
  if (many_layers && dataset->StartTransaction() != OGRERR_NONE) FailWriting(path);
  std::map<std::string, OGRLayer*> layers;
  const auto layer_of = [&](const Feature& feature) {
    const std::string name = many_layers ? feature.layer : "ridgeline";
    OGRLayer*& layer = layers[name];
    if (layer == nullptr) {
      OGRSpatialReference* layer_system = geographic ? &wgs84 : epsg != 0 ? &system : nullptr;
      // No "crs" member in WGS 84.
      const char* rfc7946[] = {"RFC7946=YES", nullptr};
      layer = dataset->CreateLayer(name.c_str(),
                                   layer_system,
                                   many_layers ? TypeOf(feature.shape) : wkbUnknown,
                                   geographic && !kml ? const_cast<char**>(rfc7946) : nullptr);
      if (layer == nullptr) FailWriting(path);
      AddFields(*layer);
    }
    return layer;
  };
  for (const Feature& feature : FeaturesOf(runs)) {
    if (!AddFeature(feature, to_wgs84.get(), *layer_of(feature))) FailWriting(path);
  }
  if (many_layers && dataset->CommitTransaction() != OGRERR_NONE) FailWriting(path);
  dataset.reset();
  CommitFile(temporary, path);
}

void WriteEnergyMap(const ReportEnergyMap& map, int epsg, const fs::path& path) {
  GDALAllRegister();
  const fs::path temporary = TemporaryBeside(path);
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  GdalDatasetPtr dataset(
      driver->Create(temporary.c_str(), map.columns, map.rows, 1, GDT_Float32, nullptr));
  if (!dataset) FailWriting(path);
  const double north = map.first.y() + (map.rows - 0.5) * map.spacing_m;
  std::array<double, 6> transform = {
      map.first.x() - 0.5 * map.spacing_m, map.spacing_m, 0.0, north, 0.0, -map.spacing_m};
  dataset->SetGeoTransform(transform.data());
  if (epsg != 0) {
    const OGRSpatialReference system = SystemOf(epsg);
    dataset->SetSpatialRef(&system);
  }
  GDALRasterBand* band = dataset->GetRasterBand(1);
  band->SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
  band->SetDescription("energy");
  std::vector<float> row;
  for (int r = 0; r < map.rows; ++r) {
    const auto first = map.energies.begin() + static_cast<long>(map.rows - 1 - r) * map.columns;
    row.assign(first, first + map.columns);
    if (band->RasterIO(
            GF_Write, 0, r, map.columns, 1, row.data(), map.columns, 1, GDT_Float32, 0, 0) !=
        CE_None) {
      FailWriting(path);
    }
  }
  dataset.reset();
  CommitFile(temporary, path);
}

}  // namespace ridgeline
