// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "base/options.h"
#include "camera/intrinsics.h"
#include "projection/scene.h"
#include "skyline/skyline.h"

namespace ridgeline {

// L1 distances are given in pixels of a picture of this width, the size of the paper's pictures, so
// that cameras of any resolution compare.
inline constexpr double kSkylineReferenceWidthPx = 640.0;

struct SkylineL1Options {
  static constexpr int kMaxColumns = 640;
  // Precision of the clean-up of the real skyline (Algorithm 1, Douglas-Peucker) [px at 640]; 0:
  // none.
  double precision_px = 2.0;
  // L1 distance at which the energy is 1/2 [px at 640].
  double half_energy_px = 20.0;
  // Leave out unknown columns, weigh the others by their confidence, and limit what one column can
  // count. False: the paper's plain mean over all columns.
  bool robust = true;
  // Most that a column counts if robust [px at 640]: where there is sky below the virtual skyline,
  // and where the real one is above it. The second is common, since trees and what the model lacks
  // hide the sky.
  double max_deviation_px = 60.0;
  double max_obstructed_px = 20.0;
  // Columns compared, spread evenly over the picture; at most 640.
  int columns = 320;
  // Least share of known columns for the picture to be usable.
  double min_known_share = 0.1;

  void Visit(OptionVisitor& v) {
    v.Field("precision_px", precision_px, NotNegative());
    v.Field("half_energy_px", half_energy_px, Positive());
    v.Field("robust", robust);
    v.Field("max_deviation_px", max_deviation_px, Positive());
    v.Field("max_obstructed_px", max_obstructed_px, Positive());
    v.Field("columns", columns, Closed(8, kMaxColumns));
    v.Field("min_known_share", min_known_share, Closed(0.0, 1.0));
  }
};

// What a real skyline is worth.
enum class SkylineUse : std::uint8_t {
  kUsable,
  kNoSky,        // no column shows sky: the skyline is above the picture, or hidden everywhere
  kTooFewKnown,  // sky is seen, but in too few columns
};

// In words, for reports.
const char* ReasonOf(SkylineUse use);

// Unit vectors to the points of a virtual skyline, by azimuth.
std::vector<Eigen::Vector3f> SkylineDirections(const VisibleSet& visible);

// Mean distance between the skyline of a picture and a virtual one (Ayadi et al., equation 1,
// divided by the picture's width). Both are limited to the picture: where the real skyline is above
// it, a virtual one above it agrees. Columns that the virtual skyline does not reach count the
// most. Thread-safe; no allocation.
class SkylineL1 {
 public:
  // @param camera  Of the picture that `real` was found in.
  SkylineL1(const Skyline& real, const PinholeCamera& camera, const SkylineL1Options& options);

  // [px at 640]
  double Distance(std::span<const Eigen::Vector3f> directions,
                  const Eigen::Matrix3f& cam_from_world) const;
  // The same for rows of the virtual skyline [px of camera()], one per column of it; NaN: none.
  double DistanceOfRows(std::span<const float> rows) const;
  // distance / (distance + half_energy_px); 1 for a picture that is not usable.
  double Energy(double distance_px) const;

  SkylineUse use() const { return use_; }
  // The picture's camera, scaled to one pixel per column compared.
  const PinholeCamera& camera() const { return camera_; }
  // The cleaned real skyline, one row per column of camera() [px of it], and the columns' weights.
  std::span<const float> rows() const { return rows_; }
  std::span<const float> weights() const { return weights_; }

 private:
  SkylineUse use_ = SkylineUse::kUsable;
  PinholeCamera camera_;
  double half_energy_px_ = 0.0;
  float max_deviation_ = 0.0f;   // [px of camera_]
  float max_obstructed_ = 0.0f;  // [px of camera_]
  float px_scale_ = 1.0f;        // [px at 640 per px of camera_]
  std::vector<float> rows_;
  std::vector<float> weights_;
  double weight_sum_ = 0.0;
};

}  // namespace ridgeline
