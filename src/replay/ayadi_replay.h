// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "projection/scene.h"
#include "track/skyline_tracker.h"

namespace ridgeline {

// The methods of Table 1 of Ayadi et al., in its order.
enum class AyadiMethod : std::size_t { kInstruments, k2d, k2x2d, k3d };
inline constexpr std::array<const char*, 4> kAyadiMethods = {"instruments", "2d", "2x2d", "3d"};
inline constexpr std::size_t kAyadiMethodCount = kAyadiMethods.size();

// A way to do all of it.
struct AyadiVariant {
  std::string name;   // "printed", "corrected"
  std::string words;  // for people
  SkylineTrackOptions options;
  bool rendered = false;  // the virtual skyline from rendered images, as printed; else exact
};

// As printed: Canny and multistage graph, plain L1, shifts to angles in proportion, simplex alone,
// each frame from its sensors. Corrected: the path through the sky's likelihood, robust L1, the
// arctangent, a scan before the simplex; each frame from its sensors, too.
std::vector<AyadiVariant> AyadiVariants();

// What the instruments say of a frame, and its picture.
struct AyadiFrame {
  std::string id;
  cv::Mat picture;  // 8-bit BGR, undistorted
  PinholeCamera camera;
  Pose instruments;           // cam_from_local
  std::optional<Pose> truth;  // cam_from_local
};

// A frame after all four methods.
struct AyadiResult {
  std::string id;
  Skyline skyline;  // as extracted [px of the picture]
  std::array<Pose, kAyadiMethodCount> pose;
  std::array<double, kAyadiMethodCount> l1_px{};        // [px at 640], of the variant's own L1
  std::array<double, kAyadiMethodCount> plain_l1_px{};  // equation 1 over all columns
  std::array<double, kAyadiMethodCount> heading_error_deg{};  // NaN: no truth
  std::array<double, kAyadiMethodCount> total_ms{};  // extraction, clean-up, match
  std::array<int, kAyadiMethodCount> evaluations{};
  bool usable = true;  // false: no skyline in the picture; poses are the instruments'
};

AyadiResult ReplayFrame(const Scene& scene, const AyadiVariant& variant, const AyadiFrame& frame);

// Sizes of a skyline's point list (Table 2, Fig. 8).
struct SimplifiedSkyline {
  double precision_px = 0.0;
  std::size_t points = 0;        // as extracted
  std::size_t without_outliers = 0;  // after Algorithm 1
  std::size_t simplified = 0;    // after Douglas-Peucker
  std::vector<Eigen::Vector2f> line;
};
// Of the seen columns. @param precision_px  in pixels of the skyline's picture.
SimplifiedSkyline Simplified(const Skyline& skyline, double precision_px);

// Fig. 9: the least distance of a 3D match at positions around a pose [px at 640], row-major from
// south to north.
struct AyadiDomain {
  double half_range_m = 5.0;
  double spacing_m = 0.5;
  int cells = 0;  // a side
  std::vector<double> distance_px;
};
AyadiDomain ExploreDomain(const Scene& scene,
                          const AyadiVariant& variant,
                          const AyadiFrame& frame,
                          const Skyline& skyline,
                          double half_range_m,
                          double spacing_m,
                          int threads);

}  // namespace ridgeline
