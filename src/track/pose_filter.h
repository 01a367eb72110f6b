// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/options.h"
#include "base/random.h"
#include "track/motion.h"
#include "track/pose_vector.h"

namespace ridgeline {

struct PoseFilterOptions {
  // Particles kept between frames (systematic resampling), and poses tried in each round.
  int particles = 300;
  int samples = 300;
  // Rounds of proposals, each fitted to the last.
  int rounds = 3;
  // Divides the evidence: the pieces of a picture, and pictures of one street, share errors.
  double temperature = 2.0;
  // Probability that a picture says nothing of where it was taken: bounds what one can do.
  double lie_share = 0.02;
  // Probability, per frame, that the camera is where no particle is.
  double elsewhere_share = 0.001;
  // Least standard deviations of a step.
  double floor_m = 0.06;
  double floor_deg = 0.08;

  void Visit(OptionVisitor& v);
};

// Where a camera may be that was not followed: uniform in place and heading, normal in height above
// the ground, and a Cauchy distribution of the tilt.
struct PoseRegion {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  // local
  double half_m = 20.0;
  // Height (local) expected at a place, and its deviation.
  std::function<double(const Eigen::Vector2d&)> height_at;
  double height_sigma_m = 0.5;
  double heading_deg = 0.0;
  double heading_half_deg = 180.0;
  double pitch_deg = 0.0;
  double roll_deg = 0.0;
  double tilt_scale_deg = 8.0;

  // Log of the density [1 / (m^3 deg^3)].
  double LogDensity(const PoseVector& v) const;
};

// A bell of poses.
struct PoseBell {
  PoseVector mean = PoseVector::Zero();
  PoseCovariance covariance = PoseCovariance::Identity();
  double mass = 0.0;  // share of the whole
};

// What is believed, in short.
struct PoseBelief {
  PoseBell main;          // the poses around the likeliest place
  double radius_m = 0.0;  // around its mean, horizontally, with all but 1 in 1000 of the mass
};

// What a frame has done.
struct FilterUpdate {
  double highest_log_ratio = 0.0;  // of the poses tried
  double effective_samples = 0.0;
  // What the picture alone says: bells under its likelihood, the heaviest first.
  std::vector<PoseBell> evidence;
};

// Bayes filter over camera poses. The belief is a set of weighted poses; a prediction makes each a
// bell of its odometry's width. An update draws from that prediction and from the modes of the
// picture's evidence, fits its proposals to the result in rounds, and weights each pose tried with
// prediction times likelihood over the density of all proposals: the marginal particle filter (Klaas,
// de Freitas, Doucet, UAI 2005) with adaptive multiple importance sampling (Cornuet et al., 2012).
// A picture's likelihood is exp(log ratio / temperature) against that of the best pose tried, mixed
// with "this picture says nothing".
class PoseFilter {
 public:
  using LogRatios = std::function<std::vector<double>(std::span<const Pose>)>;
  // Log likelihood of what else is known of a pose: tilt by instruments, a fix.
  using LogOther = std::function<double(const PoseVector&)>;

  explicit PoseFilter(const PoseFilterOptions& options);

  // Nothing is known but the region.
  void Start(const PoseRegion& region);
  bool has_particles() const { return !bells_.empty(); }
  // Where a pose may be that no particle follows.
  void SetRegion(const PoseRegion& region) { region_ = region; }
  const PoseRegion& region() const { return region_; }

  // Motions since the last update add up.
  void Predict(const Motion& motion);

  // A mode of the picture's evidence, to propose from.
  struct Proposal {
    PoseVector pose;
    double log_ratio = 0.0;
  };
  // @param effort  Factor on the number of poses tried; at most 1.
  // @param log_ratios  May be empty: the picture says nothing; then `other` alone counts.
  FilterUpdate Update(const LogRatios& log_ratios,
                      const LogOther& other,
                      std::span<const Proposal> proposals,
                      double effort,
                      Random& random);

  // Needs particles.
  PoseBelief Belief() const;
  // Poses with their weights, which sum to 1.
  const std::vector<PoseVector>& poses() const { return poses_; }
  const std::vector<double>& weights() const { return weights_; }

 private:
  // A particle after its prediction: a bell that is longer along the way.
  struct StepBell {
    PoseVector mean;
    double weight = 0.0;
    Eigen::Vector2d along = Eigen::Vector2d::UnitY();  // horizontal direction of the step
    double sigma_along_m = 0.0;
    double sigma_m = 0.0;
    double sigma_deg = 0.0;
  };
  struct Samples;

  double LogPredicted(const PoseVector& v) const;
  PoseVector DrawPredicted(Random& random) const;
  void Keep(const Samples& samples, Random& random);
  void MoveBells();

  PoseFilterOptions options_;
  PoseRegion region_;
  std::vector<PoseVector> updated_;  // at the last update
  Motion since_update_;
  std::vector<PoseVector> poses_;  // after the motion since
  std::vector<double> weights_;
  std::vector<StepBell> bells_;
};

}  // namespace ridgeline
