// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/imgcodecs.hpp>

#include "base/atomic_file.h"
#include "base/decimals.h"
#include "base/random.h"
#include "camera/local_frame.h"
#include "synth/renderer.h"
#include "synth/town_model.h"
#include "synth/walk.h"
#include "synth/weather.h"
#include "synth/write_city.h"
#include "synth/write_tower.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t kPhotoStage = 0x92;
constexpr double kDtmMarginM = 60.0;

CameraIntrinsics CameraOf(const WalkOptions& options) {
  const double half_fov = 0.5 * options.horizontal_fov_deg * std::numbers::pi / 180.0;
  const double focal = 0.5 * options.width / std::tan(half_fov);
  CameraIntrinsics camera;
  camera.model = "PINHOLE";
  camera.width = options.width;
  camera.height = options.height;
  camera.params = {focal, focal, 0.5 * options.width, 0.5 * options.height};
  return camera;
}

Json QueryJson(const std::string& id,
               const std::string& image,
               const CameraIntrinsics& camera,
               const Pose& world) {
  const Eigen::Vector3d& p = world.center_in_world;
  const Eigen::Quaterniond& q = world.cam_from_world;
  return {{"id", id},
          {"set", "walk"},
          {"image", image},
          {"camera",
           {{"model", camera.model},
            {"width", camera.width},
            {"height", camera.height},
            {"params", camera.params}}},
          {"truth",
           {{"position", {RoundedTo(p.x(), 6), RoundedTo(p.y(), 6), RoundedTo(p.z(), 6)}},
            {"cam_from_world_wxyz", {q.w(), q.x(), q.y(), q.z()}}}}};
}

}  // namespace

TownDatasetSummary WriteWalkDataset(const WalkOptions& options,
                                    const fs::path& folder,
                                    int threads,
                                    const FileProgress& progress) {
  CheckOptions(options);
  const std::size_t total = 2 + static_cast<std::size_t>(options.frames);
  TownDatasetSummary summary;
  const Town town = MakeTown(options.town);
  WriteCityGml(SurveyedTown(town, options.survey_sigma_m), folder / "city.gml");
  summary.buildings = town.buildings.size();
  summary.model_files = 1;
  progress(1, total);
  WriteDtm(town, TownTerrain(town, kDtmMarginM), folder / "dtm.tif");
  progress(2, total);

  const TownRenderer renderer(town, options.overhang_m);
  const CameraIntrinsics camera = CameraOf(options);
  const std::vector<Pose> poses = WalkPoses(town, options);
  const auto seed = static_cast<std::uint64_t>(options.town.seed);
  Random sky(seed, kPhotoStage);
  const Weather weather = DrawWeather(sky);
  fs::create_directory(folder / "images");
  Json queries = Json::array();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    char id[32];
    std::snprintf(id, sizeof id, "frame_%04zu", i);
    const std::string image = "images/" + std::string(id) + ".jpg";
    Random noise(seed, kPhotoStage, i + 1);
    const cv::Mat photo =
        DevelopPhoto(renderer.Render(camera, poses[i], weather, threads), noise.Next());
    std::vector<uchar> jpeg;
    cv::imencode(".jpg", photo, jpeg, {cv::IMWRITE_JPEG_QUALITY, options.jpeg_quality});
    WriteFileAtomically(folder / image, {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
    queries.push_back(
        QueryJson(id, image, camera, LocalFrame{town.origin_in_world}.ToWorld(poses[i])));
    ++summary.pictures;
    progress(2 + summary.pictures, total);
  }
  WriteDemoTower(folder);
  WriteFileAtomically(folder / "sensors.csv", WalkSensorsCsv(town, poses, options));
  WriteFileAtomically(folder / "odometry.csv", WalkOdometryCsv(poses, options));
  const Json dataset = {{"name", "demo-walk"},
                        {"crs", "EPSG:" + std::to_string(town.epsg)},
                        {"model", {"city.gml"}},
                        {"dtm", "dtm.tif"},
                        {"queries", queries}};
  WriteFileAtomically(folder / "dataset.json", dataset.dump(2) + "\n");
  return summary;
}

}  // namespace ridgeline
