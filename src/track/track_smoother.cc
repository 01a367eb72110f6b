// SPDX-License-Identifier: Apache-2.0
#include "track/track_smoother.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "base/angle.h"
#include "camera/local_frame.h"


namespace ridgeline {
namespace {

constexpr int kRounds = 3;
// Bells farther from the trajectory than this many deviations are not of it.
constexpr double kGate = 6.0;

// cam_from_world * v of a pose vector, as CamFromWorld(ViewAngles).
template <typename T>
Eigen::Matrix<T, 3, 3> RotationOf(const T* pose) {
  const T h = pose[3] * T(kRadPerDeg), p = -pose[4] * T(kRadPerDeg), r = -pose[5] * T(kRadPerDeg);
  using std::cos;
  using std::sin;
  Eigen::Matrix<T, 3, 3> level, pitch, roll;
  level << cos(h), -sin(h), T(0), T(0), T(0), T(-1), sin(h), cos(h), T(0);
  pitch << T(1), T(0), T(0), T(0), cos(p), -sin(p), T(0), sin(p), cos(p);
  roll << cos(r), -sin(r), T(0), sin(r), cos(r), T(0), T(0), T(0), T(1);
  return roll * pitch * level;
}

// Odometry between two frames: the step in the axes of the first, and the small rotation that is
// left.
struct StepResidual {
  Motion motion;
  Eigen::Matrix3d step_root;  // of the inverse covariance

  template <typename T>
  bool operator()(const T* before, const T* now, T* residual) const {
    const Eigen::Matrix<T, 3, 3> r_before = RotationOf(before), r_now = RotationOf(now);
    const Eigen::Matrix<T, 3, 1> step(now[0] - before[0], now[1] - before[1], now[2] - before[2]);
    const Eigen::Matrix<T, 3, 1> off =
        step_root.cast<T>() * (r_before * step - motion.step_in_before.cast<T>());
    const Eigen::Matrix<T, 3, 3> turn = r_now * r_before.transpose() *
                                        motion.now_from_before.toRotationMatrix().transpose().cast<T>();
    const T factor = T(0.5 / (kRadPerDeg * motion.sigma_deg));
    for (int k = 0; k < 3; ++k) residual[k] = off(k);
    residual[3] = factor * (turn(2, 1) - turn(1, 2));
    residual[4] = factor * (turn(0, 2) - turn(2, 0));
    residual[5] = factor * (turn(1, 0) - turn(0, 1));
    return true;
  }
};

struct BellResidual {
  PoseVector mean;
  PoseCovariance inverse_root;

  template <typename T>
  bool operator()(const T* pose, T* residual) const {
    Eigen::Matrix<T, 6, 1> d;
    for (int k = 0; k < 6; ++k) d(k) = pose[k] - T(mean(k));
    Eigen::Map<Eigen::Matrix<T, 6, 1>> out(residual);
    out = inverse_root.cast<T>() * d;
    return true;
  }
};

// The mean with its heading on the same turn as a trajectory's.
PoseVector OnSameTurn(PoseVector mean, const PoseVector& near) {
  mean(3) = near(3) + HeadingDifferenceDeg(mean(3), near(3));
  return mean;
}

PoseCovariance InverseRoot(const PoseCovariance& covariance) {
  const Eigen::LLT<PoseCovariance> llt(covariance);
  return llt.matrixL().solve(PoseCovariance::Identity());
}

// A motion that was measured, not guessed.
bool IsKnown(const std::optional<Motion>& motion) {
  constexpr double kGuessM = 3.0;
  return motion && motion->sigma_m < kGuessM;
}

class StretchSmoother {
 public:
  StretchSmoother(std::span<const TrackFrame> frames,
                  const Eigen::Vector3d& origin,
                  const SmootherOptions& options)
      : frames_(frames), local_{origin}, options_(options), poses_(frames.size()) {}

  // False: nothing of the stretch was tracked.
  bool Begin() {
    std::vector<bool> known(frames_.size(), false);
    bool any = false;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      if (frames_[i].state != TrackState::kTracking || !frames_[i].pose) continue;
      poses_[i] = VectorOf(local_.FromWorld(*frames_[i].pose));
      known[i] = any = true;
    }
    if (!any) return false;
    // What was not tracked follows by odometry, backward from the first that was.
    for (std::size_t i = frames_.size(); i-- > 1;) {
      if (known[i - 1] || !known[i]) continue;
      poses_[i - 1] = VectorOf(MovedBack(PoseOf(poses_[i]), *frames_[i].motion));
      known[i - 1] = true;
    }
    for (std::size_t i = 1; i < frames_.size(); ++i) {
      if (!known[i]) poses_[i] = VectorOf(Moved(PoseOf(poses_[i - 1]), *frames_[i].motion));
    }
    for (std::size_t i = 1; i < frames_.size(); ++i) {
      poses_[i] = OnSameTurn(poses_[i], poses_[i - 1]);
    }
    return true;
  }

  void Solve() {
    for (int round = 0; round < kRounds; ++round) {
      problem_ = std::make_unique<ceres::Problem>();
      AddSteps();
      AddBells(round == 0 ? 3.0 * kGate : kGate);
      ceres::Solver::Options solver;
      solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
      solver.max_num_iterations = 50;
      solver.num_threads = 1;
      solver.logging_type = ceres::SILENT;
      ceres::Solver::Summary summary;
      ceres::Solve(solver, problem_.get(), &summary);
    }
  }

