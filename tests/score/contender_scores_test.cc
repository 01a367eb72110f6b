// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "score/gradient_score.h"
#include "score/oriented_chamfer_score.h"
#include "score/unexplained_score.h"

namespace ridgeline {
namespace {

constexpr int kWidth = 400;
constexpr int kHeight = 300;
const PinholeCamera kCamera{kWidth, kHeight, 400.0, 400.0, 200.0, 150.0};

ProjectedSegment Edge(float x0, float y0, float x1, float y1) {
  ProjectedSegment segment;
  segment.a = {x0, y0};
  segment.b = {x1, y1};
  segment.inverse_depth_a = segment.inverse_depth_b = 0.05f;
  return segment;
}

// The outline of a house, and its edges at an offset.
const std::vector<LineSegment> kHouse = {{{100.5f, 100.5f}, {300.5f, 100.5f}, 40.0f},
                                         {{100.5f, 100.5f}, {100.5f, 250.5f}, 40.0f},
                                         {{300.5f, 100.5f}, {300.5f, 250.5f}, 40.0f}};

std::vector<ProjectedSegment> HouseEdges(float dx, float dy) {
  std::vector<ProjectedSegment> edges;
  for (const LineSegment& line : kHouse) {
    edges.push_back(Edge(line.a.x() + dx, line.a.y() + dy, line.b.x() + dx, line.b.y() + dy));
  }
  return edges;
}

// The same house as a picture: dark before a bright sky.
cv::Mat HousePicture(double sky = 200.0, double wall = 80.0) {
  cv::Mat picture(kHeight, kWidth, CV_8UC3, cv::Scalar(sky, sky, sky));
  cv::rectangle(picture, cv::Rect(100, 100, 200, 150), cv::Scalar(wall, wall, wall), cv::FILLED);
  return picture;
}

OrientedDistanceField Field(const std::vector<LineSegment>& lines) {
  return {lines, kWidth, kHeight, 1};
}

TEST(OrientedChamferScore, ExactEdgesHaveEnergyZero) {
  const OrientedDistanceField field = Field(kHouse);
  const OrientedChamferScore score(field, kCamera, {});
  EXPECT_EQ(score.EnergyOfEdges(HouseEdges(0.0f, 0.0f)), 0.0);
  EXPECT_STREQ(score.unusable(), "");
}

TEST(OrientedChamferScore, AShiftCostsItsShareOfTheLargestDistance) {
  const OrientedDistanceField field = Field({kHouse[0]});
  OrientedChamferOptions options;
  options.max_distance_width = 0.05;  // 20 px
  const OrientedChamferScore score(field, kCamera, options);
  for (const float shift : {0.0f, 3.0f, 8.0f, 15.0f, 20.0f, 40.0f}) {
    const std::vector<ProjectedSegment> edges = {Edge(120, 100.5f + shift, 280, 100.5f + shift)};
    // Distances are kept for every second pixel.
    EXPECT_NEAR(score.EnergyOfEdges(edges), std::min(1.0f, shift / 20.0f), 1.0 / 20.0 + 1e-6)
        << shift;
  }
}

TEST(OrientedChamferScore, ATurnCostsItsAngle) {
  const OrientedDistanceField field = Field({{{200.5f, 50.5f}, {200.5f, 250.5f}, 1.0f}});
  OrientedChamferOptions options;
  options.max_distance_width = 0.075;  // 30 px
  options.per_degree_width = 0.0005;   // 0.2 px a degree, 2 px a bin
  const OrientedChamferScore score(field, kCamera, options);
  // A short edge on the line, turned by 40 degrees: three to four bins.
  const Eigen::Vector2f d(2.0f * std::sin(0.7f), 2.0f * std::cos(0.7f));
  const std::vector<ProjectedSegment> edges = {
      Edge(200.5f - d.x(), 150.5f - d.y(), 200.5f + d.x(), 150.5f + d.y())};
  EXPECT_GE(score.EnergyOfEdges(edges), 3 * 2.0 / 30.0 - 1e-6);
  EXPECT_LE(score.EnergyOfEdges(edges), 4 * 2.0 / 30.0 + 1e-6);
}

TEST(OrientedChamferScore, PiecesOfAnEdgeCountAsTheWhole) {
  const OrientedDistanceField field = Field(kHouse);
  const OrientedChamferScore score(field, kCamera, {});
  const std::vector<ProjectedSegment> whole = {Edge(100, 103.5f, 300, 103.5f)};
  std::vector<ProjectedSegment> pieces;
  for (int i = 0; i < 40; ++i) pieces.push_back(Edge(100 + 5 * i, 103.5f, 105 + 5 * i, 103.5f));
  EXPECT_NEAR(score.EnergyOfEdges(pieces), score.EnergyOfEdges(whole), 1e-6);
}

TEST(OrientedChamferScore, WithoutLinesOrEdgesTheEnergyIsOne) {
  const OrientedDistanceField none = Field({});
  const OrientedChamferScore blind(none, kCamera, {});
  EXPECT_EQ(blind.EnergyOfEdges(HouseEdges(0, 0)), 1.0);
  EXPECT_STREQ(blind.unusable(), "the picture has no lines");
  const OrientedDistanceField field = Field(kHouse);
  EXPECT_EQ(OrientedChamferScore(field, kCamera, {}).EnergyOfEdges({}), 1.0);
}

TEST(GradientScore, EdgesOnTheStrongestGradientsAreNearZero) {
  const GradientScore score(HousePicture(), kCamera, {});
  EXPECT_LT(score.EnergyOfEdges(HouseEdges(-0.5f, -0.5f)), 0.05);
  // Flat parts have no gradient to be smaller than.
  EXPECT_EQ(score.EnergyOfEdges({{Edge(120, 180, 280, 180)}}), 1.0);
}

TEST(GradientScore, RisesWithTheDistance) {
  GradientScoreOptions options;
  options.sigma_width = 0.01;  // 4 px
  const GradientScore score(HousePicture(), kCamera, options);
  double last = -1.0;
  for (const float shift : {0.0f, 2.0f, 4.0f, 6.0f, 8.0f}) {
    const double energy = score.EnergyOfEdges({{Edge(130, 100 + shift, 270, 100 + shift)}});
    EXPECT_GT(energy, last);
    last = energy;
  }
}

TEST(GradientScore, AsksForTheGradientAcrossTheEdge) {
  const GradientScore score(HousePicture(), kCamera, {});
  const double along = score.EnergyOfEdges({{Edge(150, 100, 250, 100)}});
  // Short edges across the same line.
  std::vector<ProjectedSegment> across;
  for (int x = 150; x < 250; x += 10) across.push_back(Edge(x, 99.0f, x, 101.0f));
  EXPECT_GT(score.EnergyOfEdges(across), along + 0.5);
}

TEST(GradientScore, BrightnessContrastAndFormatDoNotMatter) {
  const auto edges = HouseEdges(1.0f, 1.0f);
  const double energy = GradientScore(HousePicture(), kCamera, {}).EnergyOfEdges(edges);
  // Half the contrast, 30 grey values darker, inverted.
  EXPECT_NEAR(GradientScore(HousePicture(170, 50), kCamera, {}).EnergyOfEdges(edges), energy, 0.01);
  EXPECT_NEAR(GradientScore(HousePicture(140, 80), kCamera, {}).EnergyOfEdges(edges), energy, 0.01);
  EXPECT_NEAR(GradientScore(HousePicture(80, 200), kCamera, {}).EnergyOfEdges(edges), energy, 0.01);
  cv::Mat gray;
  cv::cvtColor(HousePicture(), gray, cv::COLOR_BGR2GRAY);
  EXPECT_NEAR(GradientScore(gray, kCamera, {}).EnergyOfEdges(edges), energy, 0.01);
  cv::Mat alpha;
  cv::cvtColor(HousePicture(), alpha, cv::COLOR_BGR2BGRA);
  EXPECT_NEAR(GradientScore(alpha, kCamera, {}).EnergyOfEdges(edges), energy, 0.01);
  cv::Mat deep;
  HousePicture().convertTo(deep, CV_16U, 257.0);
  EXPECT_NEAR(GradientScore(deep, kCamera, {}).EnergyOfEdges(edges), energy, 0.01);
}

TEST(GradientScore, AFlatPictureHasEnergyOne) {
  const GradientScore score(cv::Mat::zeros(kHeight, kWidth, CV_8UC3), kCamera, {});
  EXPECT_EQ(score.EnergyOfEdges(HouseEdges(0, 0)), 1.0);
  EXPECT_STREQ(score.unusable(), "the picture has no gradients");
}

const std::vector<EdgeKind> kOutline = {EdgeKind::kSkyline};

TEST(UnexplainedScore, EdgesAndLinesThatAgreeHaveEnergyZero) {
  const OrientedDistanceField field = Field(kHouse);
  const UnexplainedScore score(kHouse, field, kCamera, {});
  EXPECT_NEAR(score.SharesOf(HouseEdges(0, 0), kOutline).Energy(), 0.0, 1e-9);
}

TEST(UnexplainedScore, SharesAreThoseOfLength) {
  const OrientedDistanceField field = Field(kHouse);
  const UnexplainedScore score(kHouse, field, kCamera, {});
  // The roof alone: its line and, within reach of it, the upper ends of the walls' lines.
  const auto roof = score.SharesOf({{Edge(100.5f, 100.5f, 300.5f, 100.5f)}}, kOutline);
  EXPECT_NEAR(roof.edges, 1.0, 1e-9);
  EXPECT_GT(roof.lines, 0.7);
  EXPECT_LT(roof.lines, 1.0);
  // All edges and as long a one where there is no line.
  auto edges = HouseEdges(0, 0);
  edges.push_back(Edge(0.5f, 20.5f, 399.5f, 20.5f));
  EXPECT_NEAR(score.SharesOf(edges, kOutline).edges, 500.0 / 899.0, 0.01);
}

TEST(UnexplainedScore, LinesBesideAnOutlineThatItDoesNotExplainCost) {
  std::vector<LineSegment> lines = kHouse;
  lines.push_back({{120.0f, 90.0f}, {135.0f, 110.0f}, 40.0f});  // across the roof's edge
  const OrientedDistanceField field = Field(lines);
  const UnexplainedScore score(lines, field, kCamera, {});
  const auto shares = score.SharesOf(HouseEdges(0, 0), kOutline);
  EXPECT_NEAR(shares.lines, 500.0 / 525.0, 1e-6);
  EXPECT_NEAR(shares.Energy(),
              1.0 - 2.0 * shares.edges * shares.lines / (shares.edges + shares.lines),
              1e-12);
  // A fold is no outline: nothing near it needs to be explained.
  EXPECT_EQ(score.SharesOf(HouseEdges(0, 0), std::vector{EdgeKind::kFold}).lines, 0.0);
}

TEST(UnexplainedScore, DoesNotFallWithTheShift) {
  const OrientedDistanceField field = Field(kHouse);
  const UnexplainedScore score(kHouse, field, kCamera, {});
  double last = 0.0;
  for (const float shift : {0.0f, 2.0f, 8.0f, 20.0f, 45.0f}) {
    const double energy = score.SharesOf(HouseEdges(shift, shift), kOutline).Energy();
    EXPECT_GE(energy, last - 1e-9);
    last = energy;
  }
  EXPECT_EQ(last, 1.0);
}

TEST(UnexplainedScore, WithoutLinesOrEdgesTheEnergyIsOne) {
  const OrientedDistanceField none = Field({});
  const UnexplainedScore blind({}, none, kCamera, {});
  EXPECT_EQ(blind.SharesOf(HouseEdges(0, 0), kOutline).Energy(), 1.0);
  EXPECT_STREQ(blind.unusable(), "the picture has no lines");
  const OrientedDistanceField field = Field(kHouse);
  EXPECT_EQ(UnexplainedScore(kHouse, field, kCamera, {}).SharesOf({}, kOutline).Energy(), 1.0);
}

}  // namespace
}  // namespace ridgeline
