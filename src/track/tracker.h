// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "camera/intrinsics.h"
#include "camera/pose_prior.h"
#include "localize/frame_evidence.h"
#include "localize/localizer.h"
#include "track/gnss_monitor.h"
#include "track/odometry_check.h"
#include "track/pose_filter.h"
#include "track/track_options.h"

namespace ridgeline {

// One frame as it comes.
struct TrackInput {
  std::string id;
  std::optional<double> time_s;
  cv::Mat picture;  // 8-bit BGR as taken; empty: missing
  std::optional<CameraIntrinsics> camera;
  std::optional<Motion> motion;  // since the frame before; absent: not known
  std::string motion_missing;    // why, in words
  // What instruments say of the attitude, grid angles [deg].
  std::optional<double> heading_deg;
  std::optional<double> pitch_deg;
  std::optional<double> roll_deg;
  std::optional<Eigen::Vector2d> fix;  // GNSS, world east and north [m]
  bool is_cut = false;                 // the picture has nothing of the one before
  std::string cut_reason;              // why, in words; may be empty
};

enum class TrackState : std::uint8_t { kTracking, kRelocalizing, kLost };
// "tracking", "relocalizing", "lost".
const char* NameOf(TrackState state);

// What was done with a frame's picture.
enum class TrackLook : std::uint8_t { kNone, kGlance, kClose, kWide };
// "none", "glance", "close", "wide".
const char* NameOf(TrackLook look);

struct TrackFrame {
  std::string id;
  std::optional<double> time_s;
  TrackState state = TrackState::kLost;
  std::string reason;  // of a state other than tracking, and of what went wrong; may be empty
  TrackLook look = TrackLook::kNone;
  std::optional<Pose> pose;  // world; absent: lost
  PoseCovariance covariance = PoseCovariance::Zero();  // as PoseVector
  std::optional<ProtectionLevel> protection;           // present while tracking
  double confidence = 0.0;
  double explained = 0.0;  // Goodness::explained() of a close look, else that of the last
  double evidence_nat = 0.0;
  double effective_samples = 0.0;
  double milliseconds = 0.0;
  std::optional<GnssMonitor::Verdict> gnss;
  // For a smoother: the bells of the picture's own evidence, local frame; empty: none.
  std::vector<PoseBell> evidence;
  std::optional<Motion> motion;  // since the frame before, in the scale that was found
  std::optional<Eigen::Vector2d> fix;
};

// Follows a camera through a city model from what its pictures say and how it has moved. Causal: a
// frame's result knows nothing of later frames. Not thread-safe.
class Tracker {
 public:
  // The localizer must outlive the tracker. Throws InputError for options out of range.
  Tracker(const Localizer& localizer, const TrackOptions& options, std::uint64_t seed, int threads);

  // Where to begin. Throws InputError for a prior without height where there is no terrain.
  void Start(const PosePrior& prior);

  TrackFrame Step(const TrackInput& input);

  // What was found out about the odometry, in words; each once.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  Motion MotionOf(const TrackInput& input, std::string& reason);
  TrackLook Choose(const TrackInput& input) const;
  void LookAt(const TrackInput& input, TrackLook look, TrackFrame& frame);
  PoseFilter::LogOther OtherOf(const TrackInput& input) const;
  PosePrior SearchPrior(const TrackInput& input) const;
  void MoveRegion();
  void SeekAgain(const std::string& reason);
  void StartAgain(const std::string& reason);
  void Judge(const FrameEvidence& evidence, TrackLook look, double mass, const Pose& pose);
  void Decide(const PoseBelief& belief, TrackFrame& frame);
  void Watch(const TrackInput& input, TrackFrame& frame);
  void LearnScale(const PoseBell& now);
  void LearnOdometry(const FrameEvidence::Mode& best);
  PoseRegion RegionAround(const Eigen::Vector2d& center, double half_m) const;

  const Localizer& localizer_;
  TrackOptions options_;
  std::uint64_t seed_;
  int threads_;
  std::uint64_t frames_ = 0;
  PosePrior start_;
  PoseFilter filter_;
  GnssMonitor monitor_;
  OdometryCheck odometry_;
  TrackState state_ = TrackState::kRelocalizing;
  std::string state_reason_;
  std::optional<double> last_s_;
  // Odds (log) that the particles are where the camera is, by how pictures are explained there.
  double log_odds_ = 0.0;
  double explained_ = 0.0;
  int unexplained_ = 0;  // close looks in a row
  double since_look_m_ = 0.0;  // way since a look, and since a close one
  double since_key_m_ = 0.0;
  OdometryAxes axes_ = OdometryAxes::kCamera;
  double scale_ = 1.0;
  double scale_sigma_ = 0.0;
  StepLength length_ = StepLength::kMeasured;  // of the last step
  bool has_found_scale_ = false;               // of steps whose length is guessed
  bool has_one_scale_ = true;  // all motions come from one odometry
  std::optional<PoseBell> last_key_;  // confident, for the scale
  double since_last_key_m_ = 0.0;
  std::vector<std::string> notes_;
};

}  // namespace ridgeline
