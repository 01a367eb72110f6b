// SPDX-License-Identifier: Apache-2.0
#include "track/tracker.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <cstdio>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "camera/local_frame.h"

namespace ridgeline {
namespace {

constexpr std::uint64_t kTrackStage = 0xa0;
// Radius of a normal distribution in the plane, and half-width on a line, in standard deviations,
// that are exceeded once in a thousand times.
constexpr double kOneInThousandPlane = 3.717;
constexpr double kOneInThousandLine = 3.291;
// Time between frames that have none.
constexpr double kFrameS = 1.0;
// Longest gap in time that a motion is believed over.
constexpr double kGapS = 10.0;
// Below this share the edges are not where they should be.
constexpr double kExplained = 0.35;
constexpr int kUnexplainedLooks = 3;
// No pose is given where none has this share of the belief.
constexpr double kLeastMass = 0.1;
// A position less certain than this is sought in a wide look [m].
constexpr double kWideSigmaM = 1.5;
// What is learned of the scale of odometry presumes that it errs by less.
constexpr double kOneScale = 0.1;
// Deviation of a speed that was found from some poses: it changes.
constexpr double kFoundScale = 0.25;
// Scales of measured odometry this near to each other are one.
constexpr double kSameScale = 0.1;
// What the model and the choice of a way to count errors leave at least [m, deg].
constexpr double kModelFloorM = 0.1;
constexpr double kModelFloorDeg = 0.1;
// Places whose poses share a view.
constexpr double kCellM = 0.3;
constexpr double kGlanceCellM = 0.6;
// Particles are followed or not: odds at the start, the least share of odds that a frame keeps, and
// bounds of what one look can say.
constexpr double kWidest = 5.0;  // of the start's range
constexpr double kForget = 0.97;
// Right and wrong poses are as likely to explain this share, and the odds (log) by which a share
// speaks for a pose. Looks along a street share their errors: each counts little.
constexpr double kEvenExplained = 0.8;
constexpr double kOddsPerExplained = 3.0;
constexpr double kMostSaid = 1.5;
constexpr double kMostOdds = 7.5;

double SigmaOf(const PoseCovariance& covariance) {
  const Eigen::Matrix2d plane = covariance.topLeftCorner<2, 2>();
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(plane).eigenvalues()(1));
}

std::string Text(const char* format, double value) {
  char text[200];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// Log of a normal density that forgives outliers.
double Robust(double residual, double sigma) {
  const double z = residual / sigma;
  return std::log(0.95 * std::exp(-0.5 * z * z) + 0.05 * std::exp(-4.0));
}

double Probability(double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); }

}  // namespace

const char* NameOf(TrackState state) {
  switch (state) {
    case TrackState::kTracking:
      return "tracking";
    case TrackState::kRelocalizing:
      return "relocalizing";
    case TrackState::kLost:
      return "lost";
  }
  return "";
}

const char* NameOf(TrackLook look) {
  switch (look) {
    case TrackLook::kNone:
      return "none";
    case TrackLook::kGlance:
      return "glance";
    case TrackLook::kClose:
      return "close";
    case TrackLook::kWide:
      return "wide";
  }
  return "";
}

Tracker::Tracker(const Localizer& localizer,
                 const TrackOptions& options,
                 std::uint64_t seed,
                 int threads)
    : localizer_(localizer),
      options_(options),
      seed_(seed),
      threads_(threads),
      filter_(options.filter),
      monitor_(options.gnss),
      scale_sigma_(options.scale_sigma) {
  CheckOptions(options, "track");
}

