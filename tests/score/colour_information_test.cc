// SPDX-License-Identifier: Apache-2.0
#include "score/colour_information.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>


namespace ridgeline {
namespace {

using Groups = std::vector<std::uint16_t>;

constexpr std::uint16_t kWalls = kFirstBuildingGroup;
constexpr std::uint16_t kOtherWalls = kFirstBuildingGroup + 1;

// Regions of a grid: sky above `horizon` rows, a building in the columns [first, last), ground
// below.
Groups Regions(const ColourInformation& information, int horizon, int first, int last) {
  Groups regions;
  for (int y = 0; y < information.camera().height; ++y) {
    for (int x = 0; x < information.camera().width; ++x) {
      const bool is_building = x >= first && x < last && y >= 8 && y < horizon;
      regions.push_back(is_building   ? kWalls
                        : y < horizon ? kSkyGroup
                                      : kGroundGroup);
    }
  }
  return regions;
}

class ColoursOfAPicture : public ::testing::Test {
 protected:
  // 64 x 48 cells: sky above row 32, a building in columns 20 to 44, ground below.
  static cv::Mat Picture(const cv::Scalar& sky, const cv::Scalar& wall, const cv::Scalar& ground) {
    cv::Mat picture(480, 640, CV_8UC3, sky);
    picture.rowRange(320, 480).setTo(ground);
    picture(cv::Rect(200, 80, 240, 240)).setTo(wall);
    return picture;
  }

  double EnergyOf(const cv::Mat& picture, int horizon, int first, int last) const {
    const ColourInformation information(picture, camera_, kGrid);
    return 1.0 - CuesOf(information, Regions(information, horizon, first, last)).regions;
  }

  static ColourInformation::Cues CuesOf(const ColourInformation& information,
                                        const Groups& groups) {
    ColourInformation::Workspace workspace;
    return information.Of(groups, 4, workspace);
  }

  static constexpr ColourOptions kGrid{64};
  PinholeCamera camera_{640, 480, 600.0, 600.0, 320.0, 240.0};
  cv::Mat picture_ = Picture({240, 200, 160}, {60, 110, 150}, {90, 90, 90});
};

TEST_F(ColoursOfAPicture, TrueRegionsTellAllThatRegionsCan) {
  // Three colours, three regions: the information is the entropy of the regions.
  const double cells = 64.0 * 48.0;
  const double building = 24.0 * 24.0 / cells;
  const double ground = 64.0 * 16.0 / cells;
  const double sky = 1.0 - building - ground;
  const double entropy =
      -building * std::log(building) - ground * std::log(ground) - sky * std::log(sky);
  // Less the chance of Miller and Madow: (3 - 3 - 3 + 1) / 2 = -1 cell, to the other side.
  EXPECT_NEAR(EnergyOf(picture_, 32, 20, 44), 1.0 - (entropy + 1.0 / cells) / std::log(3.0), 1e-9);
}

TEST_F(ColoursOfAPicture, RisesWithTheShift) {
  double last = EnergyOf(picture_, 32, 20, 44);
  for (const int shift : {1, 2, 4, 8}) {
    const double energy = EnergyOf(picture_, 32, 20 + shift, 44 + shift);
    EXPECT_GT(energy, last);
    last = energy;
  }
}

TEST_F(ColoursOfAPicture, BrightnessAndContrastDoNotMatter) {
  cv::Mat darker;
  picture_.convertTo(darker, CV_8U, 0.5);
  EXPECT_NEAR(EnergyOf(darker, 32, 22, 46), EnergyOf(picture_, 32, 22, 46), 1e-9);
}

TEST_F(ColoursOfAPicture, WithoutColoursOrBuildingsTheEnergyIsOne) {
  const cv::Mat black = cv::Mat::zeros(480, 640, CV_8UC3);
  EXPECT_EQ(EnergyOf(black, 32, 20, 44), 1.0);
  EXPECT_FALSE(ColourInformation(black, camera_, kGrid).has_colours());
  EXPECT_EQ(EnergyOf(picture_, 32, 0, 0), 1.0);  // no building in view
  const ColourInformation information(picture_, camera_, kGrid);
  const Groups unknown(64 * 48, kNoGroup);
  EXPECT_EQ(CuesOf(information, unknown).regions, 0.0);
  EXPECT_EQ(CuesOf(information, unknown).facades, 0.0);
}

TEST_F(ColoursOfAPicture, NoiseAloneIsNearOne) {
  cv::Mat noise(480, 640, CV_8UC3);
  cv::RNG random(7);
  random.fill(noise, cv::RNG::UNIFORM, 0, 255);
  EXPECT_GT(EnergyOf(noise, 32, 20, 44), 0.99);
}

TEST_F(ColoursOfAPicture, HiddenCellsCountAsNotKnown) {
  cv::Mat hidden = cv::Mat::zeros(picture_.size(), CV_8U);
  hidden(cv::Rect(250, 100, 100, 300)).setTo(255);  // cells 25 to 34, 10 to 39
  const ColourInformation seen(picture_, camera_, kGrid);
  const ColourInformation partly(picture_, camera_, kGrid, hidden);
  const Groups groups = Regions(seen, 32, 22, 46);
  Groups known = groups;
  for (int y = 10; y < 40; ++y) {
    for (int x = 25; x < 35; ++x) known[y * 64 + x] = kNoGroup;
  }
  EXPECT_EQ(CuesOf(partly, groups).regions, CuesOf(seen, known).regions);
  EXPECT_EQ(CuesOf(partly, groups).facades, CuesOf(seen, known).facades);
  EXPECT_NE(CuesOf(partly, groups).regions, CuesOf(seen, groups).regions);
}

// Two walls of different colours, side by side.
class TwoWalls : public ColoursOfAPicture {
 protected:
  void SetUp() override {
    picture_(cv::Rect(200, 80, 120, 240)).setTo(cv::Scalar(150, 160, 170));
  }

