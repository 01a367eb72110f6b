// SPDX-License-Identifier: Apache-2.0
#include "optim/parzen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "optim/parzen_tables.h"
#include "optim/tpe.h"

namespace ridgeline {
namespace {

Columns FromRows(const std::vector<double>& rows, int dimensions) {
  Columns columns(dimensions);
  for (std::size_t i = 0; i < rows.size(); ++i) columns[i % dimensions].push_back(rows[i]);
  return columns;
}

ParzenEstimator Estimator(const ParzenCase& c, bool divide_by_deviation) {
  const Columns points = FromRows(c.points, c.dimensions);
  return ParzenEstimator(points,
                         TpeWeights(points[0].size()),
                         std::vector<bool>(c.dimensions, false),
                         {c.multivariate ? BandwidthRule::kScott : BandwidthRule::kNeighbours,
                          c.prior_weight,
                          c.magic_clip,
                          c.endpoints,
                          divide_by_deviation});
}

std::vector<double> LogDensities(const ParzenEstimator& estimator, const Columns& points) {
  std::vector<double> logs = estimator.Densities(points);
  for (double& value : logs) value = std::log(value);
  return logs;
}

TEST(ParzenEstimator, LogDensitiesEqualSciPysAndOptunas) {
  for (const ParzenCase& c : kParzenCases) {
    SCOPED_TRACE(std::to_string(c.points.size()) + " numbers, " + std::to_string(c.dimensions));
    const Columns queries = FromRows(c.queries, c.dimensions);
    const std::vector<double> divided = LogDensities(Estimator(c, true), queries);
    const std::vector<double> undivided = LogDensities(Estimator(c, false), queries);
    ASSERT_EQ(divided.size(), c.log_densities.size());
    for (std::size_t i = 0; i < divided.size(); ++i) {
      EXPECT_NEAR(divided[i], c.log_densities[i], 1e-9);
      EXPECT_NEAR(undivided[i], c.undivided[i], 1e-9);
    }
  }
}

// A sorted copy takes the same path as the sampler does.
TEST(ParzenEstimator, OrderOfPointsDoesNotMatter) {
  std::vector<double> points = {0.9, 0.1, 0.35, 0.36, 0.7};
  const ParzenOptions options;
  const Columns queries = {{0.0, 0.2, 0.355, 0.5, 1.0}};
  const std::vector<double> weights(points.size(), 1.0);
  const auto found = LogDensities(ParzenEstimator({points}, weights, {false}, options), queries);
  std::sort(points.begin(), points.end());
  const auto sorted = LogDensities(ParzenEstimator({points}, weights, {false}, options), queries);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], sorted[i], 1e-14);
}

double Integral(const ParzenEstimator& estimator) {
  constexpr int kSteps = 4000;
  Columns nodes(1);
  for (int i = 0; i < kSteps; ++i) nodes[0].push_back((i + 0.5) / kSteps);
  double sum = 0.0;
  for (const double value : estimator.Densities(nodes)) sum += value;
  return sum / kSteps;
}

TEST(ParzenEstimator, DensityIntegratesToOne) {
  const std::vector<double> points = {0.02, 0.04, 0.5, 0.97};
  const std::vector<double> weights = {0.3, 1.0, 1.0, 1.0};
  for (const bool periodic : {false, true}) {
    for (const BandwidthRule rule : {BandwidthRule::kNeighbours, BandwidthRule::kScott}) {
      ParzenOptions options;
      options.rule = rule;
      // The midpoint rule with 4000 nodes errs by about 1e-7 on these densities.
      EXPECT_NEAR(Integral(ParzenEstimator({points}, weights, {periodic}, options)), 1.0, 1e-6);
    }
  }
}

TEST(ParzenEstimator, PeriodicDensityIsContinuousAcrossTheSeam) {
  const ParzenEstimator estimator({{0.01, 0.02, 0.6}}, {1.0, 1.0, 1.0}, {true}, {});
  const auto ends = LogDensities(estimator, {{0.0, 1.0}});
  EXPECT_NEAR(ends[0], ends[1], 1e-12);
}

TEST(ParzenEstimator, PeriodicDensityTurnsWithItsPoints) {
  const std::vector<double> points = {0.05, 0.11, 0.5, 0.93};
  std::vector<double> turned;
  for (const double x : points) turned.push_back(std::fmod(x + 0.3, 1.0));
  const std::vector<double> weights(points.size(), 1.0);
  const auto before =
      LogDensities(ParzenEstimator({points}, weights, {true}, {}), {{0.0, 0.4, 0.9}});
  const auto after =
      LogDensities(ParzenEstimator({turned}, weights, {true}, {}), {{0.3, 0.7, 0.2}});
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(before[i], after[i], 1e-12);
}

