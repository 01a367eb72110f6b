// SPDX-License-Identifier: Apache-2.0
#include "track/skyline_matcher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "base/angle.h"
#include "base/error.h"
#include "track/downhill_simplex.h"
#include "track/skyline_certainty.h"
#include "track/skyline_shift.h"

namespace ridgeline {
namespace {

// Share of a limit from which the result counts as lying on it.
constexpr double kAtLimit = 0.98;
// A model that nowhere rises above this elevation [rad] has no skyline to match.
constexpr float kLeastElevation = 0.01f;
// Precision of the drawings of 2D matching [px of the columns compared].
constexpr double kDrawingPrecisionPx = 0.5;
// The simplex ends when its corners are this close [px at 640].
constexpr double kTolerancePx = 0.01;

// The variables of a match, as offsets from the start.
enum Variable : std::size_t { kHeading, kPitch, kRoll, kEast, kNorth, kHeight, kOffsetVariables };
using Offsets = std::array<double, kOffsetVariables>;

Pose PoseAt(const Pose& start, std::span<const double> o) {
  ViewAngles angles = ViewAnglesOf(start.cam_from_world);
  angles.heading_deg += o[kHeading];
  angles.pitch_deg += o[kPitch];
  angles.roll_deg += o[kRoll];
  return {CamFromWorld(angles),
          start.center_in_world + Eigen::Vector3d(o[kEast], o[kNorth], o[kHeight])};
}

// How far a point is beyond the limits, as a share of them; 0 inside.
double Excess(std::span<const double> o, const SkylineMatchOptions& options) {
  const double used = std::max({std::abs(o[kHeading]) / options.max_heading_deg,
                                std::abs(o[kPitch]) / options.max_tilt_deg,
                                std::abs(o[kRoll]) / options.max_tilt_deg,
                                std::hypot(o[kEast], o[kNorth]) / options.max_shift_m,
                                std::abs(o[kHeight]) / options.max_shift_m});
  return std::max(0.0, used - 1.0);
}

// What leaving the start costs [px at 640].
double SensorCost(std::span<const double> o, const SkylineMatchOptions& options) {
  const auto squared = [](double value) { return value * value; };
  return options.sensor_weight_px *
         (squared(o[kHeading] / options.heading_sigma_deg) +
          squared(o[kPitch] / options.tilt_sigma_deg) + squared(o[kRoll] / options.tilt_sigma_deg) +
          squared(o[kEast] / options.position_sigma_m) +
          squared(o[kNorth] / options.position_sigma_m) +
          squared(o[kHeight] / options.height_sigma_m));
}

// Azimuths that the picture can show while it is matched: beyond them columns count as not reached.
Sector SectorOf(const Pose& start,
                const PinholeCamera& camera,
                const SkylineMatchOptions& options) {
  const Eigen::Quaterniond world_from_cam = start.cam_from_world.conjugate();
  const Eigen::Vector3d axis = world_from_cam * Eigen::Vector3d::UnitZ();
  Sector sector;
  sector.center = std::atan2(axis.x(), axis.y());
  double half = 0.0;
  for (const double x : {0.0, static_cast<double>(camera.width)}) {
    for (const double y : {0.0, static_cast<double>(camera.height)}) {
      const Eigen::Vector3d ray = (world_from_cam * camera.RayFromImage({x, y})).normalized();
      // The tilt may grow by the limit: rays that steep can point anywhere.
      if (std::asin(std::abs(ray.z())) > (85.0 - options.max_tilt_deg) * kRadPerDeg) return sector;
      half = std::max(half,
                      std::abs(std::remainder(std::atan2(ray.x(), ray.y()) - sector.center,
                                              2.0 * std::numbers::pi)));
    }
  }
  const double reach = options.scan_heading_deg > 0.0
                           ? options.scan_heading_deg + 2.0 * options.heading_step_deg
                           : options.max_heading_deg;
  const double margin = std::min(reach, options.max_heading_deg) + 0.5 * options.max_tilt_deg;
  sector.half_width = std::min(half + margin * kRadPerDeg, sector.half_width);
  return sector;
}

class Matcher {
 public:
  Matcher(const SkylineL1& real,
          const SkylineSource& source,
          const Pose& start,
          const SkylineMatchOptions& options)
      : real_(real),
        source_(source),
        start_(start),
        options_(options),
        sector_(SectorOf(start, real.camera(), options)),
        rows_(real.rows().size()) {
    Look(start.center_in_world);
  }

