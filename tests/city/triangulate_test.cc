// SPDX-License-Identifier: Apache-2.0
#include "city/mesh/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"

namespace ridgeline {
namespace {

using Point = Eigen::Vector2d;

double TriangleArea(const PlanarPolygon& polygon, const std::vector<TriangleIndices>& triangles) {
  double area = 0.0;
  for (const TriangleIndices& t : triangles) {
    const double twice = Cross(polygon.points[t[0]], polygon.points[t[1]], polygon.points[t[2]]);
    EXPECT_GT(twice, 0.0);
    area += 0.5 * twice;
  }
  return area;
}

double RingsArea(const PlanarPolygon& polygon) {
  double area = 0.0;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : polygon.ring_ends) {
    area += SignedArea(std::span(polygon.points).subspan(begin, end - begin));
    begin = end;
  }
  return area;
}

bool InRings(const PlanarPolygon& polygon, const Point& p) {
  bool inside = false;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : polygon.ring_ends) {
    for (std::uint32_t i = begin; i < end; ++i) {
      const Point& a = polygon.points[i];
      const Point& b = polygon.points[i + 1 == end ? begin : i + 1];
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
    }
    begin = end;
  }
  return inside;
}

// Equal area and equal cover at random points: the triangles fill the polygon, once.
void ExpectFilled(const PlanarPolygon& polygon, const std::string& name) {
  const std::vector<TriangleIndices> triangles = Triangulate(polygon);
  const double area = RingsArea(polygon);
  EXPECT_NEAR(TriangleArea(polygon, triangles), area, 1e-9 * area) << name;
  Point low = polygon.points[0];
  Point high = low;
  for (const Point& p : polygon.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Random random(7, HashText(name));
  for (int i = 0; i < 200; ++i) {
    const Point p(random.Uniform(low.x(), high.x()), random.Uniform(low.y(), high.y()));
    int cover = 0;
    for (const TriangleIndices& t : triangles) {
      const Point& a = polygon.points[t[0]];
      const Point& b = polygon.points[t[1]];
      const Point& c = polygon.points[t[2]];
      cover += Cross(a, b, p) > 0 && Cross(b, c, p) > 0 && Cross(c, a, p) > 0 ? 1 : 0;
    }
    EXPECT_EQ(cover, InRings(polygon, p) ? 1 : 0) << name << " at " << p.transpose();
  }
}

void AddRing(PlanarPolygon& polygon, const std::vector<Point>& ring) {
  polygon.points.insert(polygon.points.end(), ring.begin(), ring.end());
  polygon.ring_ends.push_back(static_cast<std::uint32_t>(polygon.points.size()));
}

std::vector<Point> Rectangle(double x0, double y0, double x1, double y1, bool hole) {
  std::vector<Point> ring{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  if (hole) std::reverse(ring.begin(), ring.end());
  return ring;
}

TEST(Triangulate, StarsWithManyCorners) {
  Random random(1, 2);
  for (int trial = 0; trial < 100; ++trial) {
    PlanarPolygon polygon;
    const int corners = 3 + static_cast<int>(random.Below(60));
    std::vector<Point> ring;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / corners;
      const double radius = random.Uniform(1.0, 20.0);
      ring.push_back(radius * Point(std::cos(angle), std::sin(angle)));
    }
    AddRing(polygon, ring);
    ExpectFilled(polygon, "star " + std::to_string(trial));
  }
}

TEST(Triangulate, GridsOfHoles) {
  for (int n = 1; n <= 5; ++n) {
    PlanarPolygon polygon;
    AddRing(polygon, Rectangle(0, 0, 4.0 * n, 4.0 * n, false));
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        AddRing(polygon, Rectangle(4.0 * i + 1, 4.0 * j + 1, 4.0 * i + 3, 4.0 * j + 3, true));
      }
    }
    ExpectFilled(polygon, "grid " + std::to_string(n));
  }
}

TEST(Triangulate, TurnedGridsOfHoles) {
  Random random(3, 4);
  for (int trial = 0; trial < 50; ++trial) {
    const double angle = random.Uniform(0.0, 6.28);
    Eigen::Matrix2d turn;
    turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    PlanarPolygon polygon;
    AddRing(polygon, Rectangle(0, 0, 12, 8, false));
    for (int i = 0; i < 3; ++i) {
      const double y = random.Uniform(0.5, 4.0);
      AddRing(polygon, Rectangle(4.0 * i + 1, y, 4.0 * i + 3, y + 3, true));
    }
    for (Point& p : polygon.points) p = turn * p;
    ExpectFilled(polygon, "turned " + std::to_string(trial));
  }
}

TEST(Triangulate, CollinearAndRepeatedCorners) {
  PlanarPolygon polygon;
  AddRing(polygon, {{0, 0}, {2, 0}, {4, 0}, {4, 0}, {4, 3}, {2, 3}, {0, 3}, {0, 1.5}});
  ExpectFilled(polygon, "collinear");
}

TEST(Triangulate, HoleThatTouchesTheOutline) {
  PlanarPolygon polygon;
  AddRing(polygon, Rectangle(0, 0, 10, 10, false));
  AddRing(polygon, {{10, 5}, {6, 3}, {6, 7}});  // clockwise, one corner on the right side
  ExpectFilled(polygon, "touching");
}

TEST(Triangulate, HolesThatTouchEachOther) {
  PlanarPolygon polygon;
  AddRing(polygon, Rectangle(0, 0, 10, 10, false));
  AddRing(polygon, Rectangle(2, 2, 5, 5, true));
  AddRing(polygon, Rectangle(5, 5, 8, 8, true));
  ExpectFilled(polygon, "corner to corner");
}

TEST(Triangulate, CombIsFilled) {
  PlanarPolygon polygon;
  std::vector<Point> ring{{0, 0}, {41, 0}};
  for (int i = 20; i >= 0; --i) {
    ring.emplace_back(2.0 * i + 1, 10);
    ring.emplace_back(2.0 * i, 10);
    if (i > 0) {
      ring.emplace_back(2.0 * i, 1);
      ring.emplace_back(2.0 * i - 1, 1);
    }
  }
  AddRing(polygon, ring);
  ExpectFilled(polygon, "comb");
}

// Without a bound on the search for ears this goes on for the cube of the corners.
TEST(Triangulate, OutlineThatCrossesItselfEverywhereEnds) {
  std::vector<Eigen::Vector2d> ring;
  for (int i = 0; i < 8000; ++i) ring.emplace_back(i * 7919 % 10007, i * 6007 % 10009);
  PlanarPolygon scribble;
  AddRing(scribble, ring);
  EXPECT_LE(Triangulate(scribble).size(), ring.size());
}

TEST(Triangulate, CrossedOutlineEndsAndDoesNotOverfill) {
  PlanarPolygon bow;
  AddRing(bow, {{0, 0}, {4, 4}, {4, 0}, {0, 5}});
  EXPECT_LE(Triangulate(bow).size(), 2u);
}

}  // namespace
}  // namespace ridgeline