PoseRegion Tracker::RegionAround(const Eigen::Vector2d& center, double half_m) const {
  const PoseSpaceOptions& space = localizer_.options().search.space;
  const HeightGrid* dtm = localizer_.dtm();
  const double origin_height = localizer_.scene().model().origin_in_world.z();
  PoseRegion region;
  region.center = center;
  region.half_m = half_m;
  if (start_.height_in_world) {
    const double height = *start_.height_in_world - origin_height;
    const std::optional<double> ground = dtm ? dtm->HeightAt(center) : std::nullopt;
    // A height that was given is one above the ground where there is a ground.
    const double above = ground ? height - *ground : 0.0;
    region.height_at = [dtm, height, above](const Eigen::Vector2d& xy) {
      const std::optional<double> here = dtm ? dtm->HeightAt(xy) : std::nullopt;
      return here ? *here + above : height;
    };
    region.height_sigma_m = std::max(0.5, space.height_m);
  } else {
    if (dtm == nullptr) {
      throw InputError("", "prior.position", "no height and no terrain", "a height or --dtm");
    }
    region.height_at = [dtm, above = space.camera_height_m](const Eigen::Vector2d& xy) {
      return dtm->HeightAt(xy).value_or(0.0) + above;
    };
    region.height_sigma_m = space.camera_height_range_m;
  }
  region.pitch_deg = start_.pitch_deg.value_or(0.0);
  region.roll_deg = start_.roll_deg.value_or(0.0);
  region.tilt_scale_deg = space.tilt_scale_deg;
  return region;
}

void Tracker::Start(const PosePrior& prior) {
  start_ = prior;
  const Eigen::Vector3d& origin = localizer_.scene().model().origin_in_world;
  PoseRegion region = RegionAround(prior.position_in_world - origin.head<2>(), options_.start_m);
  if (prior.heading_deg) {
    region.heading_deg = *prior.heading_deg;
    region.heading_half_deg = std::min(180.0, localizer_.options().search.space.heading_deg);
  }
  filter_.Start(region);
  state_ = TrackState::kRelocalizing;
  state_reason_ = "the start is searched";
  log_odds_ = 0.0;
}

// The region that is searched follows the particles.
void Tracker::MoveRegion() {
  if (!filter_.has_particles()) return;
  const PoseBelief belief = filter_.Belief();
  const double reach_m =
      std::max(belief.radius_m, kOneInThousandPlane * SigmaOf(belief.main.covariance));
  PoseRegion region =
      RegionAround(belief.main.mean.head<2>(),
                   std::clamp(reach_m, options_.start_m, kWidest * options_.start_m));
  if (state_ == TrackState::kTracking) {
    region.pitch_deg = belief.main.mean(4);
    region.roll_deg = belief.main.mean(5);
  }
  filter_.SetRegion(region);
}

// The particles were led astray: the place is sought as at the start, around where they are.
void Tracker::StartAgain(const std::string& reason) {
  SeekAgain(reason);
  MoveRegion();
  PoseRegion region = filter_.region();
  if (!filter_.has_particles()) {  // once more in vain
    region.half_m = std::min(1.5 * region.half_m, kWidest * options_.start_m);
  }
  filter_.Start(region);
}

void Tracker::SeekAgain(const std::string& reason) {
  state_ = TrackState::kRelocalizing;
  state_reason_ = reason;
  log_odds_ = std::min(log_odds_, 0.0);
  unexplained_ = 0;
  last_key_.reset();
}

Motion Tracker::MotionOf(const TrackInput& input, std::string& reason) {
  double seconds = kFrameS;
  bool believed = input.motion.has_value();
  if (!believed) reason = input.motion_missing.empty() ? "no motion is known" : input.motion_missing;
  if (input.time_s && last_s_) {
    seconds = *input.time_s - *last_s_;
    if (seconds <= 0.0 || seconds > kGapS) {
      reason = Text("the time stamp jumps by %.1f s", seconds);
      believed = believed && seconds > 0.0;
    }
    if (seconds <= 0.0) seconds = kFrameS;
  }
  if (input.is_cut) {
    believed = false;
    reason = input.cut_reason.empty()
                 ? "the picture has nothing in common with the one before (a cut)"
                 : input.cut_reason;
  }
  const bool is_followed = believed && input.motion->length == StepLength::kFollowed;
  odometry_.Add(believed && !is_followed ? input.motion : std::nullopt);
  if (!believed) {
    since_last_key_m_ = NAN;
    return UnknownMotion(
        std::min(seconds, kGapS), options_.max_speed_m_s, options_.max_turn_deg_s);
  }
  Motion motion = InCameraAxes(*input.motion, axes_);
  length_ = motion.length;
  if (is_followed) return motion;
  if (length_ == StepLength::kGuessed && has_found_scale_) motion.scale_sigma = kFoundScale;
  motion.step_in_before *= scale_;
  motion.sigma_m *= scale_;
  motion.scale_sigma = std::max(motion.scale_sigma, scale_sigma_);
  return motion;
}