  bool SeesModel() const {
    return std::any_of(directions_.begin(), directions_.end(), [](const Eigen::Vector3f& d) {
      return d.z() > kLeastElevation;
    });
  }

  double DistanceAt(const Pose& pose) {
    Look(pose.center_in_world);
    ++evaluations_;
    return real_.Distance(directions_, pose.cam_from_world.toRotationMatrix().cast<float>());
  }

  // Rotation after shifting and turning the drawing of the skyline as seen in `pose`.
  Pose Match2d(const Pose& pose, double scan_share) {
    const SkylineDrawing drawing(
        directions_, real_.camera(), pose.cam_from_world, kDrawingPrecisionPx);
    const PinholeCamera& camera = real_.camera();
    const double px_per_deg = camera.fx * kRadPerDeg;
    const auto motion_of = [&](std::span<const double> v) {
      return SkylineDrawing::Motion{v[0], v[1], v[2]};
    };
    const auto distance = [&](std::span<const double> v) {
      ++evaluations_;
      drawing.Rows(motion_of(v), rows_);
      const Offsets o{v[0] / px_per_deg, v[1] / px_per_deg, v[2] / kRadPerDeg, 0.0, 0.0, 0.0};
      return real_.DistanceOfRows(rows_) + SensorCost(o, options_);
    };
    std::vector<double> best{0.0, 0.0, 0.0};
    ScanGrid(scan_share, [&](double heading_deg, double pitch_deg) {
      return distance(std::array{-heading_deg * px_per_deg, pitch_deg * px_per_deg, 0.0});
    });
    best[0] = -scan_best_[0] * px_per_deg;
    best[1] = scan_best_[1] * px_per_deg;
    std::vector<SimplexSteps> rounds;
    double scale = 1.0;
    for (int round = 0; round < options_.rounds; ++round, scale *= options_.shrink) {
      const double x = scale * options_.heading_step_deg * px_per_deg;
      const double y = scale * options_.pitch_step_deg * px_per_deg;
      const double turn = scale * options_.roll_step_deg * kRadPerDeg;
      if (round == 0) rounds.push_back({x, y, 0.0});
      rounds.push_back({x, y, turn});
    }
    const SimplexResult found =
        MinimizeBySimplex(distance, best, rounds, {kTolerancePx, options_.max_evaluations});
    const SkylineDrawing::Motion motion = motion_of(found.point);
    Pose moved = pose;
    moved.cam_from_world = options_.linear_angles
                               ? RotationAfterLinear(motion, camera, pose.cam_from_world)
                               : RotationAfter(motion, camera, pose.cam_from_world);
    return moved;
  }

  Pose Match3d(bool position) {
    const auto distance = [&](std::span<const double> o) {
      const double excess = Excess(o, options_);
      if (excess > 0.0) return kSkylineReferenceWidthPx * (1.0 + excess);
      return DistanceAt(PoseAt(start_, o)) + SensorCost(o, options_);
    };
    ScanGrid(1.0, [&](double heading_deg, double pitch_deg) {
      return distance(Offsets{heading_deg, pitch_deg, 0.0, 0.0, 0.0, 0.0});
    });
    const std::vector<double> first{scan_best_[0], scan_best_[1], 0.0, 0.0, 0.0, 0.0};
    std::vector<SimplexSteps> rounds;
    double scale = 1.0;
    for (int round = 0; round < options_.rounds; ++round, scale *= options_.shrink) {
      const double heading = scale * options_.heading_step_deg;
      const double pitch = scale * options_.pitch_step_deg;
      const double roll = scale * options_.roll_step_deg;
      const double shift = scale * options_.position_step_m;
      const double height = options_.free_height ? scale * options_.height_step_m : 0.0;
      if (round == 0) rounds.push_back({heading, pitch, 0.0, 0.0, 0.0, 0.0});
      rounds.push_back({heading, pitch, roll, 0.0, 0.0, 0.0});
      if (!position) continue;
      rounds.push_back({heading, 0.0, 0.0, shift, shift, 0.0});
      rounds.push_back({heading, pitch, roll, shift, -shift, height});
    }
    const SimplexResult found =
        MinimizeBySimplex(distance, first, rounds, {kTolerancePx, options_.max_evaluations});
    return PoseAt(start_, found.point);
  }

  // Whether a heading of the scan, well away from `pose`, is about as good as `distance`.
  bool Ambiguous(const Pose& pose, double distance) const {
    const double heading = ViewAnglesOf(pose.cam_from_world).heading_deg;
    const double start = ViewAnglesOf(start_.cam_from_world).heading_deg;
    for (const auto& [offset, other] : scan_) {
      const double away = std::abs(HeadingDifferenceDeg(start + offset, heading));
      if (away < 2.0 * options_.scan_step_deg) continue;
      if (other + 1.0 < options_.ambiguous_ratio * (distance + 1.0)) return true;
    }
    return false;
  }

