// SPDX-License-Identifier: Apache-2.0
#include "projection/visibility_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

using testing::MakeCity;
using testing::TownHouses;

const Eigen::Vector3d kOrigin(60.0, 60.0, 1.6);

bool Same(const VisibleSet& a, const VisibleSet& b) {
  return a.position == b.position && a.skyline_elevation == b.skyline_elevation &&
         std::equal(a.pieces.begin(),
                    a.pieces.end(),
                    b.pieces.begin(),
                    b.pieces.end(),
                    [](const VisiblePiece& p, const VisiblePiece& q) {
                      return p.a == q.a && p.b == q.b && p.edge == q.edge && p.left == q.left &&
                             p.right == q.right;
                    });
}

TEST(VisibilityCache, GivesTheSetOfTheCellsCentre) {
  const CityModel model = MakeCity(TownHouses(3, 3, 41));
  const Scene scene(model, nullptr, {});
  VisibilityCache cache(scene, kOrigin, {0.5, 1.0}, {});
  const Eigen::Vector3d position(63.4, 58.7, 1.75);
  EXPECT_EQ(cache.CenterNear(position), Eigen::Vector3d(63.0, 59.0, 1.6));
  const auto set = cache.Near(position);
  EXPECT_TRUE(Same(*set, scene.VisibleFrom({63.0, 59.0, 1.6}, {0.5, 1.0})));
  EXPECT_EQ(cache.Near({62.6, 59.4, 1.5}), set) << "computed again";
}

TEST(VisibilityCache, StaysWithinItsMemory) {
  const CityModel model = MakeCity(TownHouses(3, 3, 42));
  const Scene scene(model, nullptr, {});
  VisibilityCacheOptions options;
  options.max_megabytes = 0.5;
  VisibilityCache cache(scene, kOrigin, {}, options);
  for (int k = 0; k < 200; ++k) {
    const auto set = cache.Near(kOrigin + Eigen::Vector3d(k % 20, k / 20, 0));
    EXPECT_FALSE(set->pieces.empty());
    EXPECT_LE(cache.memory_bytes(), 500000u);
  }
  EXPECT_GT(cache.memory_bytes(), 200000u);
}

TEST(VisibilityCache, SameSetsOnAnyNumberOfThreads) {
  const CityModel model = MakeCity(TownHouses(3, 3, 43));
  const Scene scene(model, nullptr, {});
  VisibilityCacheOptions options;
  options.max_megabytes = 0.3;  // evicts
  const auto run = [&](int threads) {
    VisibilityCache cache(scene, kOrigin, {0.0, 1.5}, options);
    std::vector<std::shared_ptr<const VisibleSet>> sets(300);
    ParallelFor(sets.size(), threads, [&](std::size_t i) {
      sets[i] = cache.Near(
          kOrigin + Eigen::Vector3d(static_cast<double>(i % 7), static_cast<double>(i % 5), 0.0));
    });
    return sets;
  };
  const auto one = run(1);
  const auto eight = run(8);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_TRUE(Same(*one[i], *eight[i])) << i;
}

// Angular length of pieces [rad], seen from a position.
double Length(const std::vector<VisiblePiece>& pieces, const Eigen::Vector3d& eye) {
  double sum = 0.0;
  for (const VisiblePiece& piece : pieces) {
    const Eigen::Vector3d a = piece.a.cast<double>() - eye;
    const Eigen::Vector3d b = piece.b.cast<double>() - eye;
    sum += std::atan2(a.cross(b).norm(), a.dot(b));
  }
  return sum;
}

// Angular length [rad] of the parts of `pieces` that `others` have too.
double CommonLength(const std::vector<VisiblePiece>& pieces,
                    const std::vector<VisiblePiece>& others,
                    const Eigen::Vector3d& eye,
                    const Scene& scene) {
  std::multimap<std::uint32_t, const VisiblePiece*> by_edge;
  for (const VisiblePiece& other : others) by_edge.emplace(other.edge, &other);
  std::vector<VisiblePiece> common;
  for (const VisiblePiece& piece : pieces) {
    const Eigen::Vector3f origin = scene.edge(piece.edge).a.cast<float>();
    const Eigen::Vector3f along =
        (scene.edge(piece.edge).b - scene.edge(piece.edge).a).normalized().cast<float>();
    const auto [begin, end] = by_edge.equal_range(piece.edge);
    for (auto it = begin; it != end; ++it) {
      const float first = std::max(along.dot(piece.a - origin), along.dot(it->second->a - origin));
      const float last = std::min(along.dot(piece.b - origin), along.dot(it->second->b - origin));
      if (first >= last) continue;
      VisiblePiece part = piece;
      part.a = origin + first * along;
      part.b = origin + last * along;
      common.push_back(part);
    }
  }
  return Length(common, eye);
}

TEST(VisibilityCache, NearestCellLosesLittleOfWhatIsVisible) {
  const CityModel model = MakeCity(TownHouses(4, 4, 44));
  const Scene scene(model, nullptr, {});
  VisibilityCache cache(scene, kOrigin, {}, {});
  Random random(1, HashText("cells"));
  double exact = 0.0;
  double cached = 0.0;
  double common = 0.0;
  for (int k = 0; k < 40; ++k) {
    const Eigen::Vector3d eye =
        kOrigin + Eigen::Vector3d(random.Uniform(-5, 5), random.Uniform(-5, 5), 0.0);
    const VisibleSet set = scene.VisibleFrom(eye, {});
    const auto near = cache.Near(eye);
    exact += Length(set.pieces, eye);
    cached += Length(near->pieces, eye);
    common += CommonLength(set.pieces, near->pieces, eye, scene);
  }
  // Cells of 1 m: the mean distance from the centre is 0.38 m.
  EXPECT_GT(common / exact, 0.97) << "of what is visible is in the cell";
  EXPECT_GT(common / cached, 0.97) << "of what the cell shows is visible";
}

TEST(VisibilityCache, ValidateNamesTheField) {
  VisibilityCacheOptions options;
  options.cell_m = 0.0;
  try {
    options.Validate();
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.field(), "visibility_cache.cell_m");
  }
}

}  // namespace
}  // namespace ridgeline
