// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <istream>
#include <memory>
#include <optional>
#include <string>

#include "cli/track_input.h"

namespace ridgeline {

// The pictures of a folder as they appear, by name. Ends when none has come for `idle_s`. A picture
// that is still being written is waited for.
// @param odometry  File that may grow too; read again at each frame. Empty: none.
std::unique_ptr<TrackFrames> FollowFolder(const std::string& folder,
                                          const std::string& odometry,
                                          const CameraIntrinsics& camera,
                                          double idle_s);

// Frames from lines: the path of a picture, or a JSON object with "image" and, as far as known, "id",
// "time_s", "motion" {"step_m": [x, y, z], "before_from_now_wxyz": [...], "sigma_m", "sigma_deg"},
// "heading_deg", "pitch_deg", "roll_deg", "speed_m_s". Ends with the stream. A line that is neither
// throws InputError with its number.
std::unique_ptr<TrackFrames> FramesOfLines(std::istream& lines, const CameraIntrinsics& camera);

}  // namespace ridgeline
