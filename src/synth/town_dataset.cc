// SPDX-License-Identifier: Apache-2.0
#include "synth/town_dataset.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/decimals.h"
#include "base/random.h"
#include "synth/renderer.h"
#include "synth/town_model.h"
#include "synth/viewpoint.h"
#include "synth/write_city.h"
#include "synth/write_tower.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t kViewStage = 0x80;
constexpr std::uint64_t kPriorStage = 0x81;
constexpr int kTileBlocks = 12;
// Blocks in each direction that pictures are rendered from; they see no farther.
constexpr int kPictureBlocks = 6;
constexpr double kDtmMarginM = 60.0;
constexpr double kMaxDtmCells = 16e6;

Json PositionJson(const Vector3d& world) {
  return {RoundedTo(world.x(), 4), RoundedTo(world.y(), 4), RoundedTo(world.z(), 4)};
}

class DatasetWriter {
 public:
  DatasetWriter(const TownDatasetOptions& options,
                fs::path folder,
                int threads,
                const FileProgress& progress)
      : options_(options), folder_(std::move(folder)), threads_(threads), progress_(progress) {
    const TownOptions& town = options.town;
    tiled_ = town.blocks_east > kPictureBlocks || town.blocks_north > kPictureBlocks;
    pictures_ = options.street + options.tilted + options.portrait + options.drone + options.low +
                options.nadir;
    const auto tiles = [](int blocks) { return (blocks + kTileBlocks - 1) / kTileBlocks; };
    models_ = tiled_ ? tiles(town.blocks_east) * tiles(town.blocks_north) : 1;
  }

  TownDatasetSummary Write() {
    WriteModel();
    WriteTerrain();
    if (pictures_ > 0) {
      WritePictures();
      WriteDemoTower(folder_);
    }
    return summary_;
  }

 private:
  void FileDone() { progress_(++done_, static_cast<std::size_t>(models_ + 1 + pictures_)); }

  void WriteModel() {
    const TownOptions& town = options_.town;
    if (!tiled_) {
      WriteTile(MakeTown(town), folder_ / "city.gml");
      return;
    }
    fs::create_directory(folder_ / "city");
    for (int row = 0; row < town.blocks_north; row += kTileBlocks) {
      for (int column = 0; column < town.blocks_east; column += kTileBlocks) {
        char name[40];
        std::snprintf(name, sizeof name, "tile_%04d_%04d.gml", column, row);
        WriteTile(MakeTownPart(town,
                               column,
                               row,
                               std::min(column + kTileBlocks, town.blocks_east),
                               std::min(row + kTileBlocks, town.blocks_north)),
                  folder_ / "city" / name);
      }
    }
  }

  void WriteTile(const Town& town, const fs::path& file) {
    const Town model = ModelledTown(SurveyedTown(town, options_.survey_sigma_m), options_.trouble);
    WriteCityGml(model, file);
    summary_.buildings += model.buildings.size();
    ++summary_.model_files;
    FileDone();
  }

  void WriteTerrain() {
    // The corner blocks bound the town.
    const TownOptions& o = options_.town;
    Town frame = MakeTownPart(o, 0, 0, 1, 1);
    const Town last =
        MakeTownPart(o, o.blocks_east - 1, o.blocks_north - 1, o.blocks_east, o.blocks_north);
    frame.blocks.push_back(last.blocks.front());
    const double cells = (o.block_m * o.blocks_east) * (o.block_m * o.blocks_north);
    const double spacing_m = std::max(1.0, std::ceil(std::sqrt(cells / kMaxDtmCells)));
    WriteDtm(
        frame, TownTerrain(frame, kDtmMarginM + 0.2 * o.block_m, spacing_m), folder_ / "dtm.tif");
    FileDone();
  }

  void WritePictures() {
    const TownOptions& o = options_.town;
    const int east = std::min(o.blocks_east, kPictureBlocks);
    const int north = std::min(o.blocks_north, kPictureBlocks);
    const int column = (o.blocks_east - east) / 2;
    const int row = (o.blocks_north - north) / 2;
    const Town town =
        StandingTown(MakeTownPart(o, column, row, column + east, row + north), options_.trouble);
    const TownRenderer renderer(town, options_.overhang_m);
    fs::create_directory(folder_ / "images");
    Json queries = Json::array();
    const std::vector<std::pair<ViewKind, int>> sets = {{ViewKind::kStreet, options_.street},
                                                        {ViewKind::kTilted, options_.tilted},
                                                        {ViewKind::kPortrait, options_.portrait},
                                                        {ViewKind::kDrone, options_.drone},
                                                        {ViewKind::kLow, options_.low},
                                                        {ViewKind::kNadir, options_.nadir}};
    for (const auto& [kind, count] : sets) {
      for (int i = 0; i < count; ++i) queries.push_back(WritePicture(town, renderer, kind, i));
    }
    const Json dataset = {{"name", "demo-town"},
                          {"crs", "EPSG:" + std::to_string(town.epsg)},
                          {"model", {tiled_ ? "city" : "city.gml"}},
                          {"dtm", "dtm.tif"},
                          {"queries", queries}};
    WriteFileAtomically(folder_ / "dataset.json", dataset.dump(2) + "\n");
  }