TrackLook Tracker::Choose(const TrackInput& input) const {
  if (input.picture.empty() || !input.camera) return TrackLook::kNone;
  if (state_ != TrackState::kTracking || !filter_.has_particles()) return TrackLook::kWide;
  const double sigma_m = SigmaOf(filter_.Belief().main.covariance);
  if (sigma_m > kWideSigmaM) return TrackLook::kWide;
  if (sigma_m > options_.key_sigma_m || since_key_m_ >= options_.key_distance_m) {
    return TrackLook::kClose;
  }
  return since_look_m_ >= options_.glance_distance_m ? TrackLook::kGlance : TrackLook::kNone;
}

PoseFilter::LogOther Tracker::OtherOf(const TrackInput& input) const {
  std::optional<Eigen::Vector2d> fix;
  // A fix helps to find the place; once tracked, it is watched, not followed.
  if (input.fix && state_ != TrackState::kTracking && !monitor_.verdict().lies) {
    fix = *input.fix - localizer_.scene().model().origin_in_world.head<2>();
  }
  return [=, &input, this](const PoseVector& v) {
    double sum = 0.0;
    if (input.heading_deg) {
      sum += Robust(HeadingDifferenceDeg(v(3), *input.heading_deg), options_.compass_sigma_deg);
    }
    if (input.pitch_deg) sum += Robust(v(4) - *input.pitch_deg, options_.tilt_sigma_deg);
    if (input.roll_deg) sum += Robust(v(5) - *input.roll_deg, options_.tilt_sigma_deg);
    if (fix) sum += Robust((v.head<2>() - *fix).norm(), options_.fix_sigma_m);
    return sum;
  };
}

PosePrior Tracker::SearchPrior(const TrackInput& input) const {
  const PoseRegion& region = filter_.region();
  const Eigen::Vector3d& origin = localizer_.scene().model().origin_in_world;
  PosePrior prior;
  prior.position_in_world = region.center + origin.head<2>();
  prior.height_in_world = region.height_at(region.center) + origin.z();
  if (region.heading_half_deg < 180.0) prior.heading_deg = region.heading_deg;
  prior.pitch_deg = input.pitch_deg ? input.pitch_deg : region.pitch_deg;
  prior.roll_deg = input.roll_deg ? input.roll_deg : region.roll_deg;
  return prior;
}

void Tracker::LookAt(const TrackInput& input, TrackLook look, TrackFrame& frame) {
  LocalizationInput query;
  query.picture = input.picture;
  query.camera = *input.camera;
  if (look == TrackLook::kGlance) {
    // A smaller picture of the same view, without distortion.
    const double scale = std::min(
        1.0, static_cast<double>(options_.glance_size_px) /
                 std::max(input.picture.cols, input.picture.rows));
    const PinholeCamera camera = input.camera->Pinhole().Scaled(scale);
    cv::resize(UndistortImage(input.picture, *input.camera),
               query.picture,
               {camera.width, camera.height},
               0.0,
               0.0,
               cv::INTER_AREA);
    query.camera = {"PINHOLE",
                    camera.width,
                    camera.height,
                    {camera.fx, camera.fy, camera.cx, camera.cy}};
  }
  const FrameEvidence evidence(localizer_, query, threads_);
  since_look_m_ = 0.0;
  if (!evidence.unusable().empty()) {
    frame.reason = evidence.unusable();
    return;
  }
  std::vector<PoseFilter::Proposal> proposals;
  if (look == TrackLook::kWide) {
    PoseSpaceOptions ranges = localizer_.options().search.space;
    const PoseRegion& region = filter_.region();
    ranges.east_m = ranges.north_m = region.half_m;
    ranges.heading_deg = region.heading_half_deg;
    PosePrior prior = SearchPrior(input);
    const HeightGrid* const dtm = localizer_.dtm();
    const auto ground = dtm ? dtm->HeightAt(region.center) : std::optional<double>();
    if (ground) {  // heights follow the terrain
      ranges.camera_height_m = region.height_at(region.center) - *ground;
      prior.height_in_world.reset();
    }
    const FrameEvidence::Modes found =
        evidence.Search(prior, ranges, seed_ + frames_, threads_);
    for (const FrameEvidence::Mode& mode : found.modes) {
      proposals.push_back({VectorOf(mode.cam_from_local), mode.log_ratio});
    }
    if (!found.modes.empty()) LearnOdometry(found.modes.front());
  }
  if (proposals.empty() && !filter_.has_particles()) {
    frame.reason = "no pose of the searched region sees the model";
    return;
  }
  const bool glance = look == TrackLook::kGlance;
  Random random(seed_, kTrackStage, frames_);
  const FilterUpdate update = filter_.Update(
      [&](std::span<const Pose> poses) {
        return evidence.LogRatios(poses, glance ? kGlanceCellM : kCellM, threads_);
      },
      OtherOf(input),
      proposals,
      glance ? 0.4 : 1.0,
      random);
  frame.look = look;
  frame.effective_samples = update.effective_samples;
  frame.evidence_nat = update.highest_log_ratio;
  frame.evidence = update.evidence;
  if (glance) return;
  const PoseBelief belief = filter_.Belief();
  since_key_m_ = 0.0;
  Judge(evidence, look, belief.main.mass, PoseOf(belief.main.mean));
  LearnScale(belief.main);
}

