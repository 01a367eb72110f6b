// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "cli/skyline_output.h"
#include "report/overlay.h"
#include "report/report_data.h"

namespace ridgeline {

// Gathers what the HTML report of `ridgeline skyline` shows. Of long films the pictures of some
// frames only, spread evenly.
class SkylineReport {
 public:
  explicit SkylineReport(std::size_t frames);

  // Whether the picture of a frame is shown.
  bool Shows(std::size_t frame) const;
  // The picture of a frame, with the model's skyline by the sensors, and those of the picture and
  // of the model after the match.
  void AddPicture(std::size_t frame,
                  const std::string& name,
                  const cv::Mat& picture,
                  std::vector<OverlayLayer> before,
                  std::vector<OverlayLayer> after);

  // @param frames  Of all frames, in order.
  ReportData Make(const std::vector<SkylineFrameResult>& frames) const;

 private:
  struct Picture {
    ReportPhoto photo;
    std::vector<OverlayLayer> before;
    std::vector<OverlayLayer> after;
  };
  std::size_t every_ = 1;
  std::map<std::size_t, Picture> pictures_;
};

}  // namespace ridgeline