  double HeadingSigma(const Pose& pose, double distance, bool position_matched) const {
    const SkylinePrior prior{options_.heading_sigma_deg,
                             options_.tilt_sigma_deg,
                             options_.position_sigma_m,
                             position_matched};
    const auto look = [this](const Eigen::Vector3d& p) { return source_(p, sector_); };
    return HeadingSigmaDeg(real_, look, pose, distance, prior);
  }

  int evaluations() const { return evaluations_; }

 private:
  // The virtual skyline of a position; kept until another one is asked for.
  void Look(const Eigen::Vector3d& position) {
    if (!directions_.empty() && position == position_) return;
    position_ = position;
    directions_ = source_(position, sector_);
  }

  // Tries headings and pitches around the start; sets scan_ and scan_best_.
  template <typename Distance>
  void ScanGrid(double share, const Distance& distance) {
    scan_best_ = {0.0, 0.0};
    if (options_.scan_heading_deg <= 0.0 || share <= 0.0) return;
    scan_.clear();
    double least = std::numeric_limits<double>::infinity();
    const double step = options_.scan_step_deg;
    const int headings = static_cast<int>(share * options_.scan_heading_deg / step);
    const int pitches = static_cast<int>(share * options_.scan_pitch_deg / step);
    for (int h = -headings; h <= headings; ++h) {
      double of_heading = std::numeric_limits<double>::infinity();
      for (int p = -pitches; p <= pitches; ++p) {
        const double d = distance(h * step, p * step);
        of_heading = std::min(of_heading, d);
        if (d >= least) continue;
        least = d;
        scan_best_ = {h * step, p * step};
      }
      scan_.emplace_back(h * step, of_heading);
    }
  }