void Tracker::Judge(const FrameEvidence& evidence, TrackLook look, double mass, const Pose& pose) {
  const Goodness goodness = evidence.GoodnessAt(pose);
  if (!goodness.is_known()) return;
  explained_ = goodness.explained();
  unexplained_ = explained_ < kExplained ? unexplained_ + 1 : 0;
  const double says =
      std::clamp(kOddsPerExplained * (explained_ - kEvenExplained), -kMostSaid, kMostSaid);
  log_odds_ = std::clamp(kForget * log_odds_ + says, -kMostOdds, kMostOdds);
  if (look == TrackLook::kWide && mass < 0.5) log_odds_ = std::min(log_odds_, 0.0);
}

void Tracker::LearnScale(const PoseBell& now) {
  const double sigma_m = SigmaOf(now.covariance);
  const bool is_sure =
      has_one_scale_ && now.mass > 0.95 && sigma_m < 0.6 && log_odds_ > 0.0;
  if (!is_sure) {
    last_key_.reset();
    return;
  }
  if (last_key_ && std::isfinite(since_last_key_m_) && since_last_key_m_ > 1.5) {
    const double way_m = (now.mean - last_key_->mean).head<3>().norm();
    const double ratio = way_m / since_last_key_m_;
    const double ratio_sigma =
        std::hypot(sigma_m, SigmaOf(last_key_->covariance), 0.1) / since_last_key_m_;
    // A Kalman filter of one number; what is far from it is a mode that jumped.
    const double variance = scale_sigma_ * scale_sigma_ + 1e-6;
    if (std::abs(ratio - 1.0) < 3.0 * std::hypot(scale_sigma_, ratio_sigma)) {
      const double gain = variance / (variance + ratio_sigma * ratio_sigma);
      scale_ *= 1.0 + gain * (ratio - 1.0);
      scale_sigma_ = std::max(0.005, std::sqrt((1.0 - gain) * variance));
    }
  }
  last_key_ = now;
  since_last_key_m_ = 0.0;
}

void Tracker::LearnOdometry(const FrameEvidence::Mode& best) {
  odometry_.Add(best.cam_from_local);
  const bool is_guessed = length_ == StepLength::kGuessed;
  const auto finding = odometry_.Find(is_guessed);
  if (!finding) return;
  const bool other_axes = finding->axes != axes_;
  const double off = std::abs(std::log(finding->scale / scale_));
  const bool other_scale = is_guessed ? !has_found_scale_ || off > kFoundScale : off > kSameScale;
  if (!other_axes && !other_scale) return;
  axes_ = finding->axes;
  scale_ = finding->scale;
  if (is_guessed) {
    has_found_scale_ = true;
  } else {
    scale_sigma_ = 0.05;
  }
  std::string note = "the odometry agrees with the pictures";
  if (other_axes) note += std::string(" in ") + NameOf(axes_) + " axes";
  if (other_scale) note += Text(", its lengths times %.3f", scale_);
  if (other_axes && !other_scale) note += " only";
  notes_.push_back(note + Text(" (%.0f pictures); it is taken so", finding->agreeing));
  // What was followed so far was led astray, unless a guess is made better only.
  if (other_axes || !is_guessed) filter_.Start(filter_.region());
}

