// SPDX-License-Identifier: Apache-2.0
#include "track/pose_filter.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "track/bell_mixture.h"

namespace ridgeline {
namespace {

constexpr double kLogTwoPi = 1.8378770664093453;
constexpr double kNothing = -std::numeric_limits<double>::infinity();
constexpr double kAcceptedRisk = 1e-3;
// Poses this near the main one are one answer.
constexpr double kAnswerM = 2.0;
constexpr double kAnswerDeg = 3.0;

double LogSum(double a, double b) {
  const double high = std::max(a, b);
  return high == kNothing ? kNothing : high + std::log(std::exp(a - high) + std::exp(b - high));
}

// First width of the proposals around a mode that the search has refined.
PoseCovariance ModeCovariance() {
  PoseVector sigmas;
  sigmas << 0.35, 0.35, 0.25, 0.7, 0.5, 0.5;
  return sigmas.cwiseAbs2().asDiagonal();
}

// Exponents of the likelihood after each round: the first fits are broad.
double TemperAfter(int round, int rounds) {
  return round + 1 == rounds ? 1.0 : std::pow(0.35, rounds - 1 - round);
}

double EffectiveOf(const std::vector<double>& weights) {
  double squares = 0.0;
  for (const double w : weights) squares += w * w;
  return squares > 0.0 ? 1.0 / squares : 0.0;
}

std::vector<double> Normalized(const std::vector<double>& log_weights) {
  const double highest = *std::max_element(log_weights.begin(), log_weights.end());
  std::vector<double> weights(log_weights.size(), 1.0 / static_cast<double>(log_weights.size()));
  if (highest == kNothing) return weights;
  double total = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    total += weights[i] = std::exp(log_weights[i] - highest);
  }
  for (double& w : weights) w /= total;
  return weights;
}

}  // namespace

void PoseFilterOptions::Visit(OptionVisitor& v) {
  v.Field("particles", particles, Closed(20, 20000));
  v.Field("samples", samples, Closed(50, 20000));
  v.Field("rounds", rounds, Closed(1, 10));
  v.Field("temperature", temperature, AtLeast(1.0));
  v.Field("lie_share", lie_share, Open(0.0, 1.0));
  v.Field("elsewhere_share", elsewhere_share, RightOpen(0.0, 1.0));
  v.Field("floor_m", floor_m, Positive());
  v.Field("floor_deg", floor_deg, Positive());
}

double PoseRegion::LogDensity(const PoseVector& v) const {
  const Eigen::Vector2d d = v.head<2>() - center;
  if (std::abs(d.x()) > half_m || std::abs(d.y()) > half_m) return kNothing;
  if (std::abs(HeadingDifferenceDeg(v(3), heading_deg)) > heading_half_deg) return kNothing;
  const double up = (v(2) - height_at(v.head<2>())) / height_sigma_m;
  const double tilt_square = (std::pow(v(4) - pitch_deg, 2) + std::pow(v(5) - roll_deg, 2)) /
                             (tilt_scale_deg * tilt_scale_deg);
  return -std::log(4.0 * half_m * half_m) - std::log(2.0 * heading_half_deg) -
         0.5 * (up * up + kLogTwoPi) - std::log(height_sigma_m) - 1.5 * std::log1p(tilt_square) -
         std::log(2.0 * std::numbers::pi * tilt_scale_deg * tilt_scale_deg);
}

// The poses tried in an update, and what is known of them.
struct PoseFilter::Samples {
  std::vector<PoseVector> poses;
  std::vector<double> log_ratios;
  std::vector<double> log_bells;      // density of the particles' predictions
  std::vector<double> log_predicted;  // the same; without particles: of the region
  std::vector<double> log_known;  // prediction, elsewhere and what else is known
  // Proposals so far: number of poses drawn, share of the prediction, mixture of the rest.
  struct Round {
    double count = 0.0;
    double predicted_share = 0.0;
    BellMixture mixture;
  };
  std::vector<Round> rounds;
  bool has_picture = true;
  double highest = kNothing;
  double log_match = 0.0;  // LogMatch() of the samples so far

