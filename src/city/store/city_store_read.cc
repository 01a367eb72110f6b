// SPDX-License-Identifier: Apache-2.0
#include <cpl_error.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>

#include "base/error.h"
#include "base/gdal_handles.h"
#include "base/regular_file.h"
#include "city/crs.h"
#include "city/store/building_blob.h"
#include "city/store/city_store.h"

namespace ridgeline {
namespace {

using FeaturesById = std::map<GIntBig, OGRFeatureUniquePtr>;

int CodeOf(GDALDataset& dataset, const char* key) {
  const char* const text = dataset.GetMetadataItem(key);
  return text != nullptr ? std::atoi(text) : 0;
}

[[noreturn]] void FailLocked(const std::string& file) {
  throw InputError(
      file, "", "a store that another program has locked", "a store that no one is writing");
}

// GDAL ends a layer early where SQLite fails to go on; the reason is in the last error.
void CheckRead(const std::string& file) {
  if (CPLGetLastErrorType() < CE_Failure) return;
  const std::string said = CPLGetLastErrorMsg();
  if (said.find("locked") != std::string::npos) FailLocked(file);
  throw InputError(file, "", "a store that cannot be read (" + said + ")", "a whole store");
}

GdalDatasetPtr OpenStore(const std::string& file) {
  RequireRegularFile(file, "a store written by ridgeline index");
  GDALAllRegister();
  CPLErrorReset();
  CPLPushErrorHandler(CPLQuietErrorHandler);
  GdalDatasetPtr dataset(GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
  CPLPopErrorHandler();
  const std::string said = CPLGetLastErrorMsg();
  if (dataset == nullptr && said.find("locked") != std::string::npos) FailLocked(file);
  if (dataset == nullptr) {
    throw InputError(file,
                     "",
                     "a file that cannot be opened as a GeoPackage",
                     "a store written by ridgeline index");
  }
  if (dataset->GetMetadataItem("RIDGELINE_STORE") == nullptr ||
      dataset->GetLayerByName("buildings") == nullptr) {
    throw InputError(file,
                     "",
                     "a GeoPackage without ridgeline's buildings",
                     "a store written by ridgeline index");
  }
  if (dataset->GetMetadataItem("RIDGELINE_COMPLETE") == nullptr) {
    throw InputError(file, "", "an unfinished store", "a whole one: run ridgeline index again");
  }
  return dataset;
}

void Collect(OGRLayer& layer, FeaturesById& features) {
  for (OGRFeatureUniquePtr& feature : layer) {
    const GIntBig id = feature->GetFID();
    features.try_emplace(id, std::move(feature));
  }
}

// Low buildings near by and, in rings of doubling width, only those high enough to be seen from
// there: the spatial index and the height keep the far surfaces on the disk.
FeaturesById Query(OGRLayer& layer, const CityRegion& region) {
  FeaturesById features;
  const auto query = [&](double reach, double min_height) {
    layer.SetSpatialFilterRect(region.positions.min().x() - reach,
                               region.positions.min().y() - reach,
                               region.positions.max().x() + reach,
                               region.positions.max().y() + reach);
    const std::string filter = "height_m >= " + std::to_string(min_height);
    layer.SetAttributeFilter(min_height > 0.0 ? filter.c_str() : nullptr);
    Collect(layer, features);
  };
  double reach = region.min_reach_m;
  query(reach, 0.0);
  while (reach < region.max_reach_m && region.reach_per_height > 0.0) {
    const double min_height = reach / region.reach_per_height;
    reach = std::min(2.0 * reach, region.max_reach_m);
    query(reach, min_height);
  }
  return features;
}

bool IsIncluded(const OGRFeature& feature, const CityRegion& region) {
  const OGRGeometry* const geometry = feature.GetGeometryRef();
  if (geometry == nullptr) return true;
  OGREnvelope envelope;
  geometry->getEnvelope(&envelope);
  const Eigen::AlignedBox2d box(Eigen::Vector2d(envelope.MinX, envelope.MinY),
                                Eigen::Vector2d(envelope.MaxX, envelope.MaxY));
  return region.Includes(box, feature.GetFieldAsDouble("height_m"));
}

}  // namespace

bool IsCityStore(const std::filesystem::path& path) { return path.extension() == ".gpkg"; }

SourceModel ReadCityStore(const std::filesystem::path& store,
                          const std::optional<CityRegion>& region) {
  SourceModel model;
  model.file = store.string();
  model.format = "ridgeline store";
  const GdalDatasetPtr dataset = OpenStore(model.file);
  const Crs crs{CodeOf(*dataset, "RIDGELINE_HORIZONTAL_EPSG"),
                CodeOf(*dataset, "RIDGELINE_VERTICAL_EPSG")};
  if (crs.horizontal_epsg != 0) model.srs_names.push_back(CrsName(crs));
  OGRLayer& layer = *dataset->GetLayerByName("buildings");
  FeaturesById features;
  CPLErrorReset();
  CPLPushErrorHandler(CPLQuietErrorHandler);
  if (region) {
    OGREnvelope extent;
    if (layer.GetExtent(&extent) == OGRERR_NONE) {
      model.whole_extent = Eigen::AlignedBox2d(Eigen::Vector2d(extent.MinX, extent.MinY),
                                               Eigen::Vector2d(extent.MaxX, extent.MaxY));
    }
    features = Query(layer, *region);
  } else {
    Collect(layer, features);
  }
  CPLPopErrorHandler();
  CheckRead(model.file);
  // Parts of one whole know each other by the whole's id and their tile.
  std::unordered_map<std::string, int> wholes;
  for (const auto& [id, feature] : features) {
    if (region && !IsIncluded(*feature, *region)) continue;
    int parent = -1;
    const std::string parent_id = feature->GetFieldAsString("parent");
    if (!parent_id.empty()) {
      const std::string key = parent_id + "\n" + feature->GetFieldAsString("tile");
      const auto [it, is_new] = wholes.try_emplace(key, static_cast<int>(model.buildings.size()));
      if (is_new) model.buildings.push_back({parent_id, -1, {}});
      parent = it->second;
    }
    SourceBuilding building{feature->GetFieldAsString("gml_id"), parent, {}};
    int size = 0;
    const GByte* const bytes = feature->GetFieldAsBinary(feature->GetFieldIndex("surfaces"), &size);
    DecodeBuilding(
        std::span(bytes, static_cast<std::size_t>(std::max(size, 0))), model.file, model, building);
    model.buildings.push_back(std::move(building));
  }
  return model;
}

}  // namespace ridgeline
