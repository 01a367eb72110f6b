// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "camera/pose.h"
#include "score/building_fit.h"
#include "score/position_view.h"

namespace ridgeline {

// Compares a picture with what the model shows from a pose. Thread-safe; never sees the truth.
// The scores there are: score_table.h.
class Score {
 public:
  // Memory that one thread uses again and again, so that a pose costs no allocation. A score that
  // needs more than this derives its own.
  struct Workspace {
    virtual ~Workspace() = default;
    std::vector<ProjectedSegment> segments;
  };

  virtual ~Score() = default;

  // What LogRatio() reads of a view.
  virtual ViewParts parts() const = 0;

  // Why this picture gives every pose the energy 1, in words ("the picture has no lines"); empty if
  // it does not.
  virtual const char* unusable() const { return ""; }

  virtual std::unique_ptr<Workspace> NewWorkspace() const { return std::make_unique<Workspace>(); }

  // Log likelihood ratio of the pose against chance, or what comes nearest to it; higher is better.
  // Without anything of the model in view it is -infinity. `workspace` is one of NewWorkspace().
  virtual double LogRatio(const PositionView& view,
                          const Pose& cam_from_local,
                          Workspace& workspace) const = 0;

  // The same for many orientations at the place of one view: log_ratios[i] is that of poses[i].
  virtual void LogRatios(const PositionView& view,
                         std::span<const Pose> poses,
                         Workspace& workspace,
                         std::span<double> log_ratios) const;

  // How well the edges of each building in view are seen, by building; empty: the score cannot
  // tell.
  virtual std::vector<BuildingFit> BuildingFits(const PositionView& /*view*/,
                                                const Pose& /*cam_from_local*/,
                                                Workspace& /*workspace*/) const {
    return {};
  }

  // The same score with a tolerance of the model's errors that is wider by a factor > 1, for poses
  // on a coarse grid. Refers to this one's picture. Null: the tolerance is the same on any grid.
  virtual std::unique_ptr<Score> Tolerant(double factor) const;

  // The same score, quick for poses under one of a few tilts: rotations from a level frame (right,
  // ahead, up) into the camera, turned by any heading. Values differ by the rounding of headings to
  // a quarter of a degree. Refers to this one's picture. Null: nothing is to be gained.
  virtual std::unique_ptr<Score> ForTilts(std::span<const Eigen::Matrix3f> cam_from_level) const;

  // [0, 1], 0 best: 1 / (1 + exp(log_ratio / 10)); 1 where nothing is in view.
  static double EnergyOf(double log_ratio);
  // The inverse, for scores that are energies by themselves.
  static double LogRatioOf(double energy);
};

}  // namespace ridgeline
