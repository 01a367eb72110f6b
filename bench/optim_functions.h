// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "optim/search_box.h"

namespace ridgeline {

// A test function of the comparison with Optuna. peers/optuna_compare.py has the same ones.
struct TestFunction {
  std::string name;
  int dimensions = 2;
  double lower = 0.0;
  double upper = 1.0;
  std::function<double(std::span<const double>)> energy;

  SearchBox Box() const {
    SearchBox box;
    for (int d = 0; d < dimensions; ++d) {
      box.parameters.push_back({"x" + std::to_string(d), lower, upper});
    }
    return box;
  }
};

inline double HartmannSix(std::span<const double> x) {
  constexpr double kAlpha[4] = {1.0, 1.2, 3.0, 3.2};
  constexpr double kA[4][6] = {{10, 3, 17, 3.5, 1.7, 8},
                               {0.05, 10, 17, 0.1, 8, 14},
                               {3, 3.5, 1.7, 10, 17, 8},
                               {17, 8, 0.05, 10, 0.1, 14}};
  constexpr double kP[4][6] = {{0.1312, 0.1696, 0.5569, 0.0124, 0.8283, 0.5886},
                               {0.2329, 0.4135, 0.8307, 0.3736, 0.1004, 0.9991},
                               {0.2348, 0.1451, 0.3522, 0.2883, 0.3047, 0.6650},
                               {0.4047, 0.8828, 0.8732, 0.5743, 0.1091, 0.0381}};
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    double exponent = 0.0;
    for (int j = 0; j < 6; ++j) exponent += kA[i][j] * (x[j] - kP[i][j]) * (x[j] - kP[i][j]);
    sum -= kAlpha[i] * std::exp(-exponent);
  }
  return sum;
}

// Flat and rough with one narrow hole, as our energies are: the hole's radius is 6 % of the range.
inline double PlateauWithHole(std::span<const double> x) {
  const double hole[3] = {0.62, 0.27, 0.71};
  double square = 0.0;
  double ripple = 0.0;
  for (int d = 0; d < 3; ++d) {
    square += (x[d] - hole[d]) * (x[d] - hole[d]) / (0.06 * 0.06);
    ripple += std::sin(25.0 * x[d] + d);
  }
  return 1.0 - 0.7 * std::exp(-0.5 * square) + 0.02 * ripple;
}

inline std::vector<TestFunction> TestFunctions() {
  using Point = std::span<const double>;
  constexpr double kPi = std::numbers::pi;
  const auto sphere = [](Point x) {
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += (x[i] - 1.0) * (x[i] - 1.0);
    return sum;
  };
  const auto rosenbrock = [](Point x) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      sum += 100.0 * std::pow(x[i + 1] - x[i] * x[i], 2) + std::pow(1.0 - x[i], 2);
    }
    return sum;
  };
  const auto rastrigin = [](Point x) {
    double sum = 0.0;
    for (const double v : x) sum += v * v + 10.0 * (1.0 - std::cos(2.0 * kPi * v));
    return sum;
  };
  // On the unit square, scaled to x in [-5, 10], y in [0, 15].
  const auto branin = [](Point u) {
    const double x = 15.0 * u[0] - 5.0;
    const double y = 15.0 * u[1];
    const double a = y - 5.1 / (4.0 * kPi * kPi) * x * x + 5.0 / kPi * x - 6.0;
    return a * a + 10.0 * (1.0 - 1.0 / (8.0 * kPi)) * std::cos(x) + 10.0;
  };
  return {{"sphere", 3, -5.0, 5.0, sphere},
          {"rosenbrock", 3, -2.0, 2.0, rosenbrock},
          {"rastrigin", 3, -5.12, 5.12, rastrigin},
          {"branin", 2, 0.0, 1.0, branin},
          {"hartmann6", 6, 0.0, 1.0, HartmannSix},
          {"hole", 3, 0.0, 1.0, PlateauWithHole}};
}

}  // namespace ridgeline
