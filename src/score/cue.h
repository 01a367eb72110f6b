// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "base/option_groups.h"
#include "projection/scene.h"
#include "score/picture_evidence.h"
#include "score/position_view.h"

namespace ridgeline {

// A pose to judge, with what several cues read of it.
struct CuePose {
  const PositionView& view;
  Eigen::Matrix3f cam_from_local;              // rotation
  std::span<const ProjectedSegment> segments;  // visible edges [px of PictureEvidence::camera()]
};

// A piece of evidence for a pose in one picture: a log likelihood ratio against chance up to a
// factor (its samples are correlated). A cue that tells several things apart at the price of one,
// as the kinds of edges, has a value for each. Thread-safe; no allocation per pose.
class Cue {
 public:
  // Memory that one thread uses again and again.
  struct Workspace {
    virtual ~Workspace() = default;
  };

  virtual ~Cue() = default;

  // Null: the cue needs none.
  virtual std::unique_ptr<Workspace> NewWorkspace() const { return nullptr; }

  // @param workspace  One of NewWorkspace().
  // @param log_ratios  One for each name of the plug-in, to be set; 0 says nothing.
  virtual void LogRatios(const CuePose& pose,
                         Workspace* workspace,
                         std::span<float> log_ratios) const = 0;

  // Whether LogRatiosOfMany() is to be called in place of LogRatios(): for a cue to which a call is
  // dear, such as one of another language.
  virtual bool TakesMany() const { return false; }

  // The same for poses of one place (local frame): the values of a pose next to each other.
  // Thread-safe, but with allocations.
  virtual void LogRatiosOfMany(const PositionView& /*view*/,
                               std::span<const Pose> /*poses*/,
                               std::span<float> /*log_ratios*/) const {}

  // As Score::Tolerant(). Null: the tolerance does not matter.
  virtual std::shared_ptr<const Cue> Tolerant(double /*factor*/) const { return nullptr; }
  // As Score::ForTilts(). Null: nothing is to be gained.
  virtual std::shared_ptr<const Cue> ForTilts(
      std::span<const Eigen::Matrix3f> /*cam_from_level*/) const {
    return nullptr;
  }
};

struct CuePlugin;

// What a cue is made for; must outlive it.
struct CueContext {
  const PictureEvidence& picture;
  const Scene& scene;
  const OptionGroups& options;  // EvidenceOptions::cues
  // The plug-in that makes it, for those that share a `make`.
  const CuePlugin* plugin = nullptr;
};

struct CueName {
  const char* name;  // of its weight and in reports
  double weight;     // the default
};

// How a cue joins the table (cue_table.cc). It is documented beside its definition, with its
// source.
struct CuePlugin {
  std::span<const CueName> names;
  ViewParts parts;                 // what it reads of a view
  void (*declare)(OptionGroups&);  // adds its options
  std::shared_ptr<const Cue> (*make)(const CueContext&);
};

}  // namespace ridgeline
