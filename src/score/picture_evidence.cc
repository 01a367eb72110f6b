// SPDX-License-Identifier: Apache-2.0
#include "score/picture_evidence.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>

#include "base/error.h"
#include "score/foliage_mask.h"
#include "score/sky_score.h"

namespace ridgeline {
namespace {

PinholeCamera WorkCamera(const PinholeCamera& camera, int work_size_px) {
  const int longer = std::max(camera.width, camera.height);
  return camera.Scaled(std::min(1.0, static_cast<double>(work_size_px) / longer));
}

cv::Mat Reduced(const cv::Mat& picture, const PinholeCamera& camera) {
  cv::Mat reduced;
  cv::resize(picture, reduced, cv::Size(camera.width, camera.height), 0.0, 0.0, cv::INTER_AREA);
  return reduced;
}

std::vector<LineSegment> WorkSegments(const cv::Mat& reduced,
                                      const PinholeCamera& work,
                                      const PinholeCamera& full,
                                      const LineDetectionOptions& options,
                                      const std::optional<std::vector<LineSegment>>& given) {
  if (!given) return DetectLines(reduced, options);
  const Eigen::Vector2f scale(static_cast<float>(work.width) / full.width,
                              static_cast<float>(work.height) / full.height);
  std::vector<LineSegment> segments = *given;
  for (LineSegment& segment : segments) {
    segment.a = segment.a.cwiseProduct(scale);
    segment.b = segment.b.cwiseProduct(scale);
  }
  return segments;
}

// Leaves may be before sky or before a building.
cv::Mat SkyLogOddsOf(const cv::Mat& reduced, const cv::Mat& foliage) {
  cv::Mat log_odds = SkyLogOdds(reduced, SkyLikelihoodOptions{});
  cv::Mat covered;
  cv::resize(foliage, covered, log_odds.size(), 0.0, 0.0, cv::INTER_AREA);
  log_odds.setTo(0.0f, covered > 127);
  return log_odds;
}

}  // namespace

void EvidenceOptions::Validate() const {
  if (work_size_px < 64) {
    throw InputError("", "score.work_size_px", std::to_string(work_size_px), ">= 64");
  }
  if (!(surface_step_deg >= 0.05 && surface_step_deg <= 10.0)) {
    throw InputError("", "score.surface_step_deg", std::to_string(surface_step_deg), "[0.05, 10]");
  }
  lines.Validate();
  sky.Validate();
  facades.Validate();
  colours.Validate();
}

PictureEvidence::PictureEvidence(const cv::Mat& bgr,
                                 const PinholeCamera& camera,
                                 const LineDetectionOptions& lines,
                                 const EvidenceOptions& options,
                                 int threads,
                                 const std::optional<std::vector<LineSegment>>& given_lines)
    : PictureEvidence(Reduced(bgr, WorkCamera(camera, options.work_size_px)),
                      WorkCamera(camera, options.work_size_px),
                      camera,
                      lines,
                      options,
                      threads,
                      given_lines) {}

PictureEvidence::PictureEvidence(const cv::Mat& reduced,
                                 const PinholeCamera& work,
                                 const PinholeCamera& full,
                                 const LineDetectionOptions& lines,
                                 const EvidenceOptions& options,
                                 int threads,
                                 const std::optional<std::vector<LineSegment>>& given_lines)
    : camera_(work),
      segments_(WorkSegments(reduced, work, full, lines, given_lines)),
      foliage_(FoliageMask(reduced)),
      field_(segments_, work.width, work.height, threads, foliage_),
      line_options_(options.lines),
      facades_(segments_, camera_, options.facades),
      colours_(reduced, camera_, options.colours, foliage_),
      sky_(SkyLogOddsOf(reduced, foliage_), options.sky),
      sky_camera_(camera_.Scaled(static_cast<double>(sky_.columns()) / camera_.width)) {}

LineLikelihood PictureEvidence::Lines(double tolerance_factor) const {
  LineLikelihoodOptions options = line_options_;
  options.sigma_model_m *= tolerance_factor;
  return LineLikelihood(field_, camera_, options);
}

CueVector PictureEvidence::Cues(const PositionView& view,
                                const CityModel& model,
                                const Pose& cam_from_local,
                                const LineLikelihood& lines,
                                Workspace& workspace) const {
  const Eigen::Matrix3f rotation = cam_from_local.cam_from_world.toRotationMatrix().cast<float>();
  CueVector cues{};
  ProjectPieces(view.visible, camera_, cam_from_local, workspace.segments);
  const auto edges = lines.LogRatios(workspace.segments, view.kinds);
  std::copy(edges.begin(), edges.end(), cues.begin());
  workspace.skyline_rows.resize(sky_.columns());
  SkylineRows(view.skyline, sky_camera_, rotation, workspace.skyline_rows);
  cues[kSkyCue] = static_cast<float>(SkyLogRatio(sky_, workspace.skyline_rows));
  if (!view.surfaces.surfaces.empty()) {
    cues[kFacadeCue] = facades_.LogRatio(view.surfaces, model, rotation);
    const ColourInformation::Cues colours =
        colours_.Of(view.surfaces, view.groups, rotation, workspace.colours);
    cues[kRegionCue] = static_cast<float>(colours.regions);
    cues[kFacadeColourCue] = static_cast<float>(colours.facades);
  }
  return cues;
}

}  // namespace ridgeline