  // The walls meet at a column of the grid.
  double FacadesOf(int seam) const {
    const ColourInformation information(picture_, camera_, kGrid);
    Groups groups = Regions(information, 32, 20, 44);
    for (std::size_t cell = 0; cell < groups.size(); ++cell) {
      const int column = static_cast<int>(cell) % information.camera().width;
      if (groups[cell] == kWalls && column >= seam) groups[cell] = kOtherWalls;
    }
    return CuesOf(information, groups).facades;
  }
};

TEST_F(TwoWalls, TheBayesFactorIsThatOfTheDirichletMultinomial) {
  // n cells of one colour, n of another: in a group each, or in one group. 54 colours of
  // concentration 0.1: log of Gamma functions, as in any text book.
  const double n = 12.0 * 24.0;
  const double a = 0.1;
  const double all = 54.0 * a;
  const auto rising = [](double x, double k) { return std::lgamma(x + k) - std::lgamma(x); };
  const double apart = 2.0 * (rising(a, n) - rising(all, n));
  const double together = 2.0 * rising(a, n) - rising(all, 2.0 * n);
  EXPECT_NEAR(FacadesOf(32), apart - together, 1e-6);
  EXPECT_GT(FacadesOf(32), 100.0);
}

TEST_F(TwoWalls, IsHighestWhereTheColoursChange) {
  double last = FacadesOf(32);
  for (const int shift : {1, 2, 4, 8}) {
    for (const int sign : {-1, 1}) EXPECT_LT(FacadesOf(32 + sign * shift), last) << sign * shift;
    last = std::max(FacadesOf(32 - shift), FacadesOf(32 + shift));
  }
}

TEST_F(TwoWalls, OneGroupAloneSaysNothing) { EXPECT_NEAR(FacadesOf(64), 0.0, 1e-9); }

TEST_F(TwoWalls, GroupsThatTellNothingCountAgainst) {
  picture_(cv::Rect(200, 80, 240, 240)).setTo(cv::Scalar(60, 110, 150));
  EXPECT_LT(FacadesOf(32), 0.0);
}

TEST_F(TwoWalls, MemoryUsedAgainChangesNothing) {
  const ColourInformation information(picture_, camera_, kGrid);
  const Groups first = Regions(information, 32, 20, 44);
  const Groups second = Regions(information, 30, 10, 50);
  ColourInformation::Workspace workspace;
  const double alone = information.Of(first, 4, workspace).regions;
  information.Of(second, 3, workspace);
  EXPECT_EQ(information.Of(first, 4, workspace).regions, alone);
}

// Each column of the picture one group behind it: what is found must be what single rays find, also
// where straight down or the panorama's seam is in the picture.
TEST(ColourInformation, FindsWhatSingleRaysFind) {
  const PinholeCamera camera{640, 480, 500.0, 500.0, 320.0, 240.0};
  cv::Mat noise(480, 640, CV_8UC3);
  cv::RNG random(5);
  random.fill(noise, cv::RNG::UNIFORM, 0, 255);
  const ColourInformation information(noise, camera, ColourOptions{50});
  SurfacePanorama panorama;
  panorama.step = 0.02;
  panorama.first_azimuth = 1.0;
  panorama.columns = 315;
  panorama.first_elevation = -1.57;
  panorama.rows = 158;
  SurfaceGroups groups;
  groups.count = 9;
  for (int i = 0; i < panorama.columns * panorama.rows; ++i) {
    groups.of_cell.push_back(
        static_cast<std::uint16_t>(((i % panorama.columns) / 40 + (i / panorama.columns) / 40) % 9));
  }
  for (const ViewAngles angles : {ViewAngles{20, 0, 0}, ViewAngles{70, -40, 5}, ViewAngles{130, -85, 0}}) {
    const Eigen::Matrix3f rotation = CamFromWorld(angles).toRotationMatrix().cast<float>();
    ColourInformation::Workspace workspace;
    information.Of(panorama, groups, rotation, workspace);
    std::size_t different = 0;
    for (int y = 0; y < information.camera().height; ++y) {
      for (int x = 0; x < information.camera().width; ++x) {
        const Eigen::Vector3f ray =
            rotation.transpose() *
            information.camera().RayFromImage({x + 0.5, y + 0.5}).cast<float>();
        const int cell = panorama.Find(simd::Splat(ray))[0];
        const std::uint16_t expected = cell < 0 ? kNoGroup : groups.of_cell[cell];
        different += workspace.groups[y * information.camera().width + x] != expected;
      }
    }
    // Cells at the very border of two groups may go to either.
    EXPECT_LT(different, workspace.groups.size() / 100) << angles.heading_deg;
  }
}

TEST(SurfaceGroups, WallsAndRoofsOfEachBuildingSkyAndGround) {
  CityModel model;
  model.surfaces = {{SurfaceClass::kWall, 0, {0, 1, 0}},
                    {SurfaceClass::kRoof, 0, {0, 0, 1}},
                    {SurfaceClass::kWall, 1, {1, 0, 0}},
                    {SurfaceClass::kWall, 0, {1, 0, 0}},
                    {SurfaceClass::kGround, 1, {0, 0, -1}}};
  SurfacePanorama panorama;
  panorama.first_elevation = -0.1;
  panorama.step = 0.2;
  panorama.columns = 4;
  panorama.rows = 2;
  panorama.surfaces = {kNoSurface, kTerrainSurface, 4, 0, 2, 3, 1, kNoSurface};
  const SurfaceGroups groups = GroupsOf(panorama, model);
  EXPECT_EQ(groups.of_cell,
            (Groups{kGroundGroup, kGroundGroup, kGroundGroup, 2, 3, 2, 4, kSkyGroup}));
  EXPECT_EQ(groups.count, 5);
}

}  // namespace
}  // namespace ridgeline