  Json WritePicture(const Town& town, const TownRenderer& renderer, ViewKind kind, int index) {
    char number[16];
    std::snprintf(number, sizeof number, "_%03d", index);
    const std::string id = ViewKindName(kind) + std::string(number);
    Random random(static_cast<std::uint64_t>(town.options.seed), kViewStage, HashText(id));
    Viewpoint view = DrawViewpoint(
        town, renderer, kind, {options_.width, options_.height, options_.one_camera}, random);
    const Weather weather = DrawWeather(random);
    cv::Mat photo = DevelopPhoto(
        renderer.Render(view.camera, view.cam_from_local, weather, threads_), random.Next());
    if (options_.grey) cv::cvtColor(photo, photo, cv::COLOR_BGR2GRAY);
    std::vector<uchar> jpeg;
    cv::imencode(".jpg", photo, jpeg, {cv::IMWRITE_JPEG_QUALITY, options_.jpeg_quality});
    const std::string image = "images/" + id + ".jpg";
    WriteFileAtomically(folder_ / image, {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
    ++summary_.pictures;
    FileDone();
    const double factor = FocalFactor(options_.trouble, town.options.seed, HashText(id));
    view.camera.params[0] *= factor;
    view.camera.params[1] *= factor;
    return QueryJson(town, kind, id, image, view);
  }

  Json QueryJson(const Town& town,
                 ViewKind kind,
                 const std::string& id,
                 const std::string& image,
                 const Viewpoint& view) const {
    const Eigen::Quaterniond& q = view.cam_from_local.cam_from_world;
    return {
        {"id", id},
        {"set", ViewKindName(kind)},
        {"image", image},
        {"camera",
         {{"model", view.camera.model},
          {"width", view.camera.width},
          {"height", view.camera.height},
          {"params", view.camera.params}}},
        {"prior", PriorJson(town, kind, id, view.cam_from_local)},
        {"truth",
         {{"position", PositionJson(town.origin_in_world + view.cam_from_local.center_in_world)},
          {"cam_from_world_wxyz", {q.w(), q.x(), q.y(), q.z()}}}}};
  }

  Json PriorJson(const Town& town, ViewKind kind, const std::string& id, const Pose& truth) const {
    Random random(static_cast<std::uint64_t>(town.options.seed), kPriorStage, HashText(id));
    const double reach = options_.prior_m;
    Vector2d xy;
    do {
      const double east = random.Uniform(-reach, reach);
      const double north = random.Uniform(-reach, reach);
      xy = truth.center_in_world.head<2>() + Vector2d(east, north);
    } while (town.InBuilding(xy, 0.2));
    const ViewAngles angles = ViewAnglesOf(truth.cam_from_world);
    const double heading = angles.heading_deg +
                           random.Uniform(-options_.prior_heading_deg, options_.prior_heading_deg);
    const double tilt = options_.prior_tilt_deg;
    const double pitch = angles.pitch_deg + random.Uniform(-tilt, tilt);
    const double roll = angles.roll_deg + random.Uniform(-tilt, tilt);
    const double height = IsFromTheAir(kind) ? truth.center_in_world.z() + random.Uniform(-1.0, 1.0)
                                             : town.TerrainHeight(xy) + 1.7;
    return {{"position", PositionJson(town.origin_in_world + Vector3d(xy.x(), xy.y(), height))},
            {"heading_deg", RoundedTo(WrapHeadingDeg(heading), 3)},
            {"pitch_deg", RoundedTo(pitch, 3)},
            {"roll_deg", RoundedTo(roll, 3)}};
  }

  const TownDatasetOptions& options_;
  const fs::path folder_;
  const int threads_;
  const FileProgress& progress_;
  bool tiled_ = false;
  int models_ = 1;
  int pictures_ = 0;
  std::size_t done_ = 0;
  TownDatasetSummary summary_;
};

}  // namespace

TownDatasetSummary WriteTownDataset(const TownDatasetOptions& options,
                                    const fs::path& folder,
                                    int threads,
                                    const FileProgress& progress) {
  CheckOptions(options);
  return DatasetWriter(options, folder, threads, progress).Write();
}

}  // namespace ridgeline
