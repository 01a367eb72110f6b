// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "camera/intrinsics.h"
#include "localize/pose_space.h"
#include "projection/scene.h"
#include "score/position_view.h"
#include "score/score.h"

namespace ridgeline {

// A pose tried: offset from the prior and log likelihood ratio.
struct ScoredPose {
  PoseSpace::Offset offset;
  double log_ratio = 0.0;
};

// Orientations to be tried at many places.
struct Orientations {
  std::vector<Eigen::Quaterniond> cam_from_local;
  std::vector<double> log_priors;
};

// Judges the poses of a search space by a score: looks from a place, then compares the picture with
// what is seen there under any orientation. Thread-safe; a Look belongs to one thread.
class PoseScorer {
 public:
  // All must outlive the scorer.
  // @param camera  Of the picture that the score compares.
  // @param surface_step_deg  Resolution of the surfaces seen from a place.
  PoseScorer(const Score& score,
             const Scene& scene,
             const PoseSpace& space,
             const PinholeCamera& camera,
             double surface_step_deg);

  // The same with another score, or in another space.
  PoseScorer With(const Score& score) const;
  PoseScorer In(const PoseSpace& space) const;

  const Score& score() const { return *score_; }
  const Scene& scene() const { return *scene_; }
  const PoseSpace& space() const { return *space_; }
  const PinholeCamera& camera() const { return *camera_; }

  // Where to look for orientations within half-ranges [deg] of `center`.
  PanoramaRange RangeAround(const ViewAngles& center, const ViewAngles& half_ranges) const;

  // Where to look for the orientations of offsets (at least one).
  PanoramaRange RangeOver(std::span<const PoseSpace::Offset> offsets) const;

  // Orientations of offsets, whose places do not matter.
  Orientations OrientationsOf(std::span<const PoseSpace::Offset> offsets) const;

  // What one thread sees from a place, with its memory: an orientation costs no allocation.
  class Look {
   public:
    explicit Look(const PoseScorer& scorer);

    // Looks from a place (local). The other functions then hold for orientations in the range, at
    // the place or so near to it that nothing else is seen.
    void From(const Eigen::Vector3d& position, const PanoramaRange& range);
    const PositionView& view() const { return view_; }
    Score::Workspace& workspace() { return *workspace_; }

    // What the picture says, without the prior.
    double PictureLogRatio(const Pose& cam_from_local);
    // With the prior, for the orientation of an offset.
    double LogRatio(const Eigen::Vector3d& position, const PoseSpace::Offset& offset);
    // The same for many orientations at the place looked from; valid until the next call.
    std::span<const double> LogRatios(const Orientations& orientations);

   private:
    const PoseScorer& scorer_;
    std::unique_ptr<Score::Workspace> workspace_;
    Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
    PositionView view_;
    std::vector<Pose> poses_;
    std::vector<double> log_ratios_;
  };

  // Of one pose, with a look of its own; nullopt: not admissible.
  std::optional<double> LogRatioAt(const PoseSpace::Offset& offset) const;

 private:
  const Score* score_;
  const Scene* scene_;
  const PoseSpace* space_;
  const PinholeCamera* camera_;
  double surface_step_rad_;
};

}  // namespace ridgeline