  std::vector<std::optional<SmoothedPose>> Results() {
    ceres::Covariance::Options options;
    options.algorithm_type = ceres::SPARSE_QR;
    options.num_threads = 1;
    ceres::Covariance covariance(options);
    std::vector<std::pair<const double*, const double*>> blocks;
    for (const PoseVector& pose : poses_) blocks.emplace_back(pose.data(), pose.data());
    const bool is_known = covariance.Compute(blocks, problem_.get());
    std::vector<std::optional<SmoothedPose>> results;
    for (const PoseVector& pose : poses_) {
      SmoothedPose smoothed;
      smoothed.pose = local_.ToWorld(PoseOf(pose));
      Eigen::Matrix<double, 6, 6, Eigen::RowMajor> block;
      if (!is_known || !covariance.GetCovarianceBlock(pose.data(), pose.data(), block.data())) {
        results.emplace_back();
        continue;
      }
      smoothed.covariance = block;
      smoothed.covariance.diagonal().head<3>().array() += options_.floor_m * options_.floor_m;
      smoothed.covariance.diagonal().tail<3>().array() += options_.floor_deg * options_.floor_deg;
      results.emplace_back(smoothed);
    }
    return results;
  }

 private:
  static Pose MovedBack(const Pose& now, const Motion& motion) {
    Pose before;
    before.cam_from_world = motion.now_from_before.conjugate() * now.cam_from_world;
    before.center_in_world =
        now.center_in_world - before.cam_from_world.conjugate() * motion.step_in_before;
    return before;
  }

  void AddSteps() {
    for (std::size_t i = 1; i < frames_.size(); ++i) {
      Motion motion = *frames_[i].motion;
      motion.sigma_m = std::max(0.02, motion.sigma_m);
      motion.sigma_deg = std::max(0.03, motion.sigma_deg);
      const Eigen::Vector3d along = motion.scale_sigma * motion.step_in_before;
      const Eigen::Matrix3d covariance =
          motion.sigma_m * motion.sigma_m * Eigen::Matrix3d::Identity() + along * along.transpose();
      const Eigen::LLT<Eigen::Matrix3d> llt(covariance);
      auto* residual = new StepResidual{
          motion, llt.matrixL().solve(Eigen::Matrix3d::Identity())};
      problem_->AddResidualBlock(
          new ceres::AutoDiffCostFunction<StepResidual, 6, 6, 6>(residual),
          new ceres::CauchyLoss(3.0),
          poses_[i - 1].data(),
          poses_[i].data());
    }
    if (frames_.size() == 1) problem_->AddParameterBlock(poses_[0].data(), 6);
  }

  // The bell nearest to the trajectory, in its deviations and by its mass.
  void AddBells(double gate) {
    const double widen = options_.evidence_factor * options_.evidence_factor;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      const PoseBell* nearest = nullptr;
      double least = gate * gate;
      for (const PoseBell& bell : frames_[i].evidence) {
        if (bell.mass <= 0.0) continue;
        const PoseVector d = DifferenceOf(poses_[i], bell.mean);
        PoseCovariance covariance = widen * bell.covariance;
        const double cost =
            d.dot(covariance.ldlt().solve(d)) - 2.0 * std::log(std::max(1e-6, bell.mass));
        if (cost >= least) continue;
        least = cost;
        nearest = &bell;
      }
      if (nearest == nullptr) continue;
      auto* residual = new BellResidual{OnSameTurn(nearest->mean, poses_[i]),
                                        InverseRoot(widen * nearest->covariance)};
      problem_->AddResidualBlock(new ceres::AutoDiffCostFunction<BellResidual, 6, 6>(residual),
                                 new ceres::CauchyLoss(2.5),
                                 poses_[i].data());
    }
  }

  std::span<const TrackFrame> frames_;
  LocalFrame local_;
  SmootherOptions options_;
  std::vector<PoseVector> poses_;
  std::unique_ptr<ceres::Problem> problem_;
};

}  // namespace

void SmootherOptions::Visit(OptionVisitor& v) {
  v.Field("floor_m", floor_m, Positive());
  v.Field("floor_deg", floor_deg, Positive());
  v.Field("evidence_factor", evidence_factor, AtLeast(1.0));
}

std::vector<std::optional<SmoothedPose>> Smooth(std::span<const TrackFrame> frames,
                                                const Eigen::Vector3d& origin_in_world,
                                                const SmootherOptions& options) {
  std::vector<std::optional<SmoothedPose>> results(frames.size());
  for (std::size_t first = 0; first < frames.size();) {
    std::size_t end = first + 1;
    while (end < frames.size() && IsKnown(frames[end].motion)) ++end;
    StretchSmoother smoother(frames.subspan(first, end - first), origin_in_world, options);
    if (smoother.Begin()) {
      smoother.Solve();
      const auto smoothed = smoother.Results();
      std::copy(smoothed.begin(),
                smoothed.end(),
                results.begin() + static_cast<std::ptrdiff_t>(first));
    }
    first = end;
  }
  return results;
}

}  // namespace ridgeline
