// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "camera/focal_length.h"
#include "camera/intrinsics.h"
#include "camera/pose_prior.h"
#include "city/city_model.h"
#include "city/terrain.h"
#include "localize/localization.h"
#include "localize/localizer_options.h"

namespace ridgeline {

// A picture to localize.
struct LocalizationInput {
  cv::Mat picture;  // as it was taken: 8 or 16 bit; grey, colour or with alpha
  CameraIntrinsics camera;
  PosePrior prior;
  // What the camera's focal length may be where it is not known for sure, the camera's own first:
  // each is tried, and the picture decides. Empty: it is known.
  std::vector<FocalHypothesis> focal_lengths;
  // Undistorted segments of another detector, for lines.detector = "file".
  std::optional<std::vector<LineSegment>> lines;
};

// Finds poses of pictures in one city model. The constructor does the costly work.
class Localizer {
 public:
  // `model` must outlive the localizer. Without a DTM priors need a height. Throws InputError for
  // options that are out of range.
  Localizer(const CityModel& model,
            std::optional<HeightGrid> dtm,
            const LocalizerOptions& options);
  ~Localizer();

  // Thread-safe; the result depends on input, options and seed only. Throws InputError for a picture
  // whose size is not the camera's, and for a prior off the DTM or outside of the model.
  Localization Localize(const LocalizationInput& input, std::uint64_t seed, int threads) const;

  // The same with other half-ranges of the search box.
  Localization Localize(const LocalizationInput& input,
                        const PoseSpaceOptions& ranges,
                        std::uint64_t seed,
                        int threads) const;

  const Scene& scene() const;
  const HeightGrid* dtm() const;
  const Footprints& footprints() const;
  const LocalizerOptions& options() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// 8-bit BGR of any picture that can be decoded.
cv::Mat BgrOf(const cv::Mat& picture);

}  // namespace ridgeline
