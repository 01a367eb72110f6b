// SPDX-License-Identifier: Apache-2.0
#include "localize/pose_adjustment.h"

#include <ceres/covariance.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>
#include <ceres/solver.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "base/angle.h"

namespace ridgeline {
namespace {

constexpr double kNearPlane = 0.1;  // [m]

// camera/pose.cc: cam_from_world = Roll * Pitch * Level.
Eigen::Matrix3d LevelRotation(double h) {
  Eigen::Matrix3d level;
  level << std::cos(h), -std::sin(h), 0.0, 0.0, 0.0, -1.0, std::sin(h), std::cos(h), 0.0;
  return level;
}

Eigen::Matrix3d PitchRotation(double p) {
  Eigen::Matrix3d pitch;
  pitch << 1.0, 0.0, 0.0, 0.0, std::cos(p), std::sin(p), 0.0, -std::sin(p), std::cos(p);
  return pitch;
}

Eigen::Matrix3d RollRotation(double r) {
  Eigen::Matrix3d roll;
  roll << std::cos(r), std::sin(r), 0.0, -std::sin(r), std::cos(r), 0.0, 0.0, 0.0, 1.0;
  return roll;
}

class MatchCost final : public ceres::SizedCostFunction<2, 1, 1, 1, 1, 1, 1, 1, 1> {
 public:
  MatchCost(const EdgeMatch& match, const AdjustmentFrame& frame) : match_(match), frame_(frame) {}

  bool Evaluate(const double* const* parameters,
                double* residuals,
                double** jacobians) const override {
    AdjustmentVector unknowns;
    for (int k = 0; k < kAdjustmentUnknowns; ++k) unknowns[k] = *parameters[k];
    Eigen::Vector2d r;
    Eigen::Matrix<double, 2, kAdjustmentUnknowns> jacobian;
    if (!MatchResiduals(match_, frame_, unknowns, r, jacobians ? &jacobian : nullptr)) {
      return false;
    }
    Eigen::Map<Eigen::Vector2d>(residuals, 2) = r;
    if (jacobians == nullptr) return true;
    for (int k = 0; k < kAdjustmentUnknowns; ++k) {
      if (jacobians[k] != nullptr) Eigen::Map<Eigen::Vector2d>(jacobians[k], 2) = jacobian.col(k);
    }
    return true;
  }

 private:
  const EdgeMatch& match_;
  const AdjustmentFrame& frame_;
};

class DirectionCost final : public ceres::SizedCostFunction<1, 1, 1, 1, 1, 1, 1, 1, 1> {
 public:
  DirectionCost(const DirectionMatch& match, const AdjustmentFrame& frame)
      : match_(match), frame_(frame) {}

  bool Evaluate(const double* const* parameters,
                double* residuals,
                double** jacobians) const override {
    AdjustmentVector unknowns;
    for (int k = 0; k < kAdjustmentUnknowns; ++k) unknowns[k] = *parameters[k];
    Eigen::Matrix<double, 1, kAdjustmentUnknowns> jacobian;
    residuals[0] = DirectionResidual(match_, frame_, unknowns, jacobians ? &jacobian : nullptr);
    if (jacobians == nullptr) return true;
    for (int k = 0; k < kAdjustmentUnknowns; ++k) {
      if (jacobians[k] != nullptr) jacobians[k][0] = jacobian[k];
    }
    return true;
  }

 private:
  const DirectionMatch& match_;
  const AdjustmentFrame& frame_;
};

class PriorCost final : public ceres::SizedCostFunction<1, 1> {
 public:
  PriorCost(double mean, double sigma) : mean_(mean), sigma_(sigma) {}

  bool Evaluate(const double* const* parameters,
                double* residuals,
                double** jacobians) const override {
    residuals[0] = (*parameters[0] - mean_) / sigma_;
    if (jacobians != nullptr && jacobians[0] != nullptr) jacobians[0][0] = 1.0 / sigma_;
    return true;
  }

 private:
  double mean_;
  double sigma_;
};

// Own line or one at random.
class MixtureLoss final : public ceres::LossFunction {
 public:
  MixtureLoss(double odds, double weight) : odds_(odds), weight_(weight) {}

  void Evaluate(double s, double rho[3]) const override {
    const double own = odds_ * std::exp(-0.5 * s);
    rho[0] = 2.0 * weight_ * (std::log1p(odds_) - std::log1p(own));
    rho[1] = weight_ * own / (1.0 + own);
    rho[2] = -0.5 * rho[1] / (1.0 + own);
  }

