// SPDX-License-Identifier: Apache-2.0
#include "city/mesh/feature_edges.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "city/city_text.h"

namespace ridgeline::testing {
namespace {

using Eigen::Vector3d;

struct Lengths {
  double fold = 0.0;
  double seam = 0.0;
  double border = 0.0;
};

Lengths LengthsOf(const CityModel& model) {
  Lengths lengths;
  for (const FeatureEdge& edge : model.feature_edges) {
    const double length = (edge.b - edge.a).norm();
    if (edge.seam) {
      lengths.seam += length;
    } else if (edge.surface1 == kNoSurface) {
      lengths.border += length;
    } else {
      lengths.fold += length;
    }
  }
  return lengths;
}

// The edges that run through a point given relative to kCorner.
std::vector<FeatureEdge> EdgesAt(const CityModel& model, const Vector3d& offset) {
  const Vector3d point = kCorner + offset - model.origin_in_world;
  std::vector<FeatureEdge> found;
  for (const FeatureEdge& edge : model.feature_edges) {
    const Vector3d along = edge.b - edge.a;
    const double t = std::clamp((point - edge.a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    if ((edge.a + t * along - point).norm() < 0.01) found.push_back(edge);
  }
  return found;
}

std::string Box(const std::string& id, const Vector3d& low, const Vector3d& high) {
  return GmlBox(id, kCorner + low, kCorner + high);
}

CityModel Read(const std::string& members, const CityOptions& options = {}) {
  return ReadGml(GmlDocument(members), options);
}

SurfaceClass ClassOf(const CityModel& model, std::uint32_t surface) {
  return model.surfaces[surface].surface_class;
}

TEST(FeatureEdges, BoxHasTwelveFolds) {
  const CityModel model = Read(Box("a", {0, 0, 0}, {10, 8, 6}));
  EXPECT_EQ(model.feature_edges.size(), 12u);
  const Lengths lengths = LengthsOf(model);
  EXPECT_NEAR(lengths.fold, 4.0 * (10 + 8 + 6), 1e-9);
  EXPECT_EQ(lengths.seam, 0.0);
  EXPECT_EQ(lengths.border, 0.0);
  for (const FeatureEdge& edge : model.feature_edges) {
    const Surface& s0 = model.surfaces[edge.surface0];
    const Surface& s1 = model.surfaces[edge.surface1];
    EXPECT_NEAR(s0.normal.dot(s1.normal), 0.0, 1e-6);
    const Vector3d along = (edge.b - edge.a).normalized();
    EXPECT_NEAR(along.dot(s0.normal.cast<double>()), 0.0, 1e-6);
    EXPECT_NEAR(along.dot(s1.normal.cast<double>()), 0.0, 1e-6);
  }
}

TEST(FeatureEdges, FootOfAWallIsKnownByItsGroundSurface) {
  const CityModel model = Read(Box("a", {0, 0, 0}, {10, 8, 6}));
  const std::vector<FeatureEdge> edges = EdgesAt(model, {5, 0, 0});
  ASSERT_EQ(edges.size(), 1u);
  const bool has_ground = ClassOf(model, edges[0].surface0) == SurfaceClass::kGround ||
                          ClassOf(model, edges[0].surface1) == SurfaceClass::kGround;
  EXPECT_TRUE(has_ground);
}

TEST(FeatureEdges, WallSharedByEqualNeighboursLeavesSeamsOnly) {
  const CityModel model =
      Read(Box("a", {0, 0, 0}, {10, 10, 10}) + Box("b", {10, 0, 0}, {20, 10, 10}));
  const Lengths lengths = LengthsOf(model);
  // What remains is the outline of one box of 20 x 10 x 10 and, where the two meet, a seam up the
  // front, over the roof and down the back.
  EXPECT_NEAR(lengths.fold, 4.0 * (20 + 10 + 10), 1e-6);
  EXPECT_NEAR(lengths.seam, 30.0, 1e-6);
  EXPECT_EQ(lengths.border, 0.0);
}

TEST(FeatureEdges, TallerNeighbourShowsItsFreeWall) {
  const CityModel model =
      Read(Box("low", {0, 0, 0}, {10, 10, 10}) + Box("high", {10, 0, 0}, {20, 10, 15}));
  // The low roof meets the high wall in a fold between exactly those two.
  const std::vector<FeatureEdge> junction = EdgesAt(model, {10, 5, 10});
  ASSERT_EQ(junction.size(), 1u);
  EXPECT_FALSE(junction[0].seam);
  EXPECT_NEAR((junction[0].b - junction[0].a).norm(), 10.0, 1e-9);
  const SurfaceClass c0 = ClassOf(model, junction[0].surface0);
  const SurfaceClass c1 = ClassOf(model, junction[0].surface1);
  EXPECT_TRUE((c0 == SurfaceClass::kRoof && c1 == SurfaceClass::kWall) ||
              (c0 == SurfaceClass::kWall && c1 == SurfaceClass::kRoof));
  // Front corner of the high one: a seam up to 10 m, a fold above.
  const std::vector<FeatureEdge> below = EdgesAt(model, {10, 0, 5});
  ASSERT_EQ(below.size(), 1u);
  EXPECT_TRUE(below[0].seam);
  EXPECT_NEAR((below[0].b - below[0].a).norm(), 10.0, 1e-6);
  const std::vector<FeatureEdge> above = EdgesAt(model, {10, 0, 12});
  ASSERT_EQ(above.size(), 1u);
  EXPECT_FALSE(above[0].seam);
  EXPECT_NEAR((above[0].b - above[0].a).norm(), 5.0, 1e-6);
  EXPECT_EQ(EdgesAt(model, {10, 5, 15}).size(), 1u);
  EXPECT_TRUE(EdgesAt(model, {10, 5, 0}).empty());
}

TEST(FeatureEdges, SetBackNeighbourMakesConcaveFolds) {
  const CityModel model =
      Read(Box("a", {0, 0, 0}, {10, 10, 10}) + Box("b", {10, 4, 0}, {20, 14, 10}));
  for (const double y : {4.0, 10.0}) {
    const std::vector<FeatureEdge> edges = EdgesAt(model, {10, y, 5});
    ASSERT_EQ(edges.size(), 1u) << y;
    EXPECT_FALSE(edges[0].seam);
    EXPECT_NE(model.surfaces[edges[0].surface0].building,
              model.surfaces[edges[0].surface1].building);
    EXPECT_NEAR((edges[0].b - edges[0].a).norm(), 10.0, 1e-6);
  }
  EXPECT_FALSE(EdgesAt(model, {10, 2, 10})[0].seam);
  EXPECT_TRUE(EdgesAt(model, {10, 7, 10})[0].seam);
  EXPECT_FALSE(EdgesAt(model, {10, 12, 10})[0].seam);
}

TEST(FeatureEdges, LongEdgeAgainstSeveralShorterOnes) {
  const CityModel model =
      Read(Box("long", {0, 0, 0}, {10, 20, 10}) + Box("b1", {10, 0, 0}, {20, 12, 10}) +
           Box("b2", {10, 12, 0}, {20, 20, 10}));
  const Lengths lengths = LengthsOf(model);
  EXPECT_NEAR(lengths.fold, 4.0 * (20 + 20 + 10), 1e-6);
  // Roofs: 20 and 10; facades: 10 in front, 10 behind, 10 at the right.
  EXPECT_NEAR(lengths.seam, 60.0, 1e-6);
  EXPECT_EQ(lengths.border, 0.0);
}

TEST(FeatureEdges, NarrowGapCountsAsTouching) {
  const CityModel touching =
      Read(Box("a", {0, 0, 0}, {10, 10, 10}) + Box("b", {10.02, 0, 0}, {20, 10, 10}));
  EXPECT_NEAR(LengthsOf(touching).seam, 30.0, 0.1);
  const CityModel apart =
      Read(Box("a", {0, 0, 0}, {10, 10, 10}) + Box("b", {10.5, 0, 0}, {20, 10, 10}));
  EXPECT_EQ(apart.feature_edges.size(), 24u);
}

TEST(FeatureEdges, JointOfFacadesOutOfLineIsASeam) {
  // The right house stands 20 cm back, 10 cm apart, and is 3 m lower.
  const std::string members =
      Box("a", {0, 0, 0}, {10, 10, 10}) + Box("b", {10.1, 0.2, 0}, {20, 10.2, 7});
  const CityModel model = Read(members);
  const std::vector<FeatureEdge> low = EdgesAt(model, {10, 0, 3});
  ASSERT_EQ(low.size(), 1u);
  EXPECT_TRUE(low[0].seam);
  EXPECT_NEAR((low[0].b - low[0].a).norm(), 7.0, 1e-6);
  const std::vector<FeatureEdge> high = EdgesAt(model, {10, 0, 9});
  ASSERT_EQ(high.size(), 1u);
  EXPECT_FALSE(high[0].seam);
  EXPECT_TRUE(EdgesAt(model, {10.1, 0.2, 3})[0].seam);
  EXPECT_FALSE(EdgesAt(model, {0, 0, 3})[0].seam);
  EXPECT_FALSE(EdgesAt(model, {20, 0.2, 3})[0].seam);
  CityOptions strict;
  strict.joint_m = 0.0;
  EXPECT_FALSE(EdgesAt(Read(members, strict), {10, 0, 3})[0].seam);
}

TEST(FeatureEdges, SplitWallHasNoEdgeWithin) {
  std::vector<Ring> rings = BoxRings(kCorner, kCorner + Vector3d(10, 8, 6));
  const Vector3d low = kCorner + Vector3d(4, 0, 0);
  const Vector3d high = kCorner + Vector3d(4, 0, 6);
  // The front wall in two halves; the roof keeps its long edge: a T-junction at its eaves.
  const Ring left{rings[0][0], low, high, rings[0][3]};
  const Ring right{low, rings[0][1], rings[0][2], high};
  std::string content = GmlBoundary("WallSurface",
                                    GmlPolygon(left) +
                                        "</gml:surfaceMember>"
                                        "<gml:surfaceMember>" +
                                        GmlPolygon(right));
  for (int i = 1; i < 4; ++i) content += GmlBoundary("WallSurface", GmlPolygon(rings[i]));
  content += GmlBoundary("RoofSurface", GmlPolygon(rings[4]));
  content += GmlBoundary("GroundSurface", GmlPolygon(rings[5]));
  const CityModel model = Read(GmlBuilding("a", content));
  EXPECT_EQ(model.surfaces.size(), 7u);
  EXPECT_TRUE(EdgesAt(model, {4, 0, 3}).empty());
  EXPECT_NEAR(LengthsOf(model).fold, 4.0 * (10 + 8 + 6), 1e-6);
  EXPECT_EQ(LengthsOf(model).border, 0.0);
  // The eaves above the two halves are one edge.
  const std::vector<FeatureEdge> eaves = EdgesAt(model, {2, 0, 6});
  ASSERT_EQ(eaves.size(), 1u);
  EXPECT_NEAR((eaves[0].b - eaves[0].a).norm(), 10.0, 1e-9);
}

TEST(FeatureEdges, FoldAngleIsThresholded) {
  // A roof of two planes with a fold of 2 x 4 degrees.
  const double rise = 5.0 * std::tan(4.0 * std::numbers::pi / 180.0);
  const auto p = [](double x, double y, double z) { return Vector3d(kCorner + Vector3d(x, y, z)); };
  const std::string content =
      GmlBoundary("RoofSurface",
                  GmlPolygon({p(0, 0, 5), p(5, 0, 5 + rise), p(5, 8, 5 + rise), p(0, 8, 5)})) +
      GmlBoundary("RoofSurface",
                  GmlPolygon({p(5, 0, 5 + rise), p(10, 0, 5), p(10, 8, 5), p(5, 8, 5 + rise)}));
  CityOptions options;
  options.min_dihedral_deg = 9.0;
  EXPECT_TRUE(EdgesAt(Read(GmlBuilding("a", content), options), {5, 4, 5 + rise}).empty());
  options.min_dihedral_deg = 7.0;
  EXPECT_EQ(EdgesAt(Read(GmlBuilding("a", content), options), {5, 4, 5 + rise}).size(), 1u);
}

TEST(FeatureEdges, SheetWithoutNeighbourHasBorders) {
  const std::vector<Ring> rings = BoxRings(kCorner, kCorner + Vector3d(10, 8, 6));
  const CityModel model = Read(GmlBuilding("a", GmlBoundary("WallSurface", GmlPolygon(rings[0]))));
  EXPECT_EQ(model.feature_edges.size(), 4u);
  EXPECT_NEAR(LengthsOf(model).border, 32.0, 1e-9);
}

TEST(FeatureEdges, ClosureSurfacesAloneDrawNoLines) {
  const std::vector<Ring> rings = BoxRings(kCorner, kCorner + Vector3d(10, 8, 6));
  const CityModel model = Read(GmlBuilding("a",
                                           GmlBoundary("ClosureSurface", GmlPolygon(rings[0])) +
                                               GmlBoundary("ClosureSurface", GmlPolygon(rings[1])) +
                                               GmlBoundary("RoofSurface", GmlPolygon(rings[4]))));
  EXPECT_TRUE(EdgesAt(model, {10, 0, 3}).empty());
  EXPECT_EQ(EdgesAt(model, {5, 0, 6}).size(), 1u);
}

TEST(FeatureEdges, SameOnAnyNumberOfThreads) {
  std::string members;
  for (int i = 0; i < 40; ++i) {
    const double x = 10.0 * (i % 8);
    const double y = 14.0 * (i / 8);
    members += Box("b" + std::to_string(i), {x, y, 0}, {x + 10, y + 10 + i % 3, 5.0 + i % 4});
  }
  CityOptions options;
  options.threads = 1;
  const CityModel one = Read(members, options);
  options.threads = 8;
  const CityModel eight = Read(members, options);
  ASSERT_EQ(one.feature_edges.size(), eight.feature_edges.size());
  for (std::size_t i = 0; i < one.feature_edges.size(); ++i) {
    EXPECT_EQ(one.feature_edges[i].a, eight.feature_edges[i].a);
    EXPECT_EQ(one.feature_edges[i].b, eight.feature_edges[i].b);
    EXPECT_EQ(one.feature_edges[i].surface0, eight.feature_edges[i].surface0);
    EXPECT_EQ(one.feature_edges[i].surface1, eight.feature_edges[i].surface1);
  }
}

}  // namespace
}  // namespace ridgeline::testing
