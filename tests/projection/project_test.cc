// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "projection/scene.h"

namespace ridgeline {
namespace {

const PinholeCamera kCamera{400, 300, 350.0, 360.0, 190.0, 160.0};

// Against points along each piece, projected one by one: those in the picture lie on the segment,
// and its ends are the outermost of them.
TEST(ProjectPieces, SegmentsAreThePartsOfThePiecesInThePicture) {
  Random random(3, 1);
  const auto coordinate = [&] { return 20.0f * static_cast<float>(random.Uniform() - 0.5); };
  VisibleSet visible;
  for (int i = 0; i < 203; ++i) {  // not a multiple of what is computed side by side
    VisiblePiece piece;
    piece.a = {coordinate(), coordinate(), coordinate()};
    piece.b = {coordinate(), coordinate(), coordinate()};
    visible.pieces.push_back(piece);
  }
  const Pose pose{CamFromWorld(ViewAngles{33.0, 5.0, -4.0}), {0.3, -0.2, 0.1}};
  std::vector<ProjectedSegment> segments;
  ProjectPieces(visible, kCamera, pose, segments);
  EXPECT_GT(segments.size(), 30u);
  std::vector<const ProjectedSegment*> of_piece(visible.pieces.size(), nullptr);
  for (const ProjectedSegment& segment : segments) of_piece[segment.piece] = &segment;
  for (std::size_t i = 0; i < visible.pieces.size(); ++i) {
    const Eigen::Vector3d a = visible.pieces[i].a.cast<double>();
    const Eigen::Vector3d b = visible.pieces[i].b.cast<double>();
    constexpr int kPoints = 4000;
    double first = 2.0;
    double last = -1.0;
    for (int k = 0; k <= kPoints; ++k) {
      const double t = static_cast<double>(k) / kPoints;
      const Eigen::Vector3d p = pose.cam_from_world * (a + t * (b - a) - pose.center_in_world);
      if (p.z() < 0.1) continue;
      const Eigen::Vector2d px = kCamera.ImageFromCamera(p);
      if (px.x() < 0.0 || px.y() < 0.0 || px.x() > kCamera.width || px.y() > kCamera.height) {
        continue;
      }
      first = std::min(first, t);
      last = std::max(last, t);
      ASSERT_NE(of_piece[i], nullptr);
      const Eigen::Vector2d start = of_piece[i]->a.cast<double>();
      const Eigen::Vector2d along = (of_piece[i]->b - of_piece[i]->a).cast<double>();
      const double s = (px - start).dot(along) / along.squaredNorm();
      EXPECT_LT((start + s * along - px).norm(), 0.05);
      // A point of 1 / 4000 of the piece may lie beyond what is clipped in floats.
      EXPECT_GT(s * along.norm(), -0.05);
      EXPECT_LT((s - 1.0) * along.norm(), 0.05);
      const double inverse_depth =
          (1.0 - s) * of_piece[i]->inverse_depth_a + s * of_piece[i]->inverse_depth_b;
      EXPECT_NEAR(inverse_depth * p.z(), 1.0, 0.01);
    }
    if (last - first < 0.01) continue;
    ASSERT_NE(of_piece[i], nullptr);
    const Eigen::Vector3d start =
        pose.cam_from_world * (a + first * (b - a) - pose.center_in_world);
    EXPECT_NEAR(start.z() * of_piece[i]->inverse_depth_a, 1.0, 0.05);
  }
}

TEST(ProjectPieces, WithoutPiecesThereAreNoSegments) {
  std::vector<ProjectedSegment> segments(3);
  ProjectPieces({}, kCamera, {}, segments);
  EXPECT_TRUE(segments.empty());
}

}  // namespace
}  // namespace ridgeline
