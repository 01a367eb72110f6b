// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "camera/intrinsics.h"
#include "city/city_model.h"
#include "localize/localizer_options.h"

namespace ridgeline {

// One circumstance that is changed while all others stay, in levels.
//   edges       share of the model's edges that are kept (drawn; faces and skyline stay whole) [%]
//   clutter     share of the picture covered by opaque rectangles of any colour and angle [%]
//   heights     standard deviation of an error of each building's height [m]
//   footprints  standard deviation of a shift of each building, east and north [m]
//   focal       error of the focal length [%]
//   size        longer side of the picture that is compared [px]
//   detector    of lines
struct Variation {
  std::string name;
  std::string meaning;  // for axes, e.g. "error of the focal length [%]"
  std::vector<std::string> levels;
};

// All of them, with their default levels.
const std::vector<Variation>& Variations();

// "heights" or "heights=0,0.5,2". Throws InputError("--vary", ...) for a name that is none (with
// the nearest) and for levels that are not possible.
Variation ParseVariation(const std::string& text);

// What a level of a variation makes of the model, a picture, its camera and the options; the input
// itself where the variation does not touch it. The draws depend on the seed (and for a picture on
// the query) alone, and those of a larger level are those of a smaller one, scaled.
CityModel VariedModel(const CityModel& model,
                      const Variation& variation,
                      const std::string& level,
                      std::uint64_t seed);
cv::Mat VariedPicture(const cv::Mat& picture,
                      const Variation& variation,
                      const std::string& level,
                      std::uint64_t seed,
                      const std::string& query_id);
CameraIntrinsics VariedCamera(const CameraIntrinsics& camera,
                              const Variation& variation,
                              const std::string& level);
LocalizerOptions VariedOptions(const LocalizerOptions& options,
                               const Variation& variation,
                               const std::string& level);

}  // namespace ridgeline