 private:
  double odds_;
  double weight_;
};

// One adjustment with its storage: Ceres keeps pointers.
class Adjuster {
 public:
  Adjuster(std::span<const EdgeMatch> matches,
           std::span<const DirectionMatch> directions,
           const AdjustmentFrame& frame,
           const AdjustmentLimits& limits,
           const AdjustmentVector& start)
      : matches_(matches), directions_(directions), frame_(frame), limits_(limits) {
    result_.unknowns = start.cwiseMax(limits.lower).cwiseMin(limits.upper);
  }

  Adjustment Run() {
    ceres::Problem problem(Unowned());
    std::deque<MixtureLoss> losses;
    for (const EdgeMatch& match : matches_) {
      Add(problem, &costs_.emplace_back(match, frame_),
          &losses.emplace_back(match.odds, match.weight));
    }
    for (const DirectionMatch& match : directions_) {
      Add(problem, &direction_costs_.emplace_back(match, frame_),
          &losses.emplace_back(match.odds, match.weight));
    }
    AddPriors(problem);
    if (problem.NumResidualBlocks() == 0 || free_.empty()) return result_;
    SetLimits(problem);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.max_num_iterations = 20;
    options.function_tolerance = 1e-9;
    options.parameter_tolerance = 1e-10;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    result_.cost = 2.0 * summary.final_cost;
    EstimateCovariance();
    return result_;
  }

 private:
  static ceres::Problem::Options Unowned() {
    ceres::Problem::Options options;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  void Add(ceres::Problem& problem, ceres::CostFunction* cost, ceres::LossFunction* loss) {
    double* x = result_.unknowns.data();
    problem.AddResidualBlock(cost, loss, x, x + 1, x + 2, x + 3, x + 4, x + 5, x + 6, x + 7);
  }

  void AddPriors(ceres::Problem& problem) {
    free_.clear();
    for (int k = 0; k < kAdjustmentUnknowns; ++k) {
      double* x = result_.unknowns.data() + k;
      problem.AddParameterBlock(x, 1);
      if (!limits_.IsFree(k)) {
        problem.SetParameterBlockConstant(x);
        continue;
      }
      free_.push_back(x);
      if (limits_.prior_sigma[k] > 0.0) {
        problem.AddResidualBlock(
            &priors_.emplace_back(limits_.prior_mean[k], limits_.prior_sigma[k]), nullptr, x);
      }
    }
  }

  void SetLimits(ceres::Problem& problem) {
    for (double* x : free_) {
      const auto k = x - result_.unknowns.data();
      problem.SetParameterLowerBound(x, 0, limits_.lower[k]);
      problem.SetParameterUpperBound(x, 0, limits_.upper[k]);
    }
  }

  // At the solution every match has a fixed weight: the probability that its line is its own.
  void EstimateCovariance() {
    std::vector<double> weights;
    double sum = 0.0;
    for (const EdgeMatch& match : matches_) {
      Eigen::Vector2d r;
      if (!MatchResiduals(match, frame_, result_.unknowns, r, nullptr)) {
        weights.push_back(0.0);
        continue;
      }
      double rho[3];
      MixtureLoss(match.odds, match.weight).Evaluate(r.squaredNorm(), rho);
      weights.push_back(rho[1]);
      sum += rho[1] * r.squaredNorm();
      result_.observations += rho[1];
    }
    // Two residuals a match, less the unknowns; with few left over the expected deviation stands.
    constexpr double kMinRedundancy = 4.0;
    const double redundancy = 2.0 * result_.observations - static_cast<double>(free_.size());
    if (redundancy >= kMinRedundancy) result_.sigma0 = std::sqrt(sum / redundancy);
    const double scale = std::max(1.0, result_.sigma0);

    ceres::Problem problem(Unowned());
    std::deque<ceres::ScaledLoss> losses;
    for (std::size_t i = 0; i < matches_.size(); ++i) {
      if (weights[i] <= 0.0) continue;
      Add(problem, &costs_[i],
          &losses.emplace_back(nullptr,
                               weights[i] * matches_[i].information / matches_[i].weight /
                                   (scale * scale),
                               ceres::TAKE_OWNERSHIP));
    }
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      const double r = DirectionResidual(directions_[i], frame_, result_.unknowns, nullptr);
      double rho[3];
      MixtureLoss(directions_[i].odds, directions_[i].weight).Evaluate(r * r, rho);
      if (rho[1] <= 0.0) continue;
      Add(problem, &direction_costs_[i],
          &losses.emplace_back(nullptr, rho[1] / (scale * scale), ceres::TAKE_OWNERSHIP));
    }
    AddPriors(problem);
    ceres::Covariance::Options options;
    options.algorithm_type = ceres::DENSE_SVD;
    options.null_space_rank = -1;  // directions without any information get no covariance
    ceres::Covariance covariance(options);
    std::vector<const double*> blocks(free_.begin(), free_.end());
    if (!covariance.Compute(blocks, &problem)) return;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> dense(free_.size(),
                                                                               free_.size());
    if (!covariance.GetCovarianceMatrix(blocks, dense.data())) return;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      for (std::size_t j = 0; j < free_.size(); ++j) {
        result_.covariance(free_[i] - result_.unknowns.data(),
                           free_[j] - result_.unknowns.data()) = dense(i, j);
      }
    }
  }

