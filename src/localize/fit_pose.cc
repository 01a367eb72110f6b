// SPDX-License-Identifier: Apache-2.0
#include "localize/fit_pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/angle.h"
#include "lines/angle_to_direction.h"
#include "score/position_view.h"

namespace ridgeline {
namespace {

constexpr std::array<const char*, kAdjustmentUnknowns> kNames = {
    "east", "north", "height", "heading", "pitch", "roll", "focal length", "overhang"};

// Roofs stand out by a few decimetres as a rule, where they do.
constexpr double kOverhangMeanM = 0.3;
constexpr double kOverhangSigmaM = 0.3;

AdjustmentVector VectorOf(const PoseSpace::Offset& o) {
  AdjustmentVector x = AdjustmentVector::Zero();
  x.head<6>() << o.east_m, o.north_m, o.height_m, o.heading_deg, o.pitch_deg, o.roll_deg;
  return x;
}

PoseSpace::Offset OffsetOf(const AdjustmentVector& x) {
  return {x[kEast], x[kNorth], x[kHeight], x[kHeading], x[kPitch], x[kRoll]};
}

AdjustmentLimits LimitsOf(const PoseSpaceOptions& ranges, const PoseFitOptions& options) {
  AdjustmentLimits limits;
  limits.upper << ranges.east_m, ranges.north_m, ranges.height_m, ranges.heading_deg,
      ranges.pitch_deg, ranges.roll_deg, options.focal_range_percent, options.max_overhang_m;
  limits.lower = -limits.upper;
  limits.prior_sigma = limits.upper / std::numbers::sqrt3;
  limits.lower[kOverhang] = 0.0;
  limits.prior_mean[kOverhang] = std::min(kOverhangMeanM, limits.upper[kOverhang]);
  limits.prior_sigma[kOverhang] = kOverhangSigmaM;
  // The whole circle has neither ends nor a middle.
  if (ranges.heading_deg >= 180.0) {
    limits.lower[kHeading] = -1e9;
    limits.upper[kHeading] = 1e9;
    limits.prior_sigma[kHeading] = 0.0;
  }
  return limits;
}

class Fitter {
 public:
  Fitter(const PictureLines& lines,
         const Scene& scene,
         const PoseSpace& space,
         const LineLikelihoodOptions& likelihood,
         const PoseFitOptions& options)
      : camera_(lines.camera),
        segments_(lines.segments),
        scene_(scene),
        space_(space),
        options_(options),
        limits_(LimitsOf(space.ranges(), options)),
        matcher_(lines.segments, lines.field, scene, likelihood, options.matches) {}

  PoseFit Fit(const PoseSpace::Offset& start) {
    PoseFit fit;
    fit.offset = start;
    AdjustmentVector x = VectorOf(start);
    x[kOverhang] = limits_.prior_mean[kOverhang];
    if (!space_.PoseAt(start)) {
      fit.status = PoseFitStatus::kNotAdmissible;
      fit.reason = "the pose to be refined stands in a building or off the terrain";
      return fit;
    }
    Adjustment adjustment;
    double tolerance = options_.first_tolerance;
    for (int round = 1; round <= options_.max_rounds; ++round) {
      const std::optional<AdjustmentFrame> frame = FrameAt(x);
      const std::vector<EdgeMatch> matches = MatchAt(x, *frame, tolerance);
      fit.matches = static_cast<int>(matches.size());
      fit.rounds = round;
      if (matches.empty()) {
        fit.status = PoseFitStatus::kNoMatches;
        fit.reason = "no line of the picture runs along a visible edge of the model";
        break;
      }
      adjustment = AdjustPose(matches, VerticalLines(x, *frame, tolerance), *frame, limits_, x);
      const AdjustmentVector next = AdmissibleBetween(x, adjustment.unknowns);
      const AdjustmentVector step = next - x;
      x = next;
      fit.covariance = PoseCovariance(adjustment.covariance, *frame);
      fit.status = PoseFitStatus::kOk;
      constexpr double kStillM = 0.005;
      constexpr double kStillDeg = 0.005;
      if (tolerance == 1.0 && step.head<3>().norm() < kStillM &&
          step.segment<3>(kHeading).norm() < kStillDeg) {
        break;
      }
      tolerance = std::max(1.0, 0.5 * tolerance);
    }
    fit.offset = OffsetOf(x);
    fit.focal_factor = 1.0 + 0.01 * x[kFocalPercent];
    fit.overhang_m = x[kOverhang];
    fit.focal_sigma_percent = std::sqrt(adjustment.covariance(kFocalPercent, kFocalPercent));
    fit.overhang_sigma_m = std::sqrt(adjustment.covariance(kOverhang, kOverhang));
    fit.sigma0 = adjustment.sigma0;
    if (fit.status == PoseFitStatus::kOk) NameUndetermined(adjustment, fit);
    return fit;
  }

 private:
  // Terrain and projection centre near the place of `x`; nullopt: not admissible.
  std::optional<AdjustmentFrame> FrameAt(const AdjustmentVector& x) const {
    const auto here = space_.PositionAt(x[kEast], x[kNorth], x[kHeight]);
    if (!here) return std::nullopt;
    AdjustmentFrame frame;
    frame.camera = camera_;
    frame.angles = space_.center_angles();
    constexpr double kStepM = 0.5;
    for (int axis = 0; axis < 2; ++axis) {
      const double east = axis == 0 ? kStepM : 0.0;
      const double north = axis == 1 ? kStepM : 0.0;
      const auto before = space_.PositionAt(x[kEast] - east, x[kNorth] - north, x[kHeight]);
      const auto behind = space_.PositionAt(x[kEast] + east, x[kNorth] + north, x[kHeight]);
      if (before && behind) frame.slope[axis] = (behind->z() - before->z()) / (2.0 * kStepM);
    }
    const double rise = frame.slope.x() * x[kEast] + frame.slope.y() * x[kNorth];
    frame.center = *here - Eigen::Vector3d(x[kEast], x[kNorth], x[kHeight] + rise);
    return frame;
  }

