// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "track/track_smoother.h"
#include "track/tracker.h"

namespace ridgeline {

// A frame of a track with what is known of it in the end.
struct TrackRow {
  TrackFrame frame;
  std::optional<SmoothedPose> smoothed;
  std::optional<Pose> truth;  // world
};

// One row per frame: state and reason; the causal pose (east, north, height, heading, pitch, roll,
// quaternion) with its standard deviations, protection level and confidence; the smoothed pose with
// its deviations; errors against the truth; time. What there is not is empty.
std::string TrackCsv(std::span<const TrackRow> rows);

// A TUM trajectory: "timestamp tx ty tz qx qy qz qw", world_from_camera; frames without time count
// from 0 in seconds. Smoothed poses, or the causal ones.
std::string TrackTum(std::span<const TrackRow> rows, bool smoothed);

// The causal or the smoothed poses.
std::vector<std::optional<Pose>> PosesOf(std::span<const TrackRow> rows, bool smoothed);

}  // namespace ridgeline