  std::span<const EdgeMatch> matches_;
  std::span<const DirectionMatch> directions_;
  const AdjustmentFrame& frame_;
  const AdjustmentLimits& limits_;
  Adjustment result_;
  std::vector<double*> free_;
  std::deque<MatchCost> costs_;
  std::deque<DirectionCost> direction_costs_;
  std::deque<PriorCost> priors_;
};

}  // namespace

Pose AdjustmentFrame::PoseAt(const AdjustmentVector& x) const {
  const double rise = slope.x() * x[kEast] + slope.y() * x[kNorth];
  return {CamFromWorld(ViewAngles{angles.heading_deg + x[kHeading],
                                  angles.pitch_deg + x[kPitch],
                                  angles.roll_deg + x[kRoll]}),
          center + Eigen::Vector3d(x[kEast], x[kNorth], x[kHeight] + rise)};
}

PinholeCamera AdjustmentFrame::CameraAt(const AdjustmentVector& x) const {
  PinholeCamera scaled = camera;
  scaled.fx *= 1.0 + 0.01 * x[kFocalPercent];
  scaled.fy *= 1.0 + 0.01 * x[kFocalPercent];
  return scaled;
}

bool MatchResiduals(const EdgeMatch& match,
                    const AdjustmentFrame& frame,
                    const AdjustmentVector& x,
                    Eigen::Vector2d& residuals,
                    Eigen::Matrix<double, 2, kAdjustmentUnknowns>* jacobian) {
  const double h = (frame.angles.heading_deg + x[kHeading]) * kRadPerDeg;
  const double p = (frame.angles.pitch_deg + x[kPitch]) * kRadPerDeg;
  const double r = (frame.angles.roll_deg + x[kRoll]) * kRadPerDeg;
  const Eigen::Matrix3d level = LevelRotation(h);
  const Eigen::Matrix3d pitch = PitchRotation(p);
  const Eigen::Matrix3d roll = RollRotation(r);
  const Eigen::Matrix3d tilt = roll * pitch;
  const Eigen::Matrix3d rotation = tilt * level;
  const Eigen::Vector3d center =
      frame.center +
      Eigen::Vector3d(x[kEast],
                      x[kNorth],
                      x[kHeight] + frame.slope.x() * x[kEast] + frame.slope.y() * x[kNorth]);
  const PinholeCamera camera = frame.CameraAt(x);
  for (int end = 0; end < 2; ++end) {
    const Eigen::Vector3d point = (end == 0 ? match.a : match.b) + x[kOverhang] * match.overhang;
    const double sigma_px = end == 0 ? match.sigma_a_px : match.sigma_b_px;
    const Eigen::Vector3d u = level * (point - center);
    const Eigen::Vector3d w = pitch * u;
    const Eigen::Vector3d c = roll * w;
    if (c.z() < kNearPlane) return false;
    const Eigen::Vector2d image = camera.ImageFromCamera(c);
    residuals[end] = (match.normal.dot(image) - match.offset_px) / sigma_px;
    if (jacobian == nullptr) continue;
    const Eigen::Vector2d n(match.normal.x() * camera.fx, match.normal.y() * camera.fy);
    const Eigen::RowVector3d by_camera =
        Eigen::RowVector3d(n.x(), n.y(), -n.dot(c.head<2>()) / c.z()) / (c.z() * sigma_px);
    const Eigen::RowVector3d by_center = -by_camera * rotation;
    auto row = jacobian->row(end);
    row[kEast] = by_center.x() + frame.slope.x() * by_center.z();
    row[kNorth] = by_center.y() + frame.slope.y() * by_center.z();
    row[kHeight] = by_center.z();
    row[kHeading] = kRadPerDeg * by_camera.dot(tilt * Eigen::Vector3d(-u.z(), 0.0, u.x()));
    row[kPitch] = kRadPerDeg * by_camera.dot(roll * Eigen::Vector3d(0.0, w.z(), -w.y()));
    row[kRoll] = kRadPerDeg * by_camera.dot(Eigen::Vector3d(c.y(), -c.x(), 0.0));
    row[kFocalPercent] = 0.01 *
                         (match.normal.x() * frame.camera.fx * c.x() +
                          match.normal.y() * frame.camera.fy * c.y()) /
                         (c.z() * sigma_px);
    row[kOverhang] = by_camera.dot(rotation * match.overhang);
  }
  return true;
}

