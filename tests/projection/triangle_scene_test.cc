// SPDX-License-Identifier: Apache-2.0
#include "projection/triangle_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace ridgeline {
namespace {

using Eigen::Vector3f;

// Two right triangles at heights 5 and 8, one above the other.
TriangleScene Pair() {
  const std::vector<Vector3f> vertices = {
      {0, 0, 5}, {4, 0, 5}, {0, 4, 5}, {0, 0, 8}, {4, 0, 8}, {0, 4, 8}};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}, {3, 4, 5}};
  return TriangleScene(vertices, triangles);
}

TEST(TriangleScene, TellsWhereTheFirstTriangleIsHit) {
  const TriangleScene scene = Pair();
  const auto hit = scene.Cast({1, 2, 0}, {0, 0, 2});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->triangle, 0u);
  EXPECT_FLOAT_EQ(hit->distance, 2.5f);
  EXPECT_FLOAT_EQ(hit->u, 0.25f);
  EXPECT_FLOAT_EQ(hit->v, 0.5f);
  EXPECT_NEAR(std::abs(hit->normal.z()), 1.0f, 1e-6f);
  EXPECT_EQ(scene.Cast({1, 2, 6}, {0, 0, 1})->triangle, 1u);
  EXPECT_FALSE(scene.Cast({3, 3, 0}, {0, 0, 1}));
}

TEST(TriangleScene, IsBlockedWithinReachOnly) {
  const TriangleScene scene = Pair();
  EXPECT_TRUE(scene.IsBlocked({1, 1, 0}, {0, 0, 1}, 5.5f));
  EXPECT_FALSE(scene.IsBlocked({1, 1, 0}, {0, 0, 1}, 4.5f));
  EXPECT_FALSE(scene.IsBlocked({1, 1, 0}, {0, 0, -1}, 100.0f));
}

}  // namespace
}  // namespace ridgeline