void Tracker::Watch(const TrackInput& input, TrackFrame& frame) {
  if (!input.fix || !input.time_s || state_ != TrackState::kTracking || !frame.pose) {
    if (monitor_.verdict().lies) frame.gnss = monitor_.verdict();
    return;
  }
  frame.gnss = monitor_.Add(*input.time_s,
                            *input.fix,
                            frame.pose->center_in_world.head<2>(),
                            SigmaOf(frame.covariance));
}

void Tracker::Decide(const PoseBelief& belief, TrackFrame& frame) {
  const Eigen::Vector3d& origin = localizer_.scene().model().origin_in_world;
  frame.explained = explained_;
  frame.confidence = belief.main.mass * Probability(log_odds_);
  frame.covariance = belief.main.covariance;
  frame.covariance.diagonal().head<3>().array() += kModelFloorM * kModelFloorM;
  frame.covariance.diagonal().tail<3>().array() += kModelFloorDeg * kModelFloorDeg;
  const double sigma_m = SigmaOf(frame.covariance);
  if (state_ == TrackState::kTracking) {
    if (unexplained_ >= kUnexplainedLooks) {
      StartAgain("the pictures do not show what the model shows there");
    } else if (frame.confidence < options_.seek_below) {
      SeekAgain("other poses explain the pictures about as well");
    }
  } else if (unexplained_ >= kUnexplainedLooks) {
    StartAgain("no pose that was searched explains the pictures");
  } else if (frame.confidence >= options_.tracking_from) {
    state_ = TrackState::kTracking;
    state_reason_.clear();
  }
  const double radius_m = std::max(belief.radius_m, kOneInThousandPlane * sigma_m);
  const bool is_vague = kOneInThousandPlane * sigma_m > options_.lost_radius_m;
  if (is_vague && state_ == TrackState::kTracking) {
    SeekAgain(Text("nothing was seen for so long that the position is known to %.0f m only",
                   radius_m));
  }
  const bool is_lost = is_vague || belief.main.mass < kLeastMass;
  frame.confidence =
      std::min(frame.confidence, belief.main.mass * Probability(log_odds_));
  frame.state = state_;
  if (is_lost) {
    frame.state = TrackState::kLost;
    frame.confidence = 0.0;
  } else {
    frame.pose = LocalFrame{origin}.ToWorld(PoseOf(belief.main.mean));
  }
  if (state_ == TrackState::kTracking) {
    frame.protection = ProtectionLevel{
        radius_m, kOneInThousandLine * std::sqrt(frame.covariance(3, 3))};
  } else if (frame.reason.empty()) {
    frame.reason = state_reason_;
  }
}

TrackFrame Tracker::Step(const TrackInput& input) {
  const auto begin = std::chrono::steady_clock::now();
  ++frames_;
  TrackFrame frame;
  frame.id = input.id;
  frame.time_s = input.time_s;
  frame.fix = input.fix;
  if (frames_ > 1) {
    const Motion motion = MotionOf(input, frame.reason);
    if (input.is_cut) StartAgain(frame.reason);
    const double way_m = motion.step_in_before.norm();
    since_look_m_ += way_m;
    since_key_m_ += way_m;
    since_last_key_m_ += way_m;
    filter_.Predict(motion);
    has_one_scale_ = has_one_scale_ && motion.scale_sigma < kOneScale;
    frame.motion = motion;
    MoveRegion();
  }
  if (input.time_s) last_s_ = input.time_s;
  if (input.picture.empty()) frame.reason = "the picture is missing or cannot be read";
  const TrackLook look = Choose(input);
  if (look != TrackLook::kNone) LookAt(input, look, frame);
  if (filter_.has_particles()) {
    Decide(filter_.Belief(), frame);
  } else {
    frame.state = TrackState::kLost;
    if (frame.reason.empty()) frame.reason = state_reason_;
  }
  Watch(input, frame);
  frame.milliseconds =
      1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return frame;
}

}  // namespace ridgeline
