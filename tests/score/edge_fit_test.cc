// SPDX-License-Identifier: Apache-2.0
#include "score/edge_fit.h"

#include <gtest/gtest.h>

#include <numeric>

#include "base/random.h"
#include "score/position_view.h"
#include "support/synthetic_city.h"

namespace ridgeline {
namespace {

const PinholeCamera kCamera{960, 720, 800.0, 800.0, 480.0, 360.0};
const std::vector<double> kWeights = {0.1, 0.1, 0.1, 0.1, 0.1};

// Two houses side by side; the roof of the first may be raised.
CityModel Houses(double raised_m) {
  testing::House near;
  near.center = {-8.0, 25.0};
  near.length_m = 12.0;
  near.width_m = 9.0;
  near.eaves_m = 6.0 + raised_m;
  near.ridge_m = 9.0 + raised_m;
  testing::House far = near;
  far.center = {9.0, 30.0};
  far.eaves_m = 7.0;
  far.ridge_m = 10.0;
  return testing::MakeCity({near, far});
}

const Pose kPose{CamFromWorld(ViewAngles{0.0, 8.0, 0.0}), {0.0, 0.0, 1.7}};

struct View {
  explicit View(const CityModel& city) : model(city), scene(model, nullptr, {}) {
    position = ViewFrom(
        scene, kPose.center_in_world, RangeOf(kCamera, {0.0, 8.0, 0.0}, {}, 0.01), {true, false});
    ProjectPieces(position.visible, kCamera, kPose, segments);
  }
  std::vector<LineSegment> Lines() const {
    std::vector<LineSegment> lines;
    for (const ProjectedSegment& s : segments) lines.push_back({s.a, s.b});
    return lines;
  }
  std::vector<BuildingFit> FitTo(const OrientedDistanceField& field) const {
    return EdgeFit(field, kCamera, {})
        .Of(segments, position.visible, position.kinds, kWeights, scene, kPose);
  }

  const CityModel& model;
  Scene scene;
  PositionView position;
  std::vector<ProjectedSegment> segments;
};

OrientedDistanceField FieldOf(const std::vector<LineSegment>& lines) {
  return {lines, kCamera.width, kCamera.height, 1};
}

std::vector<LineSegment> Clutter(int count) {
  Random random(7, 0);
  std::vector<LineSegment> lines;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2f a(random.Uniform() * kCamera.width, random.Uniform() * kCamera.height);
    const double turn = random.Uniform() * 3.14159;
    lines.push_back({a, a + 40.0f * Eigen::Vector2f(std::cos(turn), std::sin(turn))});
  }
  return lines;
}

TEST(EdgeFit, ObservesWhatTheLineLikelihoodDoes) {
  const CityModel city = Houses(0.0);
  const View view(city);
  std::vector<LineSegment> lines = Clutter(200);
  for (const LineSegment& line : view.Lines()) lines.push_back(line);
  const OrientedDistanceField field = FieldOf(lines);
  const auto by_kind =
      LineLikelihood(field, kCamera, {}).LogRatios(view.segments, view.position.kinds);
  const double expected = 0.1 * std::accumulate(by_kind.begin(), by_kind.end(), 0.0);
  double observed = 0.0;
  for (const BuildingFit& fit : view.FitTo(field)) observed += fit.observed;
  // Its tables have half the distances.
  EXPECT_NEAR(observed, expected, 0.03 * std::abs(expected));
}

TEST(EdgeFit, EdgesWithTheirLinesAreExplained) {
  const CityModel city = Houses(0.0);
  const View view(city);
  std::vector<LineSegment> lines = Clutter(300);
  for (const LineSegment& line : view.Lines()) lines.push_back(line);
  for (const BuildingFit& fit : view.FitTo(FieldOf(lines))) {
    EXPECT_GT(fit.expected, 0.0);
    EXPECT_LT(fit.chance, 0.0);
    EXPECT_GT(fit.explained(), 0.9) << fit.building;
    EXPECT_EQ(fit.roof_shift_m, 0.0) << fit.building;
  }
}

TEST(EdgeFit, ClutterExplainsLittle) {
  const CityModel city = Houses(0.0);
  const View view(city);
  double observed = 0.0;
  double expected = 0.0;
  double chance = 0.0;
  for (const BuildingFit& fit : view.FitTo(FieldOf(Clutter(300)))) {
    observed += fit.observed;
    expected += fit.expected;
    chance += fit.chance;
  }
  EXPECT_LT((observed - chance) / (expected - chance), 0.4);
}

TEST(EdgeFit, ARaisedRoofIsFoundAndNamed) {
  const CityModel real = Houses(1.25);
  const CityModel wrong = Houses(0.0);
  std::vector<LineSegment> lines = Clutter(100);
  for (const LineSegment& line : View(real).Lines()) lines.push_back(line);
  const std::vector<BuildingFit> fits = View(wrong).FitTo(FieldOf(lines));
  ASSERT_EQ(fits.size(), 2u);
  EXPECT_NEAR(fits[0].roof_shift_m, 1.25, 0.26);
  EXPECT_GT(fits[0].roof_gain, 1.0);
  EXPECT_EQ(fits[1].roof_shift_m, 0.0);
}

}  // namespace
}  // namespace ridgeline
