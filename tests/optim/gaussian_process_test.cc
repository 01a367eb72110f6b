// SPDX-License-Identifier: Apache-2.0
#include "optim/gaussian_process.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "optim/box_bfgs.h"
#include "optim/expected_improvement.h"
#include "optim/gp_likelihood.h"

namespace ridgeline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd SomePoints(int dimension, int count, std::uint64_t seed) {
  Random random(seed, HashText("gaussian_process_test"));
  MatrixXd points(dimension, count);
  for (double& u : points.reshaped()) u = random.Uniform();
  return points;
}

VectorXd SomeTargets(const MatrixXd& points) {
  VectorXd targets(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    targets[i] = std::sin(6.0 * points(0, i)) + points.col(i).squaredNorm();
  }
  return targets;
}

GpHyper SomeHyper(int dimension) {
  GpHyper hyper(dimension + 2);
  for (int d = 0; d < dimension; ++d) hyper[d] = -1.0 + 0.3 * d;
  hyper[dimension] = 0.2;
  hyper[dimension + 1] = -4.0;
  return hyper;
}

// Matern 5/2 as written in Rasmussen and Williams, eq. 4.17.
double Kernel(const VectorXd& a, const VectorXd& b, const GpHyper& hyper, bool periodic) {
  const Eigen::Index d = a.size();
  double square = 0.0;
  for (Eigen::Index i = 0; i < d; ++i) {
    double way = a[i] - b[i];
    if (periodic && i == 0) way = std::sin(std::numbers::pi * way) / std::numbers::pi;
    square += std::pow(way / std::exp(hyper[i]), 2);
  }
  const double r = std::sqrt(square);
  const double root5 = std::sqrt(5.0);
  return std::exp(hyper[d]) * (1.0 + root5 * r + 5.0 * r * r / 3.0) * std::exp(-root5 * r);
}

MatrixXd Covariance(const MatrixXd& points, const GpHyper& hyper, bool periodic) {
  MatrixXd k(points.cols(), points.cols());
  for (Eigen::Index i = 0; i < k.rows(); ++i) {
    for (Eigen::Index j = 0; j < k.cols(); ++j) {
      k(i, j) = Kernel(points.col(i), points.col(j), hyper, periodic);
    }
    k(i, i) += std::exp(hyper[points.rows() + 1]);
  }
  return k;
}

class GaussianProcessTest : public testing::TestWithParam<bool> {
 protected:
  const std::vector<bool> periodic_ = {GetParam(), false, false};
};

TEST_P(GaussianProcessTest, PredictionEqualsTheTextbookFormula) {
  const MatrixXd points = SomePoints(3, 20, 1);
  const VectorXd targets = SomeTargets(points);
  const GpHyper hyper = SomeHyper(3);
  GaussianProcess process(periodic_);
  process.Reset(points, hyper);
  process.SetTargets(targets);
  const MatrixXd inverse = Covariance(points, hyper, GetParam()).inverse();
  const MatrixXd queries = SomePoints(3, 5, 2);
  const auto all = process.PredictAll(queries);
  for (Eigen::Index q = 0; q < queries.cols(); ++q) {
    VectorXd k(points.cols());
    for (Eigen::Index i = 0; i < k.size(); ++i) {
      k[i] = Kernel(points.col(i), queries.col(q), hyper, GetParam());
    }
    const auto found = process.Predict(queries.col(q), nullptr, nullptr);
    EXPECT_NEAR(found.mean, k.dot(inverse * targets), 1e-9);
    EXPECT_NEAR(found.deviation, std::sqrt(std::exp(hyper[3]) - k.dot(inverse * k)), 1e-9);
    EXPECT_NEAR(all[q].mean, found.mean, 1e-12);
    EXPECT_NEAR(all[q].deviation, found.deviation, 1e-12);
  }
}