  std::size_t size() const { return poses.size(); }

  double LogHonest(std::size_t i, const PoseFilterOptions& options) const {
    return (log_ratios[i] - highest) / options.temperature;
  }
  double LogLikelihood(std::size_t i, const PoseFilterOptions& options) const {
    if (!has_picture) return 0.0;
    return LogSum(std::log1p(-options.lie_share) + LogHonest(i, options),
                  std::log(options.lie_share) + log_match);
  }
  // What an honest picture's likelihood is on average where the prediction puts the camera, if the
  // prediction is right: the volume of the likelihood times the prediction's mean density, at most
  // 1. A picture that says nothing is as likely as that, so that a wide prediction, in which even an
  // honest picture fits nearly nowhere, is no reason to disbelieve it.
  double LogMatch(const PoseFilterOptions& options) const {
    double volume = 0.0, weights = 0.0, density = 0.0;
    for (std::size_t i = 0; i < size(); ++i) {
      const double predicted = std::exp(log_predicted[i]);
      const double proposed = std::exp(LogProposed(i));
      volume += std::exp(LogHonest(i, options)) / proposed / static_cast<double>(size());
      weights += predicted / proposed;
      density += predicted * predicted / proposed;
    }
    if (weights <= 0.0) return 0.0;
    const double match = volume * density / weights;
    return std::log(match / (1.0 + match));
  }
  double LogProposed(std::size_t i) const {
    double density = 0.0;
    double count = 0.0;
    for (const Round& round : rounds) {
      density += round.count * (round.predicted_share * std::exp(log_bells[i]) +
                                (1.0 - round.predicted_share) * round.mixture.Density(poses[i]));
      count += round.count;
    }
    return std::log(density / count);
  }
  // With `known`: posterior weights, else those of the picture alone.
  std::vector<double> Weights(const PoseFilterOptions& options, double temper, bool known) const {
    std::vector<double> log_weights(size());
    for (std::size_t i = 0; i < size(); ++i) {
      log_weights[i] = (known ? log_known[i] : 0.0) + temper * LogLikelihood(i, options) -
                       LogProposed(i);
    }
    return Normalized(log_weights);
  }
};

PoseFilter::PoseFilter(const PoseFilterOptions& options) : options_(options) {}

void PoseFilter::Start(const PoseRegion& region) {
  region_ = region;
  updated_.clear();
  poses_.clear();
  weights_.clear();
  bells_.clear();
}

void PoseFilter::Predict(const Motion& motion) {
  since_update_ = Composed(since_update_, motion);
  MoveBells();
}

void PoseFilter::MoveBells() {
  const Motion& motion = since_update_;
  bells_.clear();
  const double length = motion.step_in_before.norm();
  for (std::size_t i = 0; i < updated_.size(); ++i) {
    const Pose moved = Moved(PoseOf(updated_[i]), motion);
    StepBell bell;
    const Eigen::Vector2d step = moved.center_in_world.head<2>() - updated_[i].head<2>();
    if (step.norm() > 0.0) bell.along = step.normalized();
    poses_[i] = VectorOf(moved);
    bell.mean = poses_[i];
    bell.weight = weights_[i];
    bell.sigma_m = std::max(options_.floor_m, motion.sigma_m);
    bell.sigma_along_m = std::hypot(bell.sigma_m, motion.scale_sigma * length);
    bell.sigma_deg = std::max(options_.floor_deg, motion.sigma_deg);
    bells_.push_back(bell);
  }
}

