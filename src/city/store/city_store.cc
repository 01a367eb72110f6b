// SPDX-License-Identifier: Apache-2.0
#include "city/store/city_store.h"

#include <cpl_error.h>
#include <fcntl.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <unordered_set>
#include <utility>

#include "base/error.h"
#include "base/gdal_handles.h"
#include "base/parallel.h"
#include "base/random.h"
#include "city/crs.h"
#include "city/format/formats.h"
#include "city/format/model_files.h"
#include "city/mesh/select_lod.h"
#include "city/projected_sources.h"
#include "city/store/building_blob.h"

namespace ridgeline {
namespace fs = std::filesystem;
namespace {

constexpr const char* kFormatKey = "RIDGELINE_STORE";
constexpr const char* kFormat = "1";
constexpr const char* kCompleteKey = "RIDGELINE_COMPLETE";
constexpr const char* kSettingsKey = "RIDGELINE_SETTINGS";
constexpr const char* kHorizontalKey = "RIDGELINE_HORIZONTAL_EPSG";
constexpr const char* kVerticalKey = "RIDGELINE_VERTICAL_EPSG";

[[noreturn]] void FailWrite(const std::string& file) {
  const std::string message = CPLGetLastErrorMsg();
  throw InputError(file,
                   "",
                   message.empty() ? "a failed write" : message,
                   "a folder with write permission and free space");
}

void Check(bool ok, const std::string& file) {
  if (!ok) FailWrite(file);
}

// One writer at a time; released when the process ends, however it ends.
class WriterLock {
 public:
  explicit WriterLock(const fs::path& store) : path_(store.string() + ".lock") {
    descriptor_ = ::open(path_.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
    if (descriptor_ < 0) {
      throw InputError(store.string(), "", "a folder that cannot be written", "write permission");
    }
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      ::close(descriptor_);
      throw InputError(
          store.string(), "", "a store that another process is writing", "one writer at a time");
    }
  }
  ~WriterLock() {
    ::unlink(path_.c_str());
    ::close(descriptor_);
  }
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

 private:
  std::string path_;
  int descriptor_ = -1;
};

struct StoredBuilding {
  std::string id;
  std::string parent;
  Eigen::AlignedBox3d box;
  std::vector<std::vector<Eigen::Vector2d>> ground;  // outer rings of ground surfaces
  std::vector<std::uint8_t> surfaces;
};

struct Tile {
  std::string path;
  GIntBig bytes = 0;
  GIntBig modified = 0;
  Crs crs;
  std::vector<StoredBuilding> buildings;
  Tally tally;
};

Tile TileOf(const fs::path& path) {
  Tile tile;
  tile.path = path.string();
  std::error_code error;
  tile.bytes = static_cast<GIntBig>(fs::file_size(path, error));
  const auto time = fs::last_write_time(path, error);
  tile.modified = error ? 0 : static_cast<GIntBig>(time.time_since_epoch().count());
  return tile;
}

StoredBuilding Store(const SourceModel& source, const SourceBuilding& building, int lod) {
  StoredBuilding stored;
  stored.id = building.id;
  if (building.parent >= 0) {
    stored.parent = source.buildings[static_cast<std::size_t>(building.parent)].id;
  }
  for (const SourceMember& member : building.members) {
    if (member.lod != lod) continue;
    const SourceRing& ring = source.rings[source.polygons[member.polygon].first_ring];
    std::vector<Eigen::Vector2d> outline;
    for (std::uint32_t p = 0; p < ring.point_count; ++p) {
      const Eigen::Vector3d& point = source.points[ring.first_point + p];
      stored.box.extend(point);
      outline.push_back(point.head<2>());
    }
    if (member.surface_class == SurfaceClass::kGround) stored.ground.push_back(std::move(outline));
  }
  stored.surfaces = EncodeBuilding(source, building, lod);
  return stored;
}

void ReadTile(Tile& tile, const CityOptions& options) {
  std::vector<SourceModel> sources(1);
  sources.front() =
      IsCityStore(tile.path) ? ReadCityStore(tile.path, {}) : ReadModelFile(tile.path);
  ProjectedSources projected = ProjectSources(std::move(sources), options);
  SourceModel& source = projected.sources.front();
  tile.crs = projected.crs;
  const std::vector<std::int8_t> lods = SelectLod(source, options.lod);
  for (std::size_t b = 0; b < source.buildings.size(); ++b) {
    if (lods[b] < 0) continue;
    tile.buildings.push_back(Store(source, source.buildings[b], lods[b]));
  }
  tile.tally = std::move(source.tally);
}

// A building's id and place: what tiles that overlap both hold.
std::uint64_t PlaceKey(const std::string& id, const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d middle = box.center();
  return HashText(id + " " + std::to_string(std::llround(middle.x())) + " " +
                  std::to_string(std::llround(middle.y())));
}

class StoreWriter {
 public:
  StoreWriter(const fs::path& part, const std::string& settings)
      : file_(part.string()), settings_(settings) {
    if (fs::exists(part)) Resume(part);
    if (dataset_ == nullptr) Create(part);
  }

