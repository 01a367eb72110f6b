// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "base/random.h"
#include "city/read_city.h"
#include "projection/scene.h"
#include "support/source_folder.h"
#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

using testing::House;
using testing::MakeCity;
using testing::TownHouses;

// Whether a triangle hides a point from the eye: the point lies deeper than the tolerance behind
// the triangle's plane, and the line of sight crosses the triangle. In doubles, one triangle after
// the other. `margin` [m] grows (> 0) or shrinks the triangle, to leave out undecidable points.
bool Hides(const CityModel& model,
           const Triangle& triangle,
           const Eigen::Vector3d& eye,
           const Eigen::Vector3d& point,
           double tolerance,
           double margin) {
  const Eigen::Vector3d& a = model.vertices[triangle.vertices[0]];
  const Eigen::Vector3d& b = model.vertices[triangle.vertices[1]];
  const Eigen::Vector3d& c = model.vertices[triangle.vertices[2]];
  Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
  double height = normal.dot(a - eye);
  if (height < 0.0) {
    normal = -normal;
    height = -height;
  }
  const double depth = normal.dot(point - eye);
  if (depth <= height + tolerance - margin) return false;
  const Eigen::Vector3d hit = eye + (point - eye) * (height / depth);
  // Distances from the sides, positive inside.
  const double turn = (b - a).cross(c - a).dot(normal) > 0 ? 1.0 : -1.0;
  const auto inside = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    return turn * (q - p).normalized().cross(hit - p).dot(normal);
  };
  return std::min({inside(a, b), inside(b, c), inside(c, a)}) > -margin;
}

bool IsHidden(const CityModel& model,
              const Eigen::Vector3d& eye,
              const Eigen::Vector3d& point,
              double tolerance,
              double margin) {
  return std::any_of(model.triangles.begin(), model.triangles.end(), [&](const Triangle& triangle) {
    return Hides(model, triangle, eye, point, tolerance, margin);
  });
}

bool LooksAway(const CityModel& model,
               std::uint32_t surface,
               const FeatureEdge& edge,
               const Eigen::Vector3d& eye) {
  return surface != kNoSurface &&
         model.surfaces[surface].normal.cast<double>().dot(eye - edge.a) < 0.0;
}

struct Comparison {
  int points = 0;
  int wrong = 0;
};

// Compares the pieces with the brute force at points along every `step`-th feature edge in reach.
Comparison Compare(const Scene& scene, const Eigen::Vector3d& eye, Random& random, int step = 1) {
  const CityModel& model = scene.model();
  const VisibleSet visible = scene.VisibleFrom(eye, {});
  std::multimap<std::uint32_t, const VisiblePiece*> pieces;
  for (const VisiblePiece& piece : visible.pieces) pieces.emplace(piece.edge, &piece);
  Comparison result;
  for (std::uint32_t e = 0; e < model.feature_edges.size(); e += static_cast<unsigned>(step)) {
    const FeatureEdge& edge = model.feature_edges[e];
    if ((edge.a - eye).norm() > scene.options().max_distance_m) continue;
    if ((edge.a - edge.b).norm() < 1e-3) continue;  // not looked at
    // Of a closed shell that crosses itself the inside can be seen; it does not count.
    if (LooksAway(model, edge.surface0, edge, eye) && LooksAway(model, edge.surface1, edge, eye)) {
      continue;
    }
    const Eigen::Vector3d along = (edge.b - edge.a).normalized();
    for (int k = 0; k < 5; ++k) {
      const Eigen::Vector3d point = edge.a + random.Uniform(0.02, 0.98) * (edge.b - edge.a);
      const double tolerance = scene.options().surface_tolerance_m;
      // Undecidable within a millimetre.
      const bool hidden = IsHidden(model, eye, point, tolerance, -1e-3);
      if (hidden != IsHidden(model, eye, point, tolerance, 1e-3)) continue;
      const auto [begin, end] = pieces.equal_range(e);
      const bool seen = std::any_of(begin, end, [&](const auto& entry) {
        const double at = along.dot(point - edge.a);
        const double first = along.dot(entry.second->a.template cast<double>() - edge.a);
        const double last = along.dot(entry.second->b.template cast<double>() - edge.a);
        return at > first && at < last;
      });
      ++result.points;
      if (seen == hidden) ++result.wrong;
    }
  }
  return result;
}

ProjectionOptions ExactOptions() {
  ProjectionOptions options;
  options.min_piece_mrad = 0.0;
  options.max_distance_m = 1e4;
  return options;
}

