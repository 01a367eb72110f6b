// SPDX-License-Identifier: Apache-2.0
#include "score/line_energy.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/random.h"

namespace ridgeline {
namespace {

constexpr int kWidthPx = 1000;

// Angle at most 5 degrees, distance at most 10 px.
LineEnergyOptions Options() { return {5.0, 0.01, 0.0}; }

LineSegment Horizontal(float y, float x0 = 100.0f, float x1 = 300.0f) {
  return {{x0, y}, {x1, y}, 1.0f};
}

double EnergyOf(const std::vector<LineSegment>& picture, const std::vector<LineSegment>& model) {
  return LineEnergy(picture, kWidthPx, Options()).Energy(model);
}

TEST(LineEnergy, PerfectSceneIsZeroAndNothingIsOne) {
  const std::vector<LineSegment> scene = {Horizontal(50), {{10, 10}, {10, 90}, 1.0f}};
  EXPECT_NEAR(EnergyOf(scene, scene), 0.0, 1e-6);
  EXPECT_EQ(EnergyOf({}, scene), 1.0);
  EXPECT_EQ(EnergyOf(scene, {}), 1.0);
}

TEST(LineEnergy, AShiftCostsItsShareOfTheThreshold) {
  for (const float shift : {0.0f, 2.5f, 5.0f, 9.0f}) {
    EXPECT_NEAR(EnergyOf({Horizontal(50 + shift)}, {Horizontal(50)}), shift / 10.0, 1e-6);
  }
  EXPECT_EQ(EnergyOf({Horizontal(60.5f)}, {Horizontal(50)}), 1.0);
}

TEST(LineEnergy, CorrespondentsOfOneSegmentAreAveragedAndSegmentsToo) {
  // Distances 2 and 6: s = (0.8 + 0.4) / 2; the second model segment has none.
  const std::vector<LineSegment> picture = {Horizontal(52), Horizontal(56)};
  EXPECT_NEAR(EnergyOf(picture, {Horizontal(50), {{10, 10}, {10, 90}, 1.0f}}), 1.0 - 0.6 / 2.0,
              1e-6);
}

TEST(LineEnergy, LengthAndOverlapDoNotCount) {
  EXPECT_NEAR(EnergyOf({Horizontal(52, 700, 720)}, {Horizontal(50)}), 0.2, 1e-6);
}

TEST(LineEnergy, DirectionsWrapAtHalfATurn) {
  // 1 degree below and above the horizontal.
  const float rise = 100.0f * std::tan(1.0f * static_cast<float>(M_PI) / 180.0f);
  const LineSegment down{{100, 50 - rise}, {300, 50 + rise}, 1.0f};
  const LineSegment up{{100, 50 + rise}, {300, 50 - rise}, 1.0f};
  EXPECT_NEAR(EnergyOf({down}, {up}), 0.0, 1e-4);
  const float steep = 100.0f * std::tan(6.0f * static_cast<float>(M_PI) / 180.0f);
  EXPECT_EQ(EnergyOf({{{100, 50 - steep}, {300, 50 + steep}, 1.0f}}, {Horizontal(50)}), 1.0);
}

TEST(LineEnergy, AgreesWithTheFormulaOnRandomScenes) {
  Random random(1, HashText("LineEnergy.AgreesWithTheFormulaOnRandomScenes"));
  const auto segment = [&] {
    return LineSegment{{static_cast<float>(random.Uniform(0, 100)),
                        static_cast<float>(random.Uniform(0, 100))},
                       {static_cast<float>(random.Uniform(0, 100)),
                        static_cast<float>(random.Uniform(0, 100))},
                       1.0f};
  };
  std::vector<LineSegment> picture;
  std::vector<LineSegment> model;
  for (int i = 0; i < 60; ++i) {
    picture.push_back(segment());
    model.push_back(segment());
  }
  double sum = 0.0;
  for (const LineSegment& m : model) {
    const Eigen::Vector2d u = (m.b - m.a).cast<double>().normalized();
    double scores = 0.0;
    int count = 0;
    for (const LineSegment& p : picture) {
      const Eigen::Vector2d v = (p.b - p.a).cast<double>().normalized();
      const Eigen::Vector2d d = (0.5f * (p.a + p.b) - m.a).cast<double>();
      const double distance = std::abs(u.x() * d.y() - u.y() * d.x());
      if (std::abs(u.dot(v)) < std::cos(5.0 * M_PI / 180.0) || distance > 10.0) continue;
      scores += 1.0 - distance / 10.0;
      ++count;
    }
    if (count > 0) sum += scores / count;
  }
  EXPECT_NEAR(EnergyOf(picture, model), 1.0 - sum / 60.0, 1e-5);
}

TEST(LineEnergy, PairsAreTheCorrespondentsBehindTheEnergy) {
  const std::vector<LineSegment> picture = {Horizontal(56), Horizontal(90), Horizontal(52)};
  const std::vector<LineSegment> model = {{{10, 10}, {10, 90}, 1.0f}, Horizontal(50)};
  const LineEnergy energy(picture, kWidthPx, Options());
  const auto pairs = energy.Pairs(model);
  ASSERT_EQ(pairs.size(), 2u);
  double sum = 0.0;
  for (const LineEnergy::Pair& pair : pairs) {
    EXPECT_EQ(pair.model, 1u);
    EXPECT_NEAR(pair.score, pair.picture == 0 ? 0.4 : 0.8, 1e-6) << pair.picture;
    sum += pair.score;
  }
  EXPECT_NEAR(energy.Energy(model), 1.0 - sum / 2.0 / 2.0, 1e-6);
}

TEST(LineEnergyOptions, PixelsGoBeforeTheShareOfTheWidth) {
  LineEnergyOptions options = Options();
  EXPECT_NEAR(options.DistanceLimitPx(1000), 10.0, 1e-9);
  options.max_distance_px = 4.0;
  EXPECT_EQ(options.DistanceLimitPx(1000), 4.0);
  EXPECT_NEAR(LineEnergy(std::vector<LineSegment>{Horizontal(52)}, kWidthPx, options)
                  .Energy(std::vector<LineSegment>{Horizontal(50)}),
              0.5,
              1e-6);
}

TEST(LineEnergyOptions, BadValuesAreErrors) {
  EXPECT_THROW(CheckOptions(LineEnergyOptions{0.0, 0.01}), InputError);
  EXPECT_THROW(CheckOptions(LineEnergyOptions{5.0, 0.0}), InputError);
}

}  // namespace
}  // namespace ridgeline
