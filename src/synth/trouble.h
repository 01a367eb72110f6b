// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/options.h"
#include "synth/town.h"

namespace ridgeline {

// How a model and a camera file differ from what the pictures show, beyond the errors of a good
// survey (docs/synth.md, Trouble). All of it follows from the town's seed.
struct TroubleOptions {
  // Share of the buildings whose roof or outline is wrong, each drawn on its own.
  double wrong_share = 0.3;
  // Roofs of these are too high or too low by up to this, uniformly: eaves and ridge each [m].
  double roof_m = 0.0;
  // Outlines of these are shifted, and longer and deeper or less so, by up to this [m].
  double outline_m = 0.0;
  // Share of the buildings that the model lacks: newer than it.
  double missing_share = 0.0;
  // Share of the buildings of the model that no longer stand.
  double gone_share = 0.0;
  // Focal lengths in the camera file are wrong by up to this, as a share of them.
  double focal_share = 0.0;
  // 1: all roofs of the model are flat, halfway between eaves and ridge (LoD1); 2: as they are.
  int lod = 2;

  void Visit(OptionVisitor& v) {
    v.Field("wrong_share", wrong_share, Closed(0.0, 1.0));
    v.Field("roof_m", roof_m, Closed(0.0, 5.0));
    v.Field("outline_m", outline_m, Closed(0.0, 5.0));
    v.Field("missing_share", missing_share, Closed(0.0, 1.0));
    v.Field("gone_share", gone_share, Closed(0.0, 1.0));
    v.Field("focal_share", focal_share, RightOpen(0.0, 0.9));
    v.Field("lod", lod, Closed(1, 2));
  }
};

// The town as it stands: without the buildings that are gone. Parts go with their building.
Town StandingTown(const Town& town, const TroubleOptions& options);

// The town as the model has it: without the buildings that it lacks, roofs and outlines wrong, and
// flat in LoD1. Parts move with their building.
Town ModelledTown(const Town& town, const TroubleOptions& options);

// The factor on a picture's focal length in the camera file; `key` addresses the picture.
double FocalFactor(const TroubleOptions& options, int seed, std::uint64_t key);

}  // namespace ridgeline