TEST(ParzenEstimator, WrappedKernelEqualsTheSumOfItsImages) {
  ParzenOptions options;
  options.rule = BandwidthRule::kScott;
  const double mu = 0.9;
  const double sigma = 0.2;  // Scott's rule for one point: 0.2
  const ParzenEstimator estimator({{mu}}, {1.0}, {true}, options);
  const double x = 0.15;
  double wrapped = 0.0;
  for (int k = -50; k <= 50; ++k) {
    const double z = (x - mu + k) / std::max(sigma, 1.0 / 3.0);  // magic clip: 1 / (1 + 2)
    wrapped += std::exp(-0.5 * z * z);
  }
  wrapped /= std::sqrt(2.0 * std::numbers::pi) / 3.0;
  EXPECT_NEAR(estimator.Densities({{x}})[0], 0.5 * wrapped + 0.5, 1e-12);
}

// A joint density of linear and periodic dimensions, as the sum over kernels of the products of
// normal distributions, with as many points as do not fill the blocks of the vector code.
TEST(ParzenEstimator, JointDensityEqualsTheSumOfProducts) {
  constexpr int kPoints = 9;
  constexpr int kQueries = 53;
  Random random(4, 1);
  Columns points(3);
  Columns queries(3);
  for (std::vector<double>& column : points) {
    for (int i = 0; i < kPoints; ++i) column.push_back(random.Uniform());
  }
  for (std::vector<double>& column : queries) {
    for (int i = 0; i < kQueries; ++i) column.push_back(random.Uniform());
  }
  ParzenOptions options;
  options.rule = BandwidthRule::kScott;
  const std::vector<bool> periodic = {false, true, false};
  const ParzenEstimator estimator(points, std::vector<double>(kPoints, 1.0), periodic, options);
  const std::vector<double> found = estimator.Densities(queries);
  const double sigma = std::max(0.2 * std::pow(kPoints, -1.0 / 7.0), 1.0 / (2.0 + kPoints));
  const auto normal = [](double x, double mu, double deviation) {
    const double z = (x - mu) / deviation;
    return std::exp(-0.5 * z * z) / (deviation * std::sqrt(2.0 * std::numbers::pi));
  };
  const auto truncated = [&](double x, double mu, double deviation) {
    const double scale = 1.0 / (deviation * std::numbers::sqrt2);
    const double mass = 0.5 * (std::erf((1.0 - mu) * scale) + std::erf(mu * scale));
    return normal(x, mu, deviation) / mass;
  };
  for (int i = 0; i < kQueries; ++i) {
    double expected = truncated(queries[0][i], 0.5, 1.0) * truncated(queries[2][i], 0.5, 1.0);
    for (int k = 0; k < kPoints; ++k) {
      double wrapped = 0.0;
      for (int image = -9; image <= 9; ++image) {
        wrapped += normal(queries[1][i] + image, points[1][k], sigma);
      }
      expected += truncated(queries[0][i], points[0][k], sigma) * wrapped *
                  truncated(queries[2][i], points[2][k], sigma);
    }
    expected /= kPoints + 1.0;
    EXPECT_NEAR(found[i], expected, 1e-11 * expected);
    const double alone =
        estimator.Densities({{queries[0][i]}, {queries[1][i]}, {queries[2][i]}})[0];
    EXPECT_EQ(found[i], alone);
  }
}

// Kolmogorov-Smirnov distance of 4000 draws to the density's own distribution function.
TEST(ParzenEstimator, SamplesFollowTheDensity) {
  constexpr int kDraws = 4000;
  constexpr int kSteps = 4000;
  for (const bool periodic : {false, true}) {
    const ParzenEstimator estimator({{0.02, 0.1, 0.8}}, {1.0, 2.0, 1.0}, {periodic}, {});
    Columns nodes(1);
    for (int i = 0; i < kSteps; ++i) nodes[0].push_back((i + 0.5) / kSteps);
    std::vector<double> distribution = {0.0};
    for (const double value : estimator.Densities(nodes)) {
      distribution.push_back(distribution.back() + value / kSteps);
    }
    Random random(1, 2);
    std::vector<double> draws = estimator.Sample(random, kDraws)[0];
    std::sort(draws.begin(), draws.end());
    EXPECT_GE(draws.front(), 0.0);
    EXPECT_LE(draws.back(), 1.0);
    double distance = 0.0;
    for (int i = 0; i < kDraws; ++i) {
      const int node = std::min(kSteps, static_cast<int>(draws[i] * kSteps));
      distance = std::max(distance, std::abs((i + 0.5) / kDraws - distribution[node]));
    }
    EXPECT_LT(distance, 1.95 / std::sqrt(kDraws));  // significance 0.001
  }
}

TEST(TpeWeights, RampThenOnes) {
  EXPECT_EQ(TpeWeights(0).size(), 0u);
  EXPECT_EQ(TpeWeights(25), std::vector<double>(25, 1.0));
  const std::vector<double> weights = TpeWeights(28);
  EXPECT_DOUBLE_EQ(weights[0], 1.0 / 28.0);
  EXPECT_DOUBLE_EQ(weights[1], 0.5 * (1.0 + 1.0 / 28.0));
  for (std::size_t i = 2; i < weights.size(); ++i) EXPECT_DOUBLE_EQ(weights[i], 1.0);
}

}  // namespace
}  // namespace ridgeline
