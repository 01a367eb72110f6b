// SPDX-License-Identifier: Apache-2.0
#include "synth/town_dataset.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "base/atomic_file.h"
#include "base/error.h"
#include "city/read_city.h"
#include "city/terrain.h"
#include "input/dataset.h"
#include "projection/scene.h"
#include "synth/town_model.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

TownDatasetOptions SmallOptions() {
  TownDatasetOptions options;
  options.town.blocks_east = options.town.blocks_north = 2;
  options.street = 1;
  options.tilted = 0;
  options.portrait = 1;
  options.drone = 1;
  options.width = 160;
  options.height = 120;
  return options;
}

fs::path Write(const std::string& name, const TownDatasetOptions& options, int threads) {
  const fs::path folder =
      fs::path(::testing::TempDir()) / ("town_dataset_" + name + "_" + std::to_string(::getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  WriteTownDataset(options, folder, threads, [](std::size_t, std::size_t) {});
  return folder;
}

TEST(TownDataset, IsTheSameOnAnyNumberOfThreads) {
  const fs::path one = Write("one", SmallOptions(), 1);
  const fs::path eight = Write("eight", SmallOptions(), 8);
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(one)) {
    if (!entry.is_regular_file()) continue;
    ++files;
    const fs::path other = eight / fs::relative(entry.path(), one);
    EXPECT_EQ(ReadFile(entry.path()), ReadFile(other)) << entry.path();
  }
  EXPECT_EQ(files, 9);  // model, DTM, dataset.json, three pictures, a tower (OBJ, MTL, JSON)
}

TEST(TownDataset, CityGmlReadsBackAsTheTown) {
  TownDatasetOptions options = SmallOptions();
  options.street = options.portrait = options.drone = 0;
  options.survey_sigma_m = 0.0;
  const fs::path folder = Write("gml", options, 1);
  const CityModel read = ReadCity({folder / "city.gml"}, CityOptions{});
  const Town town = MakeTown(options.town);
  EXPECT_EQ(read.crs.horizontal_epsg, 25832);
  EXPECT_EQ(read.crs.vertical_epsg, 7837);  // DHHN2016
  EXPECT_TRUE(read.warnings.empty()) << read.warnings.front();
  std::size_t named = 0;
  for (const TownBuilding& building : town.buildings) {
    for (const Building& other : read.buildings) named += other.id == building.id ? 1 : 0;
  }
  EXPECT_EQ(named, town.buildings.size());
  EXPECT_EQ(read.triangles.size(), TownModel(town).triangles.size());
}

TEST(TownDataset, DtmReadsBackAsTheTerrain) {
  TownDatasetOptions options = SmallOptions();
  options.street = options.portrait = options.drone = 0;
  const fs::path folder = Write("dtm", options, 1);
  CityModel frame;
  frame.crs = {25832, 0};
  const Town town = MakeTown(options.town);
  frame.origin_in_world = town.origin_in_world;
  std::vector<std::string> warnings;
  const HeightGrid dtm =
      ReadDtm(folder / "dtm.tif", frame, town.Lower(), town.Upper(), 10.0, warnings);
  EXPECT_TRUE(warnings.empty());
  for (const Eigen::Vector2d& xy : {Eigen::Vector2d(40.0, 40.0), Eigen::Vector2d(91.3, 17.7)}) {
    const auto height = dtm.HeightAt(xy);
    ASSERT_TRUE(height.has_value());
    // Bilinear over 1 m of waves of 150 m and more and 4 m height: below a millimetre.
    EXPECT_NEAR(*height, town.TerrainHeight(xy), 2e-3);
  }
}

TEST(TownDataset, PriorsAreNearTheTruthAndOutsideBuildings) {
  const TownDatasetOptions options = SmallOptions();
  const Dataset dataset = ReadDataset(Write("prior", options, 2) / "dataset.json");
  const Town town = MakeTown(options.town);
  ASSERT_EQ(dataset.queries.size(), 3u);
  for (const Query& query : dataset.queries) {
    const Eigen::Vector2d offset =
        query.prior->position_in_world - query.truth->center_in_world.head<2>();
    EXPECT_LE(offset.cwiseAbs().maxCoeff(), options.prior_m);
    EXPECT_FALSE(town.InBuilding(query.prior->position_in_world - town.origin_in_world.head<2>()));
    const double heading = ViewAnglesOf(query.truth->cam_from_world).heading_deg;
    EXPECT_LE(std::abs(HeadingDifferenceDeg(*query.prior->heading_deg, heading)),
              options.prior_heading_deg + 1e-3);
  }
}

TEST(TownDataset, PortraitsAreUpright) {
  const Dataset dataset = ReadDataset(Write("portrait", SmallOptions(), 2) / "dataset.json");
  for (const Query& query : dataset.queries) {
    const cv::Mat picture = cv::imread(query.image.string());
    EXPECT_EQ(picture.cols, query.camera->width);
    EXPECT_EQ(picture.rows, query.camera->height);
    EXPECT_EQ(picture.rows > picture.cols, query.set == "portrait");
  }
}

// The picture and the model agree: where the model (without survey errors and overhang) has sky,
// the picture is as bright as its sky, and at the skyline below it something else begins.
TEST(TownDataset, PictureShowsTheModelAtItsPose) {
  TownDatasetOptions options = SmallOptions();
  options.portrait = options.drone = 0;
  options.width = 320;
  options.height = 240;
  options.overhang_m = 0.0;
  options.survey_sigma_m = 0.0;
  const Dataset dataset = ReadDataset(Write("pose", options, 2) / "dataset.json");
  const Query& query = dataset.queries.front();
  const Town town = MakeTown(options.town);
  const CityModel model = TownModel(town);
  const HeightGrid terrain = TownTerrain(town, 60.0);
  const Scene scene(model, &terrain, ProjectionOptions{});
  Pose pose = *query.truth;
  pose.center_in_world -= model.origin_in_world;
  const ViewBuffers view = scene.Render(query.camera->Pinhole(), pose);
  const cv::Mat picture = cv::imread(query.image.string());
  // Blue minus red separates sky and plaster in this picture; the share of pixels on the right side
  // of the threshold must be far above chance on both sides of the model's outline.
  double sky = 0.0, sky_bright = 0.0, wall = 0.0, wall_bright = 0.0;
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const std::uint32_t surface = view.surfaces[static_cast<std::size_t>(y) * picture.cols + x];
      const cv::Vec3b bgr = picture.at<cv::Vec3b>(y, x);
      const double blue = bgr[0];
      if (surface == kNoSurface) {
        ++sky;
        sky_bright += blue;
      } else if (surface != kTerrainSurface) {
        ++wall;
        wall_bright += blue;
      }
    }
  }
  ASSERT_GT(sky, 1000.0);
  ASSERT_GT(wall, 1000.0);
  EXPECT_GT(sky_bright / sky, wall_bright / wall + 25.0);
}

