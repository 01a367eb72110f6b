// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "localize/localizer.h"
#include "report/overlay.h"
#include "report/report_data.h"
#include "track/track_files.h"

namespace ridgeline {

// Gathers what the HTML report of `ridgeline track` shows: a map of the way with the corridor of its
// protection level, time lines, and the pictures of some frames, spread evenly.
class TrackReport {
 public:
  // @param frames  How many there are; 0: not known.
  explicit TrackReport(std::size_t frames);

  bool Shows(std::size_t frame) const;
  void AddPicture(std::size_t frame,
                  const std::string& name,
                  const cv::Mat& picture,
                  std::vector<OverlayLayer> layers);

  ReportData Make(std::span<const TrackRow> rows, const Localizer& localizer) const;

 private:
  struct Picture {
    ReportPhoto photo;
    std::vector<OverlayLayer> layers;
  };
  std::size_t every_ = 1;
  std::map<std::size_t, Picture> pictures_;
};

// The way seen from above, north up: buildings, corridor (protection level, or 95 % ellipse where
// there is none), causal and smoothed track, fixes, truth.
cv::Mat TrackMap(std::span<const TrackRow> rows, const Localizer& localizer);

}  // namespace ridgeline