TEST_P(GaussianProcessTest, AppendedPointsEqualAFreshFactor) {
  const MatrixXd points = SomePoints(3, 90, 3);
  const VectorXd targets = SomeTargets(points);
  const GpHyper hyper = SomeHyper(3);
  GaussianProcess whole(periodic_);
  whole.Reset(points, hyper);
  whole.SetTargets(targets);
  GaussianProcess grown(periodic_);
  grown.Reset(points.leftCols(10), hyper);
  for (int i = 0; i < 5; ++i) grown.Append(points.col(50));
  grown.Shrink(10);
  for (Eigen::Index i = 10; i < points.cols(); ++i) grown.Append(points.col(i));
  grown.SetTargets(targets);
  const VectorXd query = VectorXd::Constant(3, 0.4);
  const auto a = whole.Predict(query, nullptr, nullptr);
  const auto b = grown.Predict(query, nullptr, nullptr);
  EXPECT_NEAR(a.mean, b.mean, 1e-9);
  EXPECT_NEAR(a.deviation, b.deviation, 1e-9);
}

TEST_P(GaussianProcessTest, LikelihoodIsTheNormalDensityAndItsGradientIsRight) {
  constexpr int kCount = 60;  // more than the blocks of its inverse
  const MatrixXd points = SomePoints(3, kCount, 4);
  const VectorXd targets = SomeTargets(points);
  const GpHyper hyper = SomeHyper(3);
  VectorXd gradient;
  const GpLikelihood log_likelihood(points, targets, periodic_);
  const double value = log_likelihood(hyper, &gradient);
  const MatrixXd k = Covariance(points, hyper, GetParam());
  const double expected = -0.5 * targets.dot(k.inverse() * targets) -
                          0.5 * std::log(k.determinant()) -
                          0.5 * kCount * std::log(2.0 * std::numbers::pi);
  EXPECT_NEAR(value, expected, 1e-8);
  for (Eigen::Index i = 0; i < hyper.size(); ++i) {
    constexpr double kStep = 1e-5;
    GpHyper plus = hyper;
    GpHyper minus = hyper;
    plus[i] += kStep;
    minus[i] -= kStep;
    const double slope =
        (log_likelihood(plus, nullptr) - log_likelihood(minus, nullptr)) / (2.0 * kStep);
    EXPECT_NEAR(gradient[i], slope, 1e-5 * (1.0 + std::abs(slope)));
  }
}