double PoseFilter::LogPredicted(const PoseVector& v) const {
  constexpr double kFar = 60.0;  // exponents below -kFar / 2 add nothing
  double density = 0.0;
  for (const StepBell& bell : bells_) {
    const Eigen::Vector2d d = v.head<2>() - bell.mean.head<2>();
    const double along = d.dot(bell.along) / bell.sigma_along_m;
    const double inverse_m = 1.0 / bell.sigma_m;
    const double aside = (d.x() * bell.along.y() - d.y() * bell.along.x()) * inverse_m;
    const double up = (v(2) - bell.mean(2)) * inverse_m;
    double exponent = along * along + aside * aside + up * up;
    if (exponent > kFar) continue;
    const double inverse_deg = 1.0 / bell.sigma_deg;
    const double heading = HeadingDifferenceDeg(v(3), bell.mean(3)) * inverse_deg;
    const double pitch = (v(4) - bell.mean(4)) * inverse_deg;
    const double roll = (v(5) - bell.mean(5)) * inverse_deg;
    exponent += heading * heading + pitch * pitch + roll * roll;
    if (exponent > kFar) continue;
    density += bell.weight * std::exp(-0.5 * exponent) * inverse_m * inverse_m /
               bell.sigma_along_m * inverse_deg * inverse_deg * inverse_deg;
  }
  return std::log(density) - 3.0 * kLogTwoPi;
}

PoseVector PoseFilter::DrawPredicted(Random& random) const {
  double left = random.Uniform();
  std::size_t i = 0;
  while (i + 1 < bells_.size() && left > bells_[i].weight) left -= bells_[i++].weight;
  const StepBell& bell = bells_[i];
  PoseVector v = bell.mean;
  const double along = bell.sigma_along_m * random.Normal();
  const double aside = bell.sigma_m * random.Normal();
  v.head<2>() += along * bell.along + aside * Eigen::Vector2d(bell.along.y(), -bell.along.x());
  v(2) += bell.sigma_m * random.Normal();
  for (int k = 3; k < 6; ++k) v(k) += bell.sigma_deg * random.Normal();
  v(3) = WrapHeadingDeg(v(3));
  return v;
}

FilterUpdate PoseFilter::Update(const LogRatios& log_ratios,
                                const LogOther& other,
                                std::span<const Proposal> proposals,
                                double effort,
                                Random& random) {
  Samples samples;
  samples.has_picture = static_cast<bool>(log_ratios);
  const int rounds = effort < 0.5 ? std::min(2, options_.rounds) : options_.rounds;
  const int count = std::max(50, static_cast<int>(effort * options_.samples));
  const auto known = [&](const PoseVector& v, double log_bells) {
    const double elsewhere = region_.LogDensity(v);
    const double predicted = has_particles()
                                 ? LogSum(std::log1p(-options_.elsewhere_share) + log_bells,
                                          std::log(options_.elsewhere_share) + elsewhere)
                                 : elsewhere;
    return predicted + (other ? other(v) : 0.0);
  };
  // The first proposals: where the odometry leads, and the modes of the picture.
  double predicted_share = has_particles() ? (proposals.empty() ? 1.0 : 0.4) : 0.0;
  std::vector<PoseBell> bells;
  std::vector<double> alone(proposals.size()), together(proposals.size());
  for (std::size_t k = 0; k < proposals.size(); ++k) {
    alone[k] = (proposals[k].log_ratio - proposals.front().log_ratio) / options_.temperature;
    together[k] = alone[k] + known(proposals[k].pose, LogPredicted(proposals[k].pose));
  }
  if (!proposals.empty()) {
    const std::vector<double> a = Normalized(alone), b = Normalized(together);
    for (std::size_t k = 0; k < proposals.size(); ++k) {
      bells.push_back({proposals[k].pose,
                       ModeCovariance(),
                       0.3 * a[k] + 0.4 * b[k] + 0.3 / static_cast<double>(proposals.size())});
    }
  }
  for (int round = 0; round < rounds; ++round) {
    if (predicted_share == 0.0 && bells.empty()) break;
    samples.rounds.push_back(
        {static_cast<double>(count), bells.empty() ? 1.0 : predicted_share, BellMixture(bells)});
    const Samples::Round& drawn = samples.rounds.back();
    const std::size_t first = samples.size();
    std::vector<Pose> poses;
    for (int i = 0; i < count; ++i) {
      const bool predicted = random.Uniform() < drawn.predicted_share;
      const PoseVector v = predicted ? DrawPredicted(random) : drawn.mixture.Draw(random);
      samples.poses.push_back(v);
      samples.log_bells.push_back(LogPredicted(v));
      samples.log_predicted.push_back(has_particles() ? samples.log_bells.back()
                                                      : region_.LogDensity(v));
      samples.log_known.push_back(known(v, samples.log_bells.back()));
      poses.push_back(PoseOf(v));
    }
    const std::vector<double> found =
        samples.has_picture ? log_ratios(poses) : std::vector<double>(poses.size(), 0.0);
    samples.log_ratios.insert(samples.log_ratios.end(), found.begin(), found.end());
    samples.highest = std::max(
        samples.highest,
        *std::max_element(samples.log_ratios.begin() + static_cast<std::ptrdiff_t>(first),
                          samples.log_ratios.end()));
    if (samples.highest == kNothing) samples.has_picture = false;
    if (samples.has_picture) samples.log_match = samples.LogMatch(options_);
    if (round + 1 == rounds) break;
    bells = FitBells(samples.poses,
                     samples.Weights(options_, TemperAfter(round, rounds), true),
                     ModeCovariance());
    predicted_share = has_particles() ? 0.1 : 0.0;
  }
  FilterUpdate update;
  if (samples.size() == 0) return update;
  update.highest_log_ratio = samples.highest;
  if (samples.has_picture) {
    update.evidence = FitBells(
        samples.poses, samples.Weights(options_, 1.0, false), 0.1 * ModeCovariance());
  }
  Keep(samples, random);
  update.effective_samples = EffectiveOf(samples.Weights(options_, 1.0, true));
  return update;
}

