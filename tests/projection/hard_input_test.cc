// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "base/error.h"
#include "base/random.h"
#include "projection/scene.h"
#include "support/synthetic_city.h"
#include "support/synthetic_terrain.h"

namespace ridgeline {
namespace {

using testing::CityBuilder;
using testing::House;
using testing::MakeCity;
using testing::MakeTerrain;
using testing::TownHouses;

constexpr PinholeCamera kCamera{160, 120, 130.0, 130.0, 80.0, 60.0};

// No NaN, no piece of no length, pieces in order; also in the image, in some directions.
void ExpectSane(const Scene& scene, const Eigen::Vector3d& eye) {
  const VisibleSet set = scene.VisibleFrom(eye, {});
  for (std::size_t k = 0; k < set.pieces.size(); ++k) {
    const VisiblePiece& piece = set.pieces[k];
    EXPECT_TRUE(piece.a.allFinite() && piece.b.allFinite());
    EXPECT_NE(piece.a, piece.b);
    EXPECT_LT(piece.edge, scene.edge_count());
    EXPECT_GE(piece.edge, set.pieces[k == 0 ? 0 : k - 1].edge);
  }
  for (const float elevation : set.skyline_elevation) {
    EXPECT_TRUE(elevation >= 0.0f && elevation <= 1.5708f) << elevation;
  }
  std::vector<ProjectedSegment> segments;
  for (double heading = 0.0; heading < 360.0; heading += 45.0) {
    const Pose pose{CamFromWorld(ViewAngles{heading, heading / 5.0 - 35.0, 10.0}), eye};
    ProjectPieces(set, kCamera, pose, segments);
    for (const ProjectedSegment& segment : segments) {
      EXPECT_TRUE(segment.a.allFinite() && segment.b.allFinite());
      EXPECT_GE(segment.depth, 0.1f);
      // Within the image, to rounding.
      EXPECT_GE(std::min(segment.a.minCoeff(), segment.b.minCoeff()), -0.01f);
      EXPECT_LE(std::max(segment.a.x(), segment.b.x()), 160.01f);
      EXPECT_LE(std::max(segment.a.y(), segment.b.y()), 120.01f);
    }
    const ViewBuffers buffers = scene.Render(kCamera, pose, true);
    EXPECT_EQ(cv::countNonZero(buffers.depth != buffers.depth), 0) << "NaN";
  }
}

TEST(HardInput, EmptyModel) {
  const CityModel model;
  const Scene scene(model, nullptr, {});
  const VisibleSet set = scene.VisibleFrom({0, 0, 0}, {});
  EXPECT_TRUE(set.pieces.empty());
  EXPECT_EQ(*std::max_element(set.skyline_elevation.begin(), set.skyline_elevation.end()), 0.0f);
  EXPECT_FALSE(scene.Raycast({0, 0, 0}, {1, 0, 0}).has_value());
  ExpectSane(scene, {0, 0, 0});
}

TEST(HardInput, DegenerateTrianglesHideNothing) {
  const CityModel clean = MakeCity(TownHouses(2, 2, 51));
  CityModel dirty = clean;
  Random random(1, HashText("degenerate"));
  for (int k = 0; k < 300; ++k) {
    const auto any = [&] {
      return static_cast<std::uint32_t>(random.Below(clean.vertices.size()));
    };
    const std::uint32_t a = any();
    const std::uint32_t b = any();
    // Two equal corners, three equal corners, three on a line.
    dirty.triangles.push_back({{a, a, b}, 0});
    dirty.triangles.push_back({{a, a, a}, 0});
    dirty.vertices.push_back(0.5 * (dirty.vertices[a] + dirty.vertices[b]));
    dirty.triangles.push_back({{a, b, static_cast<std::uint32_t>(dirty.vertices.size() - 1)}, 0});
  }
  dirty.feature_edges.push_back({clean.vertices[0], clean.vertices[0], 0, 1, false});
  const Scene clean_scene(clean, nullptr, {});
  const Scene dirty_scene(dirty, nullptr, {});
  for (const Eigen::Vector3d& eye : {Eigen::Vector3d(60, 60, 2), Eigen::Vector3d(30, 60, 40)}) {
    ExpectSane(dirty_scene, eye);
    const VisibleSet expected = clean_scene.VisibleFrom(eye, {});
    const VisibleSet found = dirty_scene.VisibleFrom(eye, {});
    ASSERT_EQ(found.pieces.size(), expected.pieces.size());
    for (std::size_t k = 0; k < found.pieces.size(); ++k) {
      EXPECT_LT((found.pieces[k].a - expected.pieces[k].a).norm(), 1e-3f);
      EXPECT_LT((found.pieces[k].b - expected.pieces[k].b).norm(), 1e-3f);
    }
  }
}

// The front of a house cut into strips whose corners lie on its long edges, as a soup of triangles
// with vertices of their own; the same pieces are visible as of the whole house.
TEST(HardInput, TJunctionsAndDuplicatedVerticesChangeNothing) {
  const CityModel clean = MakeCity(TownHouses(2, 2, 52));
  CityModel soup = clean;
  soup.vertices.clear();
  soup.triangles.clear();
  for (const Triangle& triangle : clean.triangles) {
    const Eigen::Vector3d& a = clean.vertices[triangle.vertices[0]];
    const Eigen::Vector3d& b = clean.vertices[triangle.vertices[1]];
    const Eigen::Vector3d& c = clean.vertices[triangle.vertices[2]];
    // Cut at the middle of one side, which the neighbour does not know.
    const Eigen::Vector3d middle = 0.5 * (b + c);
    for (const auto& corners : {std::array{a, b, middle}, std::array{a, middle, c}}) {
      const auto first = static_cast<std::uint32_t>(soup.vertices.size());
      soup.vertices.insert(soup.vertices.end(), corners.begin(), corners.end());
      soup.triangles.push_back({{first, first + 1, first + 2}, triangle.surface});
    }
  }
  const Scene clean_scene(clean, nullptr, {});
  const Scene soup_scene(soup, nullptr, {});
  for (const Eigen::Vector3d& eye : {Eigen::Vector3d(60, 60, 2), Eigen::Vector3d(30, 60, 40)}) {
    ExpectSane(soup_scene, eye);
    const VisibleSet expected = clean_scene.VisibleFrom(eye, {});
    const VisibleSet found = soup_scene.VisibleFrom(eye, {});
    ASSERT_EQ(found.pieces.size(), expected.pieces.size());
    for (std::size_t k = 0; k < found.pieces.size(); ++k) {
      EXPECT_EQ(found.pieces[k].edge, expected.pieces[k].edge);
      EXPECT_LT((found.pieces[k].a - expected.pieces[k].a).norm(), 2e-3f);
      EXPECT_LT((found.pieces[k].b - expected.pieces[k].b).norm(), 2e-3f);
    }
  }
}

TEST(HardInput, FourFacesAtAnEdge) {
  // Two boxes that touch along one vertical edge, their vertices shared.
  CityBuilder builder;
  House house;
  house.length_m = house.width_m = 10.0;
  house.eaves_m = house.ridge_m = 8.0;
  for (const double shift : {0.0, 10.0}) {
    house.center = {shift, 30.0 + shift};
    builder.AddHouse(house);
  }
  const CityModel model = builder.Build();
  const Scene scene(model, nullptr, {});
  ExpectSane(scene, {12, 0, 2});
  const VisibleSet set = scene.VisibleFrom({12, 0, 2}, {});
  EXPECT_TRUE(std::any_of(set.pieces.begin(), set.pieces.end(), [](const VisiblePiece& piece) {
    return (piece.a.head<2>() - Eigen::Vector2f(5, 35)).norm() < 1e-3f &&
           (piece.b.head<2>() - Eigen::Vector2f(5, 35)).norm() < 1e-3f;
  })) << "the common edge";
}

TEST(HardInput, InsideAClosedBuildingNothingIsVisible) {
  const std::vector<House> houses = TownHouses(2, 2, 53);
  const CityModel model = MakeCity(houses);
  const Scene scene(model, nullptr, {});
  const Eigen::Vector3d eye(houses[0].center.x(), houses[0].center.y(), 2.0);
  ExpectSane(scene, eye);
  const VisibleSet set = scene.VisibleFrom(eye, {});
  EXPECT_TRUE(set.pieces.empty());
  EXPECT_GT(*std::min_element(set.skyline_elevation.begin(), set.skyline_elevation.end()), 0.1f);
}

TEST(HardInput, BelowTheTerrainNothingIsVisible) {
  const CityModel model = MakeCity(TownHouses(2, 2, 54));
  const HeightGrid dtm =
      MakeTerrain({-300, -300}, 2.0, 361, 361, [](double, double) { return 0.0; });
  const Scene scene(model, &dtm, {});
  ExpectSane(scene, {60, 60, -3});
  EXPECT_TRUE(scene.VisibleFrom({60, 60, -3}, {}).pieces.empty());
}

TEST(HardInput, AKilometreAbove) {
  const CityModel model = MakeCity(TownHouses(3, 3, 55));
  ProjectionOptions options;
  options.max_distance_m = 2000.0;
  options.min_piece_mrad = 1.0;
  const Scene scene(model, nullptr, options);
  ExpectSane(scene, {90, 90, 1000});
  EXPECT_GT(scene.VisibleFrom({90, 90, 1000}, {}).pieces.size(), 100u);
  EXPECT_TRUE(Scene(model, nullptr, {}).VisibleFrom({90, 90, 1000}, {}).pieces.empty())
      << "farther than max_distance_m";
}

TEST(HardInput, EyeOnAVertexAnEdgeAndAFace) {
  const CityModel model = MakeCity(TownHouses(2, 2, 56));
  const Scene scene(model, nullptr, {});
  const FeatureEdge& edge = model.feature_edges[5];
  ExpectSane(scene, edge.a);
  ExpectSane(scene, 0.5 * (edge.a + edge.b));
  ExpectSane(scene, edge.b + 2.0 * (edge.b - edge.a));
  const Triangle& triangle = model.triangles[10];
  ExpectSane(scene,
             (model.vertices[triangle.vertices[0]] + model.vertices[triangle.vertices[1]] +
              model.vertices[triangle.vertices[2]]) /
                 3.0);
}

TEST(HardInput, TerrainWithHolesAndOddSizes) {
  const CityModel model = MakeCity(TownHouses(2, 2, 57));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  HeightGrid dtm = MakeTerrain({-50, -50}, 3.0, 75, 61, [](double east, double north) {
    return std::sin(east / 20.0) + std::cos(north / 30.0);
  });
  for (std::size_t k = 0; k < dtm.heights.size(); k += 7) dtm.heights[k] = nan;
  ExpectSane(Scene(model, &dtm, {}), {60, 60, 5});
  std::fill(dtm.heights.begin(), dtm.heights.end(), nan);
  ExpectSane(Scene(model, &dtm, {}), {60, 60, 5});
  ExpectSane(Scene(model, std::make_unique<HeightGrid>().get(), {}), {60, 60, 5});
  dtm.heights.pop_back();
  EXPECT_THROW(Scene(model, &dtm, {}), InputError);
}

TEST(ProjectionOptions, ValidateNamesTheField) {
  const CityModel model;
  ProjectionOptions options;
  options.max_distance_m = -1.0;
  try {
    const Scene scene(model, nullptr, options);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.field(), "projection.max_distance_m");
  }
}

}  // namespace
}  // namespace ridgeline
