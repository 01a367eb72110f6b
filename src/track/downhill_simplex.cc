// SPDX-License-Identifier: Apache-2.0
#include "track/downhill_simplex.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ridgeline {
namespace {

// A simplex is small when it has shrunk to this share of its first steps.
constexpr double kSmall = 0.1;

struct Corner {
  std::vector<double> point;
  double value = 0.0;
};

// One round, in the variables that have a step.
class Round {
 public:
  Round(const std::function<double(std::span<const double>)>& function,
        const SimplexSteps& steps,
        SimplexResult& best)
      : function_(function), steps_(steps), best_(best) {
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (steps[i] != 0.0) free_.push_back(i);
    }
    corners_.push_back({best.point, best.value});
    for (const std::size_t i : free_) {
      std::vector<double> point = best.point;
      point[i] += steps[i];
      corners_.push_back(Evaluated(std::move(point)));
    }
  }

  void Run(const SimplexOptions& options) {
    if (free_.empty()) return;
    while (evaluations_ < options.max_evaluations) {
      std::stable_sort(corners_.begin(), corners_.end(), [](const Corner& a, const Corner& b) {
        return a.value < b.value;
      });
      if (corners_.back().value - corners_.front().value >= options.tolerance) {
        Step();
      } else if (IsSmall()) {
        break;
      } else {
        Shrink();  // corners of a valley, as high on either side
      }
    }
    const auto least =
        std::min_element(corners_.begin(), corners_.end(), [](const Corner& a, const Corner& b) {
          return a.value < b.value;
        });
    best_.point = least->point;
    best_.value = least->value;
  }

 private:
  bool IsSmall() const {
    for (const Corner& corner : corners_) {
      for (const std::size_t i : free_) {
        const double extent = std::abs(corner.point[i] - corners_.front().point[i]);
        if (extent > kSmall * std::abs(steps_[i])) return false;
      }
    }
    return true;
  }

  Corner Evaluated(std::vector<double> point) {
    ++evaluations_;
    ++best_.evaluations;
    const double value = function_(point);
    return {std::move(point), value};
  }

  // The point on the line from the worst corner through the middle of the others, `t` times its
  // distance beyond the middle.
  Corner Beyond(double t) {
    const Corner& worst = corners_.back();
    std::vector<double> point = worst.point;
    for (const std::size_t i : free_) {
      double middle = 0.0;
      for (std::size_t k = 0; k + 1 < corners_.size(); ++k) middle += corners_[k].point[i];
      middle /= static_cast<double>(corners_.size() - 1);
      point[i] = middle + t * (middle - worst.point[i]);
    }
    return Evaluated(std::move(point));
  }

  void Step() {
    Corner& worst = corners_.back();
    const double second_worst = corners_[corners_.size() - 2].value;
    Corner reflected = Beyond(1.0);
    if (reflected.value < corners_.front().value) {
      Corner expanded = Beyond(2.0);
      worst = expanded.value < reflected.value ? std::move(expanded) : std::move(reflected);
      return;
    }
    if (reflected.value < second_worst) {
      worst = std::move(reflected);
      return;
    }
    const bool outside = reflected.value < worst.value;
    Corner contracted = Beyond(outside ? 0.5 : -0.5);
    if (contracted.value < std::min(reflected.value, worst.value)) {
      worst = std::move(contracted);
      return;
    }
    Shrink();
  }

  // Halves the distances to the best corner.
  void Shrink() {
    const std::vector<double> best = corners_.front().point;
    for (std::size_t k = 1; k < corners_.size(); ++k) {
      std::vector<double> point = corners_[k].point;
      for (const std::size_t i : free_) point[i] = 0.5 * (point[i] + best[i]);
      corners_[k] = Evaluated(std::move(point));
    }
  }

  const std::function<double(std::span<const double>)>& function_;
  const SimplexSteps& steps_;
  SimplexResult& best_;
  std::vector<std::size_t> free_;
  std::vector<Corner> corners_;
  int evaluations_ = 0;
};

}  // namespace

SimplexResult MinimizeBySimplex(const std::function<double(std::span<const double>)>& function,
                                const std::vector<double>& start,
                                const std::vector<SimplexSteps>& rounds,
                                const SimplexOptions& options) {
  SimplexResult result{start, function(start), 1};
  for (const SimplexSteps& steps : rounds) Round(function, steps, result).Run(options);
  return result;
}

}  // namespace ridgeline
