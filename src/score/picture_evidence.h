// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "base/options.h"
#include "lines/line_detector.h"
#include "score/colour_information.h"
#include "score/facade_directions.h"
#include "score/line_likelihood.h"
#include "score/oriented_distance_field.h"
#include "score/position_view.h"
#include "score/sky_table.h"
#include "skyline/sky_likelihood.h"

namespace ridgeline {

struct EvidenceOptions {
  // The picture is reduced to this length of its longer side [px], never enlarged.
  int work_size_px = 960;
  LineLikelihoodOptions lines;
  SkyTableOptions sky;
  FacadeDirectionOptions facades;
  ColourOptions colours;
  // Resolution of the surfaces seen from a position [deg].
  double surface_step_deg = 0.5;

  void Visit(OptionVisitor& v) {
    v.Field("work_size_px", work_size_px);
    v.Group("lines", [this](OptionVisitor& g) { lines.Visit(g); });
    v.Group("sky", [this](OptionVisitor& g) { sky.Visit(g); });
    v.Group("facades", [this](OptionVisitor& g) { facades.Visit(g); });
    v.Group("colours", [this](OptionVisitor& g) { colours.Visit(g); });
    v.Field("surface_step_deg", surface_step_deg);
  }
  void Validate() const;
};

// Independent pieces of evidence for a pose; each is a log likelihood ratio against chance up to a
// factor (its samples are correlated). The first five are the kinds of edges, in their order.
inline constexpr int kSkyCue = kEdgeKinds;
inline constexpr int kFacadeCue = kEdgeKinds + 1;
inline constexpr int kRegionCue = kEdgeKinds + 2;
inline constexpr int kFacadeColourCue = kEdgeKinds + 3;
inline constexpr int kCues = kEdgeKinds + 4;
using CueVector = std::array<float, kCues>;
inline constexpr std::array<const char*, kCues> kCueNames = {
    "skyline_edges", "occlusions", "folds", "ground_lines", "seams",
    "sky", "facades", "regions", "facade_colours"};

// What a picture says, prepared so that a pose costs microseconds.
class PictureEvidence {
 public:
  // Memory that one thread uses again and again.
  struct Workspace {
    std::vector<ProjectedSegment> segments;
    std::vector<LineSegment> lines;
    std::vector<float> skyline_rows;
    ColourInformation::Workspace colours;
  };

  // @param bgr  Undistorted picture, 8 bit, three channels.
  // @param camera  Of the picture as given.
  // @param given_lines  Segments [px of the picture as given] instead of the detector's.
  PictureEvidence(const cv::Mat& bgr,
                  const PinholeCamera& camera,
                  const LineDetectionOptions& lines,
                  const EvidenceOptions& options,
                  int threads,
                  const std::optional<std::vector<LineSegment>>& given_lines = std::nullopt);

  PictureEvidence(const PictureEvidence&) = delete;
  PictureEvidence& operator=(const PictureEvidence&) = delete;

  // Of the reduced picture.
  const PinholeCamera& camera() const { return camera_; }
  const std::vector<LineSegment>& segments() const { return segments_; }
  const OrientedDistanceField& field() const { return field_; }
  // Whether there is nothing to compare: no lines, and one colour.
  bool is_blank() const { return segments_.empty() && !colours_.has_colours(); }

  // The line likelihood with a wider (> 1) tolerance of the model's errors than the options', for
  // poses on a coarse grid. Refers to this object.
  LineLikelihood Lines(double tolerance_factor) const;

  CueVector Cues(const PositionView& view,
                 const CityModel& model,
                 const Pose& cam_from_local,
                 const LineLikelihood& lines,
                 Workspace& workspace) const;

 private:
  PictureEvidence(const cv::Mat& reduced,
                  const PinholeCamera& work,
                  const PinholeCamera& full,
                  const LineDetectionOptions& lines,
                  const EvidenceOptions& options,
                  int threads,
                  const std::optional<std::vector<LineSegment>>& given_lines);

  PinholeCamera camera_;
  std::vector<LineSegment> segments_;
  cv::Mat foliage_;  // hides what is behind; of the reduced picture
  OrientedDistanceField field_;
  LineLikelihoodOptions line_options_;
  FacadeDirections facades_;
  ColourInformation colours_;
  SkyTable sky_;
  PinholeCamera sky_camera_;
};

}  // namespace ridgeline