TEST_P(GaussianProcessTest, PredictionGradientsEqualDifferences) {
  const MatrixXd points = SomePoints(3, 20, 5);
  GaussianProcess process(periodic_);
  process.Reset(points, SomeHyper(3));
  process.SetTargets(SomeTargets(points));
  const VectorXd x = VectorXd::Constant(3, 0.37);
  VectorXd d_mean;
  VectorXd d_deviation;
  process.Predict(x, &d_mean, &d_deviation);
  for (Eigen::Index d = 0; d < 3; ++d) {
    constexpr double kStep = 1e-5;
    const VectorXd way = VectorXd::Unit(3, d) * kStep;
    const auto plus = process.Predict(x + way, nullptr, nullptr);
    const auto minus = process.Predict(x - way, nullptr, nullptr);
    EXPECT_NEAR(d_mean[d], (plus.mean - minus.mean) / (2.0 * kStep), 1e-6);
    EXPECT_NEAR(d_deviation[d], (plus.deviation - minus.deviation) / (2.0 * kStep), 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(All, GaussianProcessTest, testing::Bool(), [](const auto& test) {
  return test.param ? "Periodic" : "Linear";
});

TEST(GaussianProcess, SeamOfAPeriodicDimensionIsNoSeam) {
  const MatrixXd points = SomePoints(3, 20, 6);
  GaussianProcess process({true, false, false});
  process.Reset(points, SomeHyper(3));
  process.SetTargets(SomeTargets(points));
  const auto left = process.Predict(Eigen::Vector3d(0.0, 0.3, 0.3), nullptr, nullptr);
  const auto right = process.Predict(Eigen::Vector3d(1.0, 0.3, 0.3), nullptr, nullptr);
  EXPECT_NEAR(left.mean, right.mean, 1e-12);
  EXPECT_NEAR(left.deviation, right.deviation, 1e-12);
}

// The plain formula, where it is accurate.
TEST(LogExpectedImprovement, EqualsThePlainFormula) {
  for (const double z : {-4.0, -1.001, -0.999, 0.0, 2.0, 6.0}) {
    const double deviation = 0.7;
    const double mean = -z * deviation;  // best is 0
    const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
    const double plain = deviation * (density + z * 0.5 * std::erfc(-z / std::numbers::sqrt2));
    EXPECT_NEAR(LogExpectedImprovement(0.0, mean, deviation).value, std::log(plain), 1e-10);
  }
}

// Values of log(EI) for deviation 1, made with mpmath: log(npdf(z) + z * ncdf(z)) at 120 digits.
TEST(LogExpectedImprovement, FarTailEqualsHighPrecision) {
  EXPECT_NEAR(LogExpectedImprovement(0.0, 10.0, 1.0).value, -55.553122036122356, 1e-11);
  EXPECT_NEAR(LogExpectedImprovement(0.0, 30.0, 1.0).value, -457.72465376059800, 1e-10);
  EXPECT_NEAR(LogExpectedImprovement(0.0, 200.0, 1.0).value, -20011.515648259739, 1e-8);
}

TEST(LogExpectedImprovement, DerivativesEqualDifferences) {
  for (const double mean : {-2.0, 0.0, 1.0, 5.0, 20.0, 40.0}) {
    constexpr double kStep = 1e-6;
    const double deviation = 0.8;
    const LogImprovement at = LogExpectedImprovement(0.1, mean, deviation);
    const double by_mean = (LogExpectedImprovement(0.1, mean + kStep, deviation).value -
                            LogExpectedImprovement(0.1, mean - kStep, deviation).value) /
                           (2.0 * kStep);
    const double by_deviation = (LogExpectedImprovement(0.1, mean, deviation + kStep).value -
                                 LogExpectedImprovement(0.1, mean, deviation - kStep).value) /
                                (2.0 * kStep);
    EXPECT_NEAR(at.d_mean, by_mean, 1e-5 * (1.0 + std::abs(by_mean)));
    EXPECT_NEAR(at.d_deviation, by_deviation, 1e-5 * (1.0 + std::abs(by_deviation)));
  }
}

double RosenbrockWithGradient(const VectorXd& x, VectorXd* gradient) {
  const double a = x[1] - x[0] * x[0];
  if (gradient != nullptr) {
    *gradient = Eigen::Vector2d(-400.0 * x[0] * a - 2.0 * (1.0 - x[0]), 200.0 * a);
  }
  return 100.0 * a * a + (1.0 - x[0]) * (1.0 - x[0]);
}

TEST(MinimizeInBox, FindsTheMinimumInsideAndOnTheBorder) {
  BoxBfgsOptions options;
  options.max_iterations = 200;
  options.tolerance = 1e-12;
  const Eigen::Vector2d start(-1.2, 1.0);
  const Eigen::Vector2d lower(-2.0, -2.0);
  auto found =
      MinimizeInBox(RosenbrockWithGradient, start, lower, Eigen::Vector2d(2.0, 2.0), options);
  EXPECT_NEAR(found.x[0], 1.0, 1e-5);
  EXPECT_NEAR(found.x[1], 1.0, 1e-5);
  // With x0 <= 0.5 the valley floor x1 = x0^2 meets the border at (0.5, 0.25).
  found = MinimizeInBox(RosenbrockWithGradient, start, lower, Eigen::Vector2d(0.5, 2.0), options);
  EXPECT_NEAR(found.x[0], 0.5, 1e-9);
  EXPECT_NEAR(found.x[1], 0.25, 1e-5);
  EXPECT_NEAR(found.value, 0.25, 1e-9);
}

}  // namespace
}  // namespace ridgeline