TEST(VisibleFrom, AgreesWithBruteForceInTheStreet) {
  const CityModel model = MakeCity(TownHouses(3, 3, 7));
  const Scene scene(model, nullptr, ExactOptions());
  Random random(1, HashText("street"));
  int points = 0;
  for (int k = 0; k < 6; ++k) {
    const Eigen::Vector3d eye(random.Uniform(0, 180),
                              60.0 * static_cast<double>(random.Below(4)),
                              random.Uniform(1.0, 3.0));
    const Comparison result = Compare(scene, eye, random);
    EXPECT_EQ(result.wrong, 0) << "of " << result.points << " from " << eye.transpose();
    points += result.points;
  }
  EXPECT_GT(points, 5000);
}

TEST(VisibleFrom, AgreesWithBruteForceFromAbove) {
  const CityModel model = MakeCity(TownHouses(3, 3, 8));
  const Scene scene(model, nullptr, ExactOptions());
  Random random(1, HashText("above"));
  for (int k = 0; k < 5; ++k) {
    const Eigen::Vector3d eye(
        random.Uniform(0, 180), random.Uniform(0, 180), random.Uniform(20.0, 100.0));
    const Comparison result = Compare(scene, eye, random);
    EXPECT_EQ(result.wrong, 0) << "of " << result.points << " from " << eye.transpose();
  }
}

// A tenth of a pixel at f = 1000 px inside of a piece's end the edge is visible, and as far outside
// it is hidden, by brute force.
void ExpectExactEnds(const Scene& scene, const VisibleSet& visible, std::size_t step) {
  const CityModel& model = scene.model();
  const Eigen::Vector3d& eye = visible.position;
  const double tolerance = scene.options().surface_tolerance_m;
  int ends = 0;
  for (std::size_t i = 0; i < visible.pieces.size(); i += step) {
    const VisiblePiece& piece = visible.pieces[i];
    const FeatureEdge& edge = scene.edge(piece.edge);
    for (const auto& [end, other] : {std::pair(piece.a, piece.b), std::pair(piece.b, piece.a)}) {
      const Eigen::Vector3d point = end.cast<double>();
      const Eigen::Vector3d outwards = (end - other).cast<double>().normalized();
      const double to_end = std::min((point - edge.a).norm(), (point - edge.b).norm());
      // 0.1 mrad across the line of sight.
      const double across = outwards.cross(point - eye).norm() / (point - eye).norm();
      const double shift = 1e-4 * (point - eye).norm() / across;
      if (to_end < shift || (end - other).norm() < 2.0 * shift) continue;
      EXPECT_FALSE(IsHidden(model, eye, point - shift * outwards, tolerance, 0.0))
          << "inside the end of piece " << i;
      EXPECT_TRUE(IsHidden(model, eye, point + shift * outwards, tolerance, 0.0))
          << "outside the end of piece " << i;
      ++ends;
    }
  }
  EXPECT_GT(ends, 5);
}

TEST(VisibleFrom, EndsAreExactToATenthOfAPixel) {
  const CityModel model = MakeCity(TownHouses(3, 3, 9));
  const Scene scene(model, nullptr, {});
  for (const Eigen::Vector3d& eye :
       {Eigen::Vector3d(60, 60, 2), Eigen::Vector3d(20, 121, 3), Eigen::Vector3d(90, 30, 60)}) {
    ExpectExactEnds(scene, scene.VisibleFrom(eye, {}), 1);
  }
}

TEST(VisibleFrom, AgreesWithBruteForceInMunich) {
  const std::filesystem::path folder = std::string(kSourceFolder) + "/../shared/data/munich";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  const CityModel model =
      ReadCity({folder / "tum_campus_lod2.gml", folder / "tum_south_lod2.gml"}, {});
  ProjectionOptions options;
  options.min_piece_mrad = 0.0;
  options.max_distance_m = 200.0;
  const Scene scene(model, nullptr, options);
  Random random(1, HashText("munich"));
  for (const Eigen::Vector3d& in_world :
       {Eigen::Vector3d(690894.1, 5335941.8, 517.4), Eigen::Vector3d(690935.0, 5335918.0, 560.0)}) {
    const Eigen::Vector3d eye = in_world - model.origin_in_world;
    const Comparison result = Compare(scene, eye, random, 40);
    EXPECT_GT(result.points, 300);
    EXPECT_EQ(result.wrong, 0) << "of " << result.points;
    ExpectExactEnds(scene, scene.VisibleFrom(eye, {}), 8);
  }
}

}  // namespace
}  // namespace ridgeline