TEST(TownDataset, LowDronesAndDronesLookingDown) {
  TownDatasetOptions options = SmallOptions();
  options.street = options.portrait = options.drone = 0;
  options.low = options.nadir = 3;
  options.grey = true;
  const Dataset dataset = ReadDataset(Write("low", options, 2) / "dataset.json");
  const Town town = MakeTown(options.town);
  ASSERT_EQ(dataset.queries.size(), 6u);
  for (const Query& query : dataset.queries) {
    const Eigen::Vector3d local = query.truth->center_in_world - town.origin_in_world;
    const double above_m = local.z() - town.TerrainHeight(local.head<2>());
    const double pitch_deg = ViewAnglesOf(query.truth->cam_from_world).pitch_deg;
    if (query.set == "low") {
      EXPECT_GE(above_m, 10.0 - 1e-3);
      EXPECT_LE(above_m, 40.0 + 1e-3);
      EXPECT_FALSE(town.InBuilding(local.head<2>()));
    } else {
      EXPECT_EQ(query.set, "nadir");
      EXPECT_LE(pitch_deg, -80.0 + 1e-6);
    }
    EXPECT_EQ(cv::imread(query.image.string(), cv::IMREAD_UNCHANGED).channels(), 1);
  }
}

TEST(TownDataset, OneCameraTakesAllPicturesIfWanted) {
  TownDatasetOptions options = SmallOptions();
  options.street = 3;
  options.portrait = options.drone = 0;
  const Dataset many = ReadDataset(Write("many cameras", options, 2) / "dataset.json");
  EXPECT_NE(many.queries[0].camera->params, many.queries[1].camera->params);
  options.one_camera = true;
  const Dataset one = ReadDataset(Write("one camera", options, 2) / "dataset.json");
  EXPECT_EQ(one.queries[0].camera->params, one.queries[1].camera->params);
  EXPECT_EQ(one.queries[0].camera->params, one.queries[2].camera->params);
}

TEST(TownDataset, AWrongFocalLengthIsInTheCameraFileAndNotInThePicture) {
  TownDatasetOptions options = SmallOptions();
  options.portrait = options.drone = 0;
  const fs::path right = Write("right focal", options, 2);
  options.trouble.focal_share = 0.05;
  const fs::path wrong = Write("wrong focal", options, 2);
  EXPECT_EQ(ReadFile(right / "images/street_000.jpg"), ReadFile(wrong / "images/street_000.jpg"));
  const Query a = ReadDataset(right / "dataset.json").queries[0];
  const Query b = ReadDataset(wrong / "dataset.json").queries[0];
  const double factor = b.camera->params[0] / a.camera->params[0];
  EXPECT_NE(factor, 1.0);
  EXPECT_NEAR(factor, 1.0, 0.05);
  EXPECT_NEAR(b.camera->params[1] / a.camera->params[1], factor, 1e-12);
  EXPECT_EQ(b.camera->params[2], a.camera->params[2]);
}

TEST(TownDataset, LargeTownsComeInTiles) {
  TownDatasetOptions options;
  options.town.blocks_east = 14;
  options.town.blocks_north = 2;
  options.street = options.tilted = options.portrait = options.drone = 0;
  const fs::path folder = Write("tiles", options, 1);
  EXPECT_TRUE(fs::exists(folder / "city" / "tile_0000_0000.gml"));
  EXPECT_TRUE(fs::exists(folder / "city" / "tile_0012_0000.gml"));
  EXPECT_FALSE(fs::exists(folder / "dataset.json"));
}

TEST(TownDatasetOptions, NameTheFieldThatIsWrong) {
  TownDatasetOptions options;
  options.width = 3;
  EXPECT_THROW(CheckOptions(options), InputError);
}

}  // namespace
}  // namespace ridgeline