  // A store without a single tile is of no use to the next run.
  ~StoreWriter() {
    if (dataset_ == nullptr || tiles_->GetFeatureCount() > 0) return;
    dataset_.reset();
    std::error_code error;
    fs::remove(file_, error);
  }
  StoreWriter(const StoreWriter&) = delete;
  StoreWriter& operator=(const StoreWriter&) = delete;

  bool HasTile(const Tile& tile) const {
    const auto it = done_.find(tile.path);
    return it != done_.end() && it->second == std::pair(tile.bytes, tile.modified);
  }
  std::size_t tiles_before() const { return done_.size(); }
  std::size_t buildings() const {
    if (buildings_ == nullptr) return 0;
    return static_cast<std::size_t>(std::max<GIntBig>(buildings_->GetFeatureCount(), 0));
  }
  const Crs& crs() const { return crs_; }

  // The tile's buildings and its mark, in one transaction.
  void Write(Tile& tile) {
    SetCrs(tile);
    Check(dataset_->StartTransaction() == OGRERR_NONE, file_);
    for (const StoredBuilding& building : tile.buildings) {
      const std::uint64_t place = PlaceKey(building.id, building.box);
      if (!building.id.empty() && !places_.insert(place).second) {
        tile.tally.Add("buildings that an earlier file holds too, taken once", building.id);
        continue;
      }
      WriteBuilding(building, tile.path, place);
    }
    WriteTileMark(tile);
    Check(dataset_->CommitTransaction() == OGRERR_NONE, file_);
  }

  void Finish() {
    dataset_->SetMetadataItem(kCompleteKey, "1");
    dataset_->FlushCache(false);
    CPLErrorReset();
    dataset_.reset();
    Check(CPLGetLastErrorType() < CE_Failure, file_);
  }

