// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "camera/intrinsics.h"
#include "localize/edge_matches.h"

namespace ridgeline {

// Unknowns of an adjustment, as offsets from a prior: metres, degrees, percent of the focal length,
// and the metres by which roofs stand out beyond their walls.
enum AdjustmentUnknown {
  kEast,
  kNorth,
  kHeight,
  kHeading,
  kPitch,
  kRoll,
  kFocalPercent,
  kOverhang,
  kAdjustmentUnknowns
};
using AdjustmentVector = Eigen::Matrix<double, kAdjustmentUnknowns, 1>;
using AdjustmentMatrix = Eigen::Matrix<double, kAdjustmentUnknowns, kAdjustmentUnknowns>;

// A line of the picture that runs in a known direction of the world, wherever it stands: corners,
// windows and door posts are vertical.
struct DirectionMatch {
  LineSegment line;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  // local, unit
  double sigma_rad = 0.02;
  double odds = 1.0;    // as in EdgeMatch, of a line in the very direction
  double weight = 1.0;  // share of an independent observation
};

// The camera that the unknowns are offsets of.
struct AdjustmentFrame {
  PinholeCamera camera;
  // Projection centre (local) and angles where all unknowns are 0. The ground, and with it the
  // projection centre, rises by `slope` per metre to the east and to the north.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  ViewAngles angles;

  Pose PoseAt(const AdjustmentVector& unknowns) const;
  PinholeCamera CameraAt(const AdjustmentVector& unknowns) const;
};

struct AdjustmentLimits {
  // An unknown whose limits are equal is fixed.
  AdjustmentVector lower = AdjustmentVector::Zero();
  AdjustmentVector upper = AdjustmentVector::Zero();
  // What is known before: normal distributions. A deviation <= 0: nothing is known.
  AdjustmentVector prior_mean = AdjustmentVector::Zero();
  AdjustmentVector prior_sigma = AdjustmentVector::Zero();

  bool IsFree(int unknown) const { return lower[unknown] < upper[unknown]; }
};

// Signed distances of the projected ends of a match from its line, in units of their standard
// deviations; false if an end is not before the camera. `jacobian` may be null.
bool MatchResiduals(const EdgeMatch& match,
                    const AdjustmentFrame& frame,
                    const AdjustmentVector& unknowns,
                    Eigen::Vector2d& residuals,
                    Eigen::Matrix<double, 2, kAdjustmentUnknowns>* jacobian);

// Angle at the line's middle between it and the image of its direction, in units of the standard
// deviation (its sine, to be exact). `jacobian` may be null.
double DirectionResidual(const DirectionMatch& match,
                         const AdjustmentFrame& frame,
                         const AdjustmentVector& unknowns,
                         Eigen::Matrix<double, 1, kAdjustmentUnknowns>* jacobian);

struct Adjustment {
  AdjustmentVector unknowns = AdjustmentVector::Zero();
  // Of the free unknowns; zero for fixed ones.
  AdjustmentMatrix covariance = AdjustmentMatrix::Zero();
  // Standard deviation of unit weight: that of the residuals in units of the expected ones.
  double sigma0 = 1.0;
  double cost = 0.0;          // twice the negative log likelihood, up to a constant
  double observations = 0.0;  // effective number of lines that agree
};

// Least squares adjustment of the unknowns (Ceres, Levenberg-Marquardt): the negative log likelihood
// of the matches, each the edge's own line (normally distributed) or one at random, of the lines of
// known direction, likewise, and of the priors.
// The loss of a match is -2 log((1 + odds exp(-s / 2)) / (1 + odds)) of its squared residuals s, so
// that what is far away has no influence. The covariance is the inverse of the normal matrix, with
// the lines' part scaled by sigma0^2 if that is above 1: below it says little, since the lines nearest
// to the edges were chosen.
Adjustment AdjustPose(std::span<const EdgeMatch> matches,
                      std::span<const DirectionMatch> directions,
                      const AdjustmentFrame& frame,
                      const AdjustmentLimits& limits,
                      const AdjustmentVector& start);

}  // namespace ridgeline