double DirectionResidual(const DirectionMatch& match,
                         const AdjustmentFrame& frame,
                         const AdjustmentVector& x,
                         Eigen::Matrix<double, 1, kAdjustmentUnknowns>* jacobian) {
  const double h = (frame.angles.heading_deg + x[kHeading]) * kRadPerDeg;
  const double p = (frame.angles.pitch_deg + x[kPitch]) * kRadPerDeg;
  const double r = (frame.angles.roll_deg + x[kRoll]) * kRadPerDeg;
  const Eigen::Matrix3d level = LevelRotation(h);
  const Eigen::Matrix3d pitch = PitchRotation(p);
  const Eigen::Matrix3d roll = RollRotation(r);
  const PinholeCamera camera = frame.CameraAt(x);
  const Eigen::Vector2d middle = (0.5f * (match.line.a + match.line.b)).cast<double>();
  const Eigen::Vector2d line = (match.line.b - match.line.a).cast<double>().normalized();
  const Eigen::Vector3d u = level * match.direction;
  const Eigen::Vector3d w = pitch * u;
  const Eigen::Vector3d c = roll * w;
  // Along the image of the direction, scaled by the focal length.
  const Eigen::Vector2d center(camera.cx, camera.cy);
  const Eigen::Vector2d image =
      Eigen::Vector2d(camera.fx * c.x(), camera.fy * c.y()) - (middle - center) * c.z();
  const double norm = image.norm();
  constexpr double kNoDirection = 1e-9;  // the middle is the vanishing point
  if (jacobian != nullptr) jacobian->setZero();
  if (norm < kNoDirection) return 0.0;
  const double sine = (image.x() * line.y() - image.y() * line.x()) / norm;
  if (jacobian == nullptr) return sine / match.sigma_rad;
  const Eigen::RowVector2d by_image =
      (Eigen::RowVector2d(line.y(), -line.x()) - sine * image.transpose() / norm) /
      (norm * match.sigma_rad);
  const auto by_turn = [&](const Eigen::Vector3d& d) {
    const Eigen::Vector2d moved(camera.fx * d.x() - (middle - center).x() * d.z(),
                                camera.fy * d.y() - (middle - center).y() * d.z());
    return by_image.dot(moved);
  };
  (*jacobian)[kHeading] = kRadPerDeg * by_turn(roll * pitch * Eigen::Vector3d(-u.z(), 0.0, u.x()));
  (*jacobian)[kPitch] = kRadPerDeg * by_turn(roll * Eigen::Vector3d(0.0, w.z(), -w.y()));
  (*jacobian)[kRoll] = kRadPerDeg * by_turn(Eigen::Vector3d(c.y(), -c.x(), 0.0));
  const Eigen::Vector2d by_focal(frame.camera.fx * c.x(), frame.camera.fy * c.y());
  (*jacobian)[kFocalPercent] = 0.01 * by_image.dot(by_focal);
  return sine / match.sigma_rad;
}

Adjustment AdjustPose(std::span<const EdgeMatch> matches,
                      std::span<const DirectionMatch> directions,
                      const AdjustmentFrame& frame,
                      const AdjustmentLimits& limits,
                      const AdjustmentVector& start) {
  return Adjuster(matches, directions, frame, limits, start).Run();
}

}  // namespace ridgeline