 private:
  void Create(const fs::path& part) {
    std::error_code error;
    fs::remove(part, error);
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GPKG");
    dataset_.reset(
        driver == nullptr ? nullptr : driver->Create(file_.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    Check(dataset_ != nullptr, file_);
    dataset_->SetMetadataItem(kFormatKey, kFormat);
    dataset_->SetMetadataItem(kSettingsKey, settings_.c_str());
    tiles_ = dataset_->CreateLayer("tiles", nullptr, wkbNone, nullptr);
    Check(tiles_ != nullptr, file_);
    AddField(*tiles_, "path", OFTString);
    AddField(*tiles_, "bytes", OFTInteger64);
    AddField(*tiles_, "modified", OFTInteger64);
    AddField(*tiles_, "buildings", OFTInteger64);
  }

  // The layer of buildings needs the system, which the first tile brings.
  void CreateBuildings() {
    OGRSpatialReference srs;
    const bool known =
        crs_.horizontal_epsg != 0 && srs.importFromEPSG(crs_.horizontal_epsg) == OGRERR_NONE;
    buildings_ =
        dataset_->CreateLayer("buildings", known ? &srs : nullptr, wkbMultiPolygon, nullptr);
    Check(buildings_ != nullptr, file_);
    AddField(*buildings_, "gml_id", OFTString);
    AddField(*buildings_, "parent", OFTString);
    AddField(*buildings_, "lowest_m", OFTReal);
    AddField(*buildings_, "height_m", OFTReal);
    AddField(*buildings_, "tile", OFTString);
    AddField(*buildings_, "place_key", OFTInteger64);
    AddField(*buildings_, "surfaces", OFTBinary);
    dataset_->SetMetadataItem(kHorizontalKey, std::to_string(crs_.horizontal_epsg).c_str());
    dataset_->SetMetadataItem(kVerticalKey, std::to_string(crs_.vertical_epsg).c_str());
  }

  void AddField(OGRLayer& layer, const char* name, OGRFieldType type) {
    OGRFieldDefn field(name, type);
    Check(layer.CreateField(&field) == OGRERR_NONE, file_);
  }

  int MetadataCode(const char* key) const {
    const char* const text = dataset_->GetMetadataItem(key);
    return text != nullptr ? std::atoi(text) : 0;
  }

  // Goes on with an unfinished store of the same settings; anything else is begun anew.
  void Resume(const fs::path& part) {
    dataset_.reset(GDALDataset::Open(part.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE));
    if (dataset_ == nullptr) return;
    const char* const settings = dataset_->GetMetadataItem(kSettingsKey);
    tiles_ = dataset_->GetLayerByName("tiles");
    buildings_ = dataset_->GetLayerByName("buildings");
    if (settings == nullptr || settings_ != settings || tiles_ == nullptr ||
        buildings_ == nullptr) {
      dataset_.reset();
      tiles_ = buildings_ = nullptr;
      return;
    }
    crs_ = {MetadataCode(kHorizontalKey), MetadataCode(kVerticalKey)};
    for (const OGRFeatureUniquePtr& feature : tiles_) {
      done_[feature->GetFieldAsString("path")] = {feature->GetFieldAsInteger64("bytes"),
                                                  feature->GetFieldAsInteger64("modified")};
    }
    const char* ignored[] = {"surfaces", "OGR_GEOMETRY", nullptr};
    buildings_->SetIgnoredFields(ignored);
    for (const OGRFeatureUniquePtr& feature : buildings_) {
      places_.insert(static_cast<std::uint64_t>(feature->GetFieldAsInteger64("place_key")));
    }
    buildings_->SetIgnoredFields(nullptr);
  }

  void SetCrs(const Tile& tile) {
    if (tile.buildings.empty()) return;
    if (buildings_ == nullptr) {
      crs_ = tile.crs;
      CreateBuildings();
    } else if (crs_.horizontal_epsg != tile.crs.horizontal_epsg) {
      throw InputError(tile.path,
                       "CRS",
                       CrsName(tile.crs),
                       CrsName(crs_) +
                           " (of the tiles before it; --project-to moves tiles of "
                           "several systems into one)");
    }
  }

  void WriteBuilding(const StoredBuilding& building, const std::string& tile, std::uint64_t place) {
    const OGRFeatureUniquePtr feature(OGRFeature::CreateFeature(buildings_->GetLayerDefn()));
    feature->SetField("gml_id", building.id.c_str());
    if (!building.parent.empty()) feature->SetField("parent", building.parent.c_str());
    feature->SetField("lowest_m", building.box.min().z());
    feature->SetField("height_m", building.box.sizes().z());
    feature->SetField("tile", tile.c_str());
    feature->SetField("place_key", static_cast<GIntBig>(place));
    feature->SetField(feature->GetFieldIndex("surfaces"),
                      static_cast<int>(building.surfaces.size()),
                      building.surfaces.data());
    feature->SetGeometryDirectly(OutlineOf(building));
    Check(buildings_->CreateFeature(feature.get()) == OGRERR_NONE, file_);
  }

  static OGRGeometry* OutlineOf(const StoredBuilding& building) {
    auto outline = std::make_unique<OGRMultiPolygon>();
    std::vector<std::vector<Eigen::Vector2d>> rings = building.ground;
    if (rings.empty()) {
      const Eigen::Vector2d a = building.box.min().head<2>();
      const Eigen::Vector2d b = building.box.max().head<2>();
      rings.push_back({a, {b.x(), a.y()}, b, {a.x(), b.y()}});
    }
    for (const std::vector<Eigen::Vector2d>& ring : rings) {
      auto line = std::make_unique<OGRLinearRing>();
      for (const Eigen::Vector2d& p : ring) line->addPoint(p.x(), p.y());
      line->closeRings();
      auto polygon = std::make_unique<OGRPolygon>();
      polygon->addRingDirectly(line.release());
      outline->addGeometryDirectly(polygon.release());
    }
    return outline.release();
  }

  void WriteTileMark(const Tile& tile) {
    const OGRFeatureUniquePtr feature(OGRFeature::CreateFeature(tiles_->GetLayerDefn()));
    feature->SetField("path", tile.path.c_str());
    feature->SetField("bytes", tile.bytes);
    feature->SetField("modified", tile.modified);
    feature->SetField("buildings", static_cast<GIntBig>(tile.buildings.size()));
    Check(tiles_->CreateFeature(feature.get()) == OGRERR_NONE, file_);
  }

  std::string file_;
  std::string settings_;
  GdalDatasetPtr dataset_;
  OGRLayer* tiles_ = nullptr;
  OGRLayer* buildings_ = nullptr;
  Crs crs_;
  std::map<std::string, std::pair<GIntBig, GIntBig>> done_;
  std::unordered_set<std::uint64_t> places_;
};

// What else a store depends on.
std::string SettingsOf(const CityOptions& options) {
  return "lod=" + std::to_string(options.lod) + " model_crs=" + options.model_crs +
         " project_to=" + options.project_to +
         " height_offset_m=" + std::to_string(options.height_offset_m);
}

}  // namespace

CityStoreResult WriteCityStore(const std::vector<fs::path>& tiles,
                               const fs::path& store,
                               const CityOptions& options,
                               const CityStoreProgress& progress) {
  options.Validate();
  const QuietGdal quiet;
  GDALAllRegister();
  if (store.extension() != ".gpkg") {
    throw InputError(store.string(), "", "a name without .gpkg", "a name such as city.gpkg");
  }
  ModelFiles listed = ListModelFiles(tiles);
  const std::vector<fs::path>& files = listed.files;
  const WriterLock lock(store);
  fs::path part = store;
  part.replace_extension(".part.gpkg");
  StoreWriter writer(part, SettingsOf(options));

  CityStoreResult result;
  Tally tally;
  CityOptions tile_options = options;
  tile_options.threads = 1;
  std::vector<Tile> waiting;
  for (const fs::path& file : files) {
    Tile tile = TileOf(file);
    if (writer.HasTile(tile)) {
      ++result.tiles_before;
    } else {
      waiting.push_back(std::move(tile));
    }
  }
  // A few tiles at a time bound the memory. The first one goes alone: others follow its system.
  const auto batch_size = static_cast<std::size_t>(ResolveThreads(options.threads));
  for (std::size_t begin = 0; begin < waiting.size();) {
    const bool system_known = writer.buildings() > 0;
    const std::size_t end = std::min(waiting.size(), begin + (system_known ? batch_size : 1));
    if (system_known && writer.crs().horizontal_epsg != 0 && options.project_to.empty()) {
      tile_options.project_to = CrsName({writer.crs().horizontal_epsg, 0});
    }
    ParallelFor(end - begin, options.threads, [&](std::size_t i) {
      ReadTile(waiting[begin + i], tile_options);
    });
    for (; begin < end; ++begin) {
      Tile& tile = waiting[begin];
      writer.Write(tile);
      tally.Merge(tile.tally);
      tile = Tile{};
      ++result.tiles;
      if (progress) progress(result.tiles_before + result.tiles, files.size());
    }
  }
  result.buildings = writer.buildings();
  result.warnings = std::move(listed.warnings);
  for (std::string& line : tally.Lines()) result.warnings.push_back(std::move(line));
  if (result.buildings == 0) {
    throw InputError(store.string(), "", "tiles without any building", "buildings of LoD1 to LoD4");
  }
  writer.Finish();
  std::error_code error;
  fs::rename(part, store, error);
  if (error) {
    throw InputError(store.string(), "", error.message(), "a folder with write permission");
  }
  return result;
}

}  // namespace ridgeline
