// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "city/city_model.h"
#include "eval/provenance.h"
#include "input/assumption.h"
#include "localize/localization.h"

namespace ridgeline {

// "ok", "doubtful" (a pose, with doubts) or "abstained" (none).
std::string StatusOf(const Localization& localization);

// A localization as JSON (pose.json): status and reason; the pose as position with
// cam_from_world_wxyz, heading / pitch / roll, omega / phi / kappa of photogrammetry and of Loeper
// et al., COLMAP's translation relative to the model's origin, and latitude / longitude; energy,
// confidence, 95 % region, modes; what was assumed of the input. The same bytes for the same
// result: no times.
std::string PoseJson(const std::string& picture,
                     const Localization& localization,
                     const CityModel& model,
                     const std::vector<Assumption>& assumptions);

// Stage times, evaluations, seed, version, resolved options and hashed inputs (report.json).
// @param folder  That the inputs' paths are relative to.
std::string RunJson(const Localization& localization,
                    std::uint64_t seed,
                    const std::string& version,
                    const std::string& options_json,
                    const std::vector<Assumption>& assumptions,
                    const std::vector<HashedFile>& inputs,
                    const std::string& folder);

}  // namespace ridgeline