  std::vector<EdgeMatch> MatchAt(const AdjustmentVector& x,
                                 const AdjustmentFrame& frame,
                                 double tolerance) {
    const Pose pose = frame.PoseAt(x);
    const ViewAngles angles = space_.AnglesAt(OffsetOf(x));
    // A move this small hides and shows next to nothing.
    constexpr double kSamePlaceM = 0.1;
    constexpr double kSameDeg = 2.0;
    const bool is_same =
        view_ && (view_->visible.position - pose.center_in_world).norm() < kSamePlaceM &&
        std::abs(HeadingDifferenceDeg(angles.heading_deg, view_heading_deg_)) < kSameDeg;
    if (!is_same) {
      constexpr double kMarginDeg = 3.0;
      constexpr double kStepRad = 0.02;
      const PanoramaRange range = RangeOf(camera_, angles,
                                          {kMarginDeg, kMarginDeg, kMarginDeg}, kStepRad);
      view_ = ViewFrom(scene_, pose.center_in_world, range, {true, false});
      view_heading_deg_ = angles.heading_deg;
    }
    return matcher_.Match(*view_, frame.CameraAt(x), pose, tolerance, x[kOverhang]);
  }

  // Lines that may be vertical, where the camera's tilt is free.
  std::vector<DirectionMatch> VerticalLines(const AdjustmentVector& x,
                                            const AdjustmentFrame& frame,
                                            double tolerance) const {
    std::vector<DirectionMatch> verticals;
    if (!limits_.IsFree(kPitch) && !limits_.IsFree(kRoll)) return verticals;
    constexpr double kSigmaDeg = 1.0;  // as in FindTilts
    constexpr double kVerticalShare = 0.3;
    constexpr double kMaxSigmas = 3.0;
    const double sigma_rad = tolerance * kSigmaDeg * kRadPerDeg;
    // Half-normal against directions at random in [0, pi / 2].
    const double odds = kVerticalShare / (1.0 - kVerticalShare) *
                        std::sqrt(2.0 / std::numbers::pi) / sigma_rad * (std::numbers::pi / 2.0);
    const Eigen::Vector3d up = frame.PoseAt(x).cam_from_world * Eigen::Vector3d::UnitZ();
    const PinholeCamera camera = frame.CameraAt(x);
    const double full_px = options_.matches.full_overlap_width * camera.width;
    for (const LineSegment& line : segments_) {
      if (std::abs(AngleToDirection(line, camera, up)) > kMaxSigmas * sigma_rad) continue;
      verticals.push_back({line, Eigen::Vector3d::UnitZ(), sigma_rad, odds,
                           std::min(1.0, line.Length() / full_px)});
    }
    return verticals;
  }

  // The farthest place on the way that is admissible, by halving; `from` is.
  AdjustmentVector AdmissibleBetween(const AdjustmentVector& from,
                                     const AdjustmentVector& to) const {
    constexpr int kHalvings = 6;
    AdjustmentVector x = to;
    for (int i = 0; i < kHalvings; ++i) {
      if (space_.PoseAt(OffsetOf(x))) return x;
      x = 0.5 * (from + x);
    }
    return from;
  }

  // Heights above the terrain to absolute ones.
  static Eigen::Matrix<double, 6, 6> PoseCovariance(const AdjustmentMatrix& covariance,
                                                    const AdjustmentFrame& frame) {
    Eigen::Matrix<double, 6, 6> absolute = Eigen::Matrix<double, 6, 6>::Identity();
    absolute(kHeight, kEast) = frame.slope.x();
    absolute(kHeight, kNorth) = frame.slope.y();
    return absolute * covariance.topLeftCorner<6, 6>() * absolute.transpose();
  }

  // A parameter whose deviation is nearly the prior's was not seen by the picture.
  void NameUndetermined(const Adjustment& adjustment, PoseFit& fit) const {
    constexpr double kShareOfPrior = 0.9;
    std::string names;
    for (int k = 0; k < kAdjustmentUnknowns; ++k) {
      if (!limits_.IsFree(k)) continue;
      const double sigma = std::sqrt(adjustment.covariance(k, k));
      const bool is_seen = limits_.prior_sigma[k] > 0.0
                               ? sigma < kShareOfPrior * limits_.prior_sigma[k]
                               : sigma > 0.0;
      if (!is_seen) names += (names.empty() ? "" : ", ") + std::string(kNames[k]);
    }
    if (names.empty()) return;
    fit.status = PoseFitStatus::kUndetermined;
    fit.reason = "the matched lines leave open: " + names;
  }

  PinholeCamera camera_;
  std::span<const LineSegment> segments_;
  const Scene& scene_;
  const PoseSpace& space_;
  const PoseFitOptions& options_;
  AdjustmentLimits limits_;
  EdgeMatcher matcher_;
  std::optional<PositionView> view_;
  double view_heading_deg_ = 0.0;
};

}  // namespace

PoseFit FitPose(const PictureLines& lines,
                const Scene& scene,
                const PoseSpace& space,
                const LineLikelihoodOptions& likelihood,
                const PoseFitOptions& options,
                const PoseSpace::Offset& start) {
  return Fitter(lines, scene, space, likelihood, options).Fit(start);
}

}  // namespace ridgeline