  const SkylineL1& real_;
  const SkylineSource& source_;
  const Pose start_;
  const SkylineMatchOptions& options_;
  const Sector sector_;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3f> directions_;
  std::vector<float> rows_;
  std::vector<std::pair<double, double>> scan_;  // heading offset [deg], least distance [px]
  std::array<double, 2> scan_best_{0.0, 0.0};    // heading, pitch offset [deg]
  int evaluations_ = 0;
};

Pose Matched(Matcher& matcher, const Pose& start, SkylineMatch method) {
  switch (method) {
    case SkylineMatch::k2d:
      return matcher.Match2d(start, 1.0);
    case SkylineMatch::k2x2d:
      return matcher.Match2d(matcher.Match2d(start, 1.0), 0.0);
    case SkylineMatch::k3d:
      return matcher.Match3d(false);
    case SkylineMatch::k6dof:
      return matcher.Match3d(true);
  }
  return start;
}

bool AtLimit(const Pose& start, const Pose& pose, const SkylineMatchOptions& options) {
  const ViewAngles a = ViewAnglesOf(start.cam_from_world);
  const ViewAngles b = ViewAnglesOf(pose.cam_from_world);
  const Eigen::Vector3d shift = pose.center_in_world - start.center_in_world;
  return std::abs(HeadingDifferenceDeg(a.heading_deg, b.heading_deg)) >
             kAtLimit * options.max_heading_deg ||
         std::abs(a.pitch_deg - b.pitch_deg) > kAtLimit * options.max_tilt_deg ||
         std::abs(HeadingDifferenceDeg(a.roll_deg, b.roll_deg)) > kAtLimit * options.max_tilt_deg ||
         shift.norm() > kAtLimit * options.max_shift_m;
}

}  // namespace

void SkylineMatchOptions::Visit(OptionVisitor& v) {
  v.Field("method", method, OneOf{{"2d", "2x2d", "3d", "6dof"}});
  v.Field("linear_angles", linear_angles);
  v.Field("scan_heading_deg", scan_heading_deg, NotNegative());
  v.Field("scan_pitch_deg", scan_pitch_deg, NotNegative());
  v.Field("scan_step_deg", scan_step_deg, Positive());
  v.Field("heading_step_deg", heading_step_deg, Positive());
  v.Field("pitch_step_deg", pitch_step_deg, Positive());
  v.Field("roll_step_deg", roll_step_deg, Positive());
  v.Field("position_step_m", position_step_m, Positive());
  v.Field("height_step_m", height_step_m, Positive());
  v.Field("rounds", rounds, AtLeast(1));
  v.Field("shrink", shrink, Open(0.0, 1.0));
  v.Field("max_evaluations", max_evaluations, AtLeast(1));
  v.Field("free_height", free_height);
  v.Field("sensor_weight_px", sensor_weight_px, NotNegative());
  v.Field("heading_sigma_deg", heading_sigma_deg, Positive());
  v.Field("tilt_sigma_deg", tilt_sigma_deg, Positive());
  v.Field("position_sigma_m", position_sigma_m, Positive());
  v.Field("height_sigma_m", height_sigma_m, Positive());
  v.Field("max_distance_px", max_distance_px, Positive());
  v.Field("ambiguous_ratio", ambiguous_ratio, NotNegative());
  v.Field("max_heading_sigma_deg", max_heading_sigma_deg, Positive());
  v.Field("max_heading_deg", max_heading_deg, Positive());
  v.Field("max_tilt_deg", max_tilt_deg, Positive());
  v.Field("max_shift_m", max_shift_m, Positive());
}

SkylineMatch SkylineMatchNamed(const std::string& name) {
  if (name == "2d") return SkylineMatch::k2d;
  if (name == "2x2d") return SkylineMatch::k2x2d;
  if (name == "3d") return SkylineMatch::k3d;
  if (name == "6dof") return SkylineMatch::k6dof;
  throw InputError("", "match.method", '"' + name + '"', "2d, 2x2d, 3d or 6dof");
}

const char* NameOf(SkylineMatch method) {
  switch (method) {
    case SkylineMatch::k2d:
      return "2d";
    case SkylineMatch::k2x2d:
      return "2x2d";
    case SkylineMatch::k3d:
      return "3d";
    case SkylineMatch::k6dof:
      return "6dof";
  }
  return "";
}

const char* NameOf(SkylineMatchStatus status) {
  switch (status) {
    case SkylineMatchStatus::kOk:
      return "ok";
    case SkylineMatchStatus::kUnusable:
      return "unusable";
    case SkylineMatchStatus::kNoModel:
      return "no_model";
    case SkylineMatchStatus::kFarFromStart:
      return "far_from_start";
    case SkylineMatchStatus::kPoorMatch:
      return "poor_match";
    case SkylineMatchStatus::kAmbiguous:
      return "ambiguous";
  }
  return "";
}

double DistanceAt(const SkylineL1& real,
                  const SkylineSource& source,
                  const Pose& pose,
                  const SkylineMatchOptions& options) {
  return Matcher(real, source, pose, options).DistanceAt(pose);
}

SkylineMatchResult MatchSkyline(const SkylineL1& real,
                                const SkylineSource& source,
                                const Pose& start,
                                const SkylineMatchOptions& options) {
  SkylineMatchResult result;
  result.best = start;
  const auto failed = [&](SkylineMatchStatus status, std::string reason) {
    result.status = status;
    result.reason = std::move(reason);
    return result;
  };
  Matcher matcher(real, source, start, options);
  result.distance_before_px = result.distance_after_px = matcher.DistanceAt(start);
  if (real.use() != SkylineUse::kUsable) {
    return failed(SkylineMatchStatus::kUnusable, ReasonOf(real.use()));
  }
  if (!matcher.SeesModel()) {
    return failed(SkylineMatchStatus::kNoModel, "no building of the model rises above the horizon");
  }
  const SkylineMatch method = SkylineMatchNamed(options.method);
  result.best = Matched(matcher, start, method);
  result.distance_after_px = matcher.DistanceAt(result.best);
  result.evaluations = matcher.evaluations();
  result.heading_sigma_deg =
      matcher.HeadingSigma(result.best, result.distance_after_px, method == SkylineMatch::k6dof);
  if (AtLimit(start, result.best, options)) {
    return failed(SkylineMatchStatus::kFarFromStart,
                  "the best pose lies at the limit of what the sensors can be wrong by");
  }
  if (result.distance_after_px > options.max_distance_px) {
    return failed(SkylineMatchStatus::kPoorMatch, "the skylines differ too much at the best pose");
  }
  if (matcher.Ambiguous(result.best, result.distance_after_px)) {
    return failed(SkylineMatchStatus::kAmbiguous, "another heading fits about as well");
  }
  if (result.heading_sigma_deg > options.max_heading_sigma_deg) {
    return failed(
        SkylineMatchStatus::kAmbiguous,
        "the heading is not certain: a position off as the sensors are would turn it too far");
  }
  result.status = SkylineMatchStatus::kOk;
  result.pose = result.best;
  return result;
}

}  // namespace ridgeline