void PoseFilter::Keep(const Samples& samples, Random& random) {
  const std::vector<double> weights = samples.Weights(options_, 1.0, true);
  poses_.clear();
  weights_.clear();
  // Systematic resampling: one random number, even steps.
  const double step = 1.0 / options_.particles;
  double next = step * random.Uniform();
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i];
    int copies = 0;
    for (; next < sum; next += step) ++copies;
    if (copies == 0) continue;
    poses_.push_back(samples.poses[i]);
    weights_.push_back(copies * step);
  }
  const double total = std::accumulate(weights_.begin(), weights_.end(), 0.0);
  for (double& w : weights_) w /= total;
  updated_ = poses_;
  since_update_ = {};
  MoveBells();
}

PoseBelief PoseFilter::Belief() const {
  // The pose with the most mass around it, among the heaviest.
  std::vector<std::size_t> order(poses_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return weights_[a] > weights_[b];
  });
  order.resize(std::min<std::size_t>(order.size(), 60));
  const auto mass_around = [&](const PoseVector& v) {
    double mass = 0.0;
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      if (IsNear(poses_[i], v, kAnswerM, kAnswerDeg)) mass += weights_[i];
    }
    return mass;
  };
  PoseVector middle = poses_[order.front()];
  double most = 0.0;
  for (const std::size_t i : order) {
    const double mass = mass_around(poses_[i]);
    if (mass > most) {
      most = mass;
      middle = poses_[i];
    }
  }
  PoseBelief belief;
  for (int again = 0; again < 3; ++again) {
    belief.main = BellAround(poses_, weights_, middle, kAnswerM, kAnswerDeg);
    middle = belief.main.mean;
  }
  // What the steps since the last update add.
  if (!bells_.empty()) {
    const StepBell& bell = bells_.front();
    PoseVector extra;
    extra << bell.sigma_m, bell.sigma_m, bell.sigma_m, bell.sigma_deg, bell.sigma_deg,
        bell.sigma_deg;
    belief.main.covariance.diagonal() += extra.cwiseAbs2();
    const double along = bell.sigma_along_m * bell.sigma_along_m - bell.sigma_m * bell.sigma_m;
    belief.main.covariance.topLeftCorner<2, 2>() += along * bell.along * bell.along.transpose();
  }
  std::vector<std::pair<double, double>> distances;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    distances.emplace_back((poses_[i] - belief.main.mean).head<2>().norm(), weights_[i]);
  }
  std::sort(distances.begin(), distances.end());
  double sum = 0.0;
  for (const auto& [distance, weight] : distances) {
    belief.radius_m = distance;
    sum += weight;
    if (sum >= 1.0 - kAcceptedRisk) break;
  }
  return belief;
}

}  // namespace ridgeline
