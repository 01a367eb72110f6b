// SPDX-License-Identifier: Apache-2.0
#include "replay/ayadi_replay.h"

#include <chrono>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "skyline/clean_skyline.h"
#include "track/rendered_skyline.h"

namespace ridgeline {
namespace {

using Clock = std::chrono::steady_clock;

double MillisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

Skyline Extracted(const cv::Mat& picture, const SkylineTrackOptions& options) {
  return options.extractor == "canny" ? ExtractCannySkyline(picture, options.canny)
                                      : ExtractSkyline(picture, options.skyline);
}

SkylineSource SourceOf(const Scene& scene, const AyadiVariant& variant, const PinholeCamera& camera) {
  if (!variant.rendered) {
    return [&scene](const Eigen::Vector3d& position, const Sector& sector) {
      return SkylineDirections(scene.SkylineFrom(position, sector));
    };
  }
  // As fine as the columns that are compared.
  const double px_per_rad = camera.fx * variant.options.canny.work_width_px / camera.width;
  return [&scene, &variant, px_per_rad](const Eigen::Vector3d& position, const Sector& sector) {
    return RenderedSkyline(scene, position, sector, px_per_rad, variant.options.canny);
  };
}

}  // namespace

std::vector<AyadiVariant> AyadiVariants() {
  // What neither way uses: the frame before.
  SkylineTrackOptions alone;
  alone.start = "sensors";
  alone.keyframe_every = 0;
  AyadiVariant printed{"printed",
                       "Canny, plain L1, angles in proportion to shifts, the simplex alone",
                       alone};
  SkylineTrackOptions& p = printed.options;
  p.extractor = "canny";
  p.l1.robust = false;
  p.match.linear_angles = true;
  p.match.scan_heading_deg = 0.0;
  p.match.sensor_weight_px = 0.0;
  // No frame is refused: the paper refuses none.
  p.match.max_heading_sigma_deg = 90.0;
  p.match.max_distance_px = 640.0;
  p.match.ambiguous_ratio = 0.0;
  p.match.max_heading_deg = 45.0;
  p.match.max_tilt_deg = 30.0;
  AyadiVariant corrected{
      "corrected",
      "sky likelihood, robust L1, arctangent, a scan of headings before the simplex",
      alone};
  return {printed, corrected};
}

AyadiResult ReplayFrame(const Scene& scene, const AyadiVariant& variant, const AyadiFrame& frame) {
  AyadiResult result;
  result.id = frame.id;
  const Clock::time_point begin = Clock::now();
  result.skyline = Extracted(frame.picture, variant.options);
  const SkylineL1 l1(result.skyline, frame.camera, variant.options.l1);
  const double look_ms = MillisecondsSince(begin);
  SkylineL1Options plain_options = variant.options.l1;
  plain_options.robust = false;
  const SkylineL1 plain(result.skyline, frame.camera, plain_options);
  result.usable = l1.use() == SkylineUse::kUsable;
  const SkylineSource source = SourceOf(scene, variant, frame.camera);
  for (std::size_t m = 0; m < kAyadiMethodCount; ++m) {
    SkylineMatchOptions match = variant.options.match;
    const Clock::time_point start = Clock::now();
    result.pose[m] = frame.instruments;
    if (m == static_cast<std::size_t>(AyadiMethod::kInstruments)) {
      result.l1_px[m] = DistanceAt(l1, source, frame.instruments, match);
      result.evaluations[m] = 1;
    } else {
      match.method = kAyadiMethods[m];
      const SkylineMatchResult found = MatchSkyline(l1, source, frame.instruments, match);
      result.pose[m] = found.best;
      result.evaluations[m] = found.evaluations;
      result.l1_px[m] = found.distance_after_px;
    }
    result.total_ms[m] = look_ms + MillisecondsSince(start);
    result.plain_l1_px[m] = DistanceAt(plain, source, result.pose[m], match);
    result.heading_error_deg[m] = std::numeric_limits<double>::quiet_NaN();
    if (frame.truth) {
      result.heading_error_deg[m] =
          HeadingDifferenceDeg(ViewAnglesOf(result.pose[m].cam_from_world).heading_deg,
                               ViewAnglesOf(frame.truth->cam_from_world).heading_deg);
    }
  }
  return result;
}

SimplifiedSkyline Simplified(const Skyline& skyline, double precision_px) {
  SimplifiedSkyline result;
  result.precision_px = precision_px;
  Polyline run;
  const auto finish = [&] {
    if (run.empty()) return;
    const Polyline kept = RemoveAberrantPoints(run, precision_px);
    const Polyline simple = precision_px > 0.0 ? SimplifyPolyline(kept, precision_px) : kept;
    result.points += run.size();
    result.without_outliers += kept.size();
    result.simplified += simple.size();
    for (const Eigen::Vector2d& p : simple) result.line.push_back(p.cast<float>());
    run.clear();
  };
  for (std::size_t c = 0; c < skyline.size(); ++c) {
    if (skyline.columns[c] != SkylineColumn::kSeen) {
      finish();
      continue;
    }
    run.emplace_back(skyline.XOf(c), skyline.y_px[c]);
  }
  finish();
  return result;
}

AyadiDomain ExploreDomain(const Scene& scene,
                          const AyadiVariant& variant,
                          const AyadiFrame& frame,
                          const Skyline& skyline,
                          double half_range_m,
                          double spacing_m,
                          int threads) {
  AyadiDomain domain;
  domain.half_range_m = half_range_m;
  domain.spacing_m = spacing_m;
  const int steps = static_cast<int>(std::floor(half_range_m / spacing_m + 1e-9));
  domain.cells = 2 * steps + 1;
  domain.distance_px.assign(static_cast<std::size_t>(domain.cells) * domain.cells, 0.0);
  const SkylineL1 l1(skyline, frame.camera, variant.options.l1);
  const SkylineSource source = SourceOf(scene, variant, frame.camera);
  SkylineMatchOptions match = variant.options.match;
  match.method = "3d";
  ParallelFor(domain.distance_px.size(), threads, [&](std::size_t cell) {
    Pose start = frame.instruments;
    start.center_in_world.x() += spacing_m * (static_cast<int>(cell % domain.cells) - steps);
    start.center_in_world.y() += spacing_m * (static_cast<int>(cell / domain.cells) - steps);
    domain.distance_px[cell] = MatchSkyline(l1, source, start, match).distance_after_px;
  });
  return domain;
}

}  // namespace ridgeline
