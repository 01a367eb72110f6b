// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/random.h"
#include "city/city_text.h"
#include "city/terrain.h"

namespace ridgeline::testing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

bool InRing(const std::vector<Vector2d>& ring, const Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2d& a = ring[i];
    const Vector2d& b = ring[(i + 1) % ring.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

double RingArea(const std::vector<Vector2d>& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2d& a = ring[i];
    const Vector2d& b = ring[(i + 1) % ring.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

Vector2d Local(const CityModel& model, double x, double y) {
  return (kCorner + Vector3d(x, y, 0) - model.origin_in_world).head<2>();
}

// A courtyard house: a ring of ground with a hole.
std::string Courtyard() {
  const auto p = [](double x, double y) { return Vector3d(kCorner + Vector3d(x, y, 0)); };
  const Ring outer{p(0, 0), p(0, 20), p(20, 20), p(20, 0)};
  const Ring hole{p(5, 5), p(15, 5), p(15, 15), p(5, 15)};
  return GmlBuilding("yard", GmlBoundary("GroundSurface", GmlPolygon(outer, {hole})));
}

TEST(Footprints, GroundSurfacesWithCourtyards) {
  const CityModel model = ReadGml(GmlDocument(Courtyard()));
  const Footprints footprints(model);
  EXPECT_TRUE(footprints.Contains(Local(model, 2, 10)));
  EXPECT_TRUE(footprints.Contains(Local(model, 10, 18)));
  EXPECT_FALSE(footprints.Contains(Local(model, 10, 10)));
  EXPECT_FALSE(footprints.Contains(Local(model, -1, 10)));
  EXPECT_FALSE(footprints.Contains(Local(model, 1e6, 10)));
  ASSERT_EQ(footprints.rings().size(), 1u);
  EXPECT_NEAR(RingArea(footprints.rings()[0]), 400.0, 1e-6);
}

TEST(Footprints, OutlineOfWallsWhereThereIsNoGround) {
  const std::vector<Ring> rings = BoxRings(kCorner, kCorner + Vector3d(10, 8, 6));
  std::string content;
  for (int i = 0; i < 4; ++i) content += GmlBoundary("WallSurface", GmlPolygon(rings[i]));
  const CityModel model = ReadGml(GmlDocument(GmlBuilding("a", content)));
  const Footprints footprints(model);
  EXPECT_TRUE(footprints.Contains(Local(model, 5, 4)));
  EXPECT_FALSE(footprints.Contains(Local(model, 11, 4)));
  ASSERT_EQ(footprints.rings().size(), 1u);
  EXPECT_NEAR(RingArea(footprints.rings()[0]), 80.0, 1e-6);
}

TEST(Footprints, RoofWhereWallsDoNotClose) {
  const std::vector<Ring> rings = BoxRings(kCorner, kCorner + Vector3d(10, 8, 6));
  const CityModel model =
      ReadGml(GmlDocument(GmlBuilding("a",
                                      GmlBoundary("WallSurface", GmlPolygon(rings[0])) +
                                          GmlBoundary("RoofSurface", GmlPolygon(rings[4])))));
  EXPECT_TRUE(Footprints(model).Contains(Local(model, 5, 4)));
}

TEST(Footprints, AgreesWithBruteForce) {
  Random random(5, 5);
  std::string members;
  std::vector<std::vector<Vector2d>> outlines;
  for (int i = 0; i < 60; ++i) {
    const Vector2d center(random.Uniform(0, 300), random.Uniform(0, 300));
    const int corners = 3 + static_cast<int>(random.Below(8));
    Ring ring;
    std::vector<Vector2d> outline;
    for (int k = 0; k < corners; ++k) {
      const double angle = -6.283185307179586 * k / corners;  // seen from below
      const double radius = random.Uniform(3, 25);
      const Vector2d p = center + radius * Vector2d(std::cos(angle), std::sin(angle));
      // Kept to millimetres, as files are.
      const Vector2d rounded = (p * 1000.0).array().round() / 1000.0;
      outline.push_back(rounded);
      ring.emplace_back(kCorner + Vector3d(rounded.x(), rounded.y(), 0));
    }
    outlines.push_back(outline);
    members += GmlBuilding("b" + std::to_string(i), GmlBoundary("GroundSurface", GmlPolygon(ring)));
  }
  const CityModel model = ReadGml(GmlDocument(members));
  const Footprints footprints(model);
  EXPECT_EQ(footprints.rings().size(), outlines.size());
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector2d p(random.Uniform(-30, 330), random.Uniform(-30, 330));
    const bool expected = std::any_of(
        outlines.begin(), outlines.end(), [&](const auto& outline) { return InRing(outline, p); });
    // Vertices are welded to a centimetre: points nearer to an outline than that may differ.
    const bool found = footprints.Contains(Local(model, p.x(), p.y()));
    if (found != expected) {
      double distance = 1e9;
      for (const auto& outline : outlines) {
        for (std::size_t k = 0; k < outline.size(); ++k) {
          const Vector2d& a = outline[k];
          const Vector2d d = outline[(k + 1) % outline.size()] - a;
          const double t = std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
          distance = std::min(distance, (a + t * d - p).norm());
        }
      }
      EXPECT_LT(distance, 0.02) << p.transpose();
    }
    inside += expected ? 1 : 0;
  }
  EXPECT_GT(inside, 1000);
}

}  // namespace
}  // namespace ridgeline::testing
