// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "track/visual_motion.h"

namespace ridgeline {

// Motion with a length from pictures and what is known of the speed: by the wheels, by the steps of
// the track so far, or nothing but a prior.
class VisualOdometry {
 public:
  // @param usual_m_s  Speed where none is known yet, e.g. half of the fastest.
  explicit VisualOdometry(double usual_m_s) : usual_m_s_(usual_m_s) {}

  struct Result {
    std::optional<Motion> motion;
    std::string missing;  // why there is none
    bool is_cut = false;
    std::optional<double> zoom;  // VisualMotion::Result
  };

  // @param seconds  Since the picture before.
  // @param wheels_m_s  By the wheels.
  Result Next(const cv::Mat& bgr,
              const PinholeCamera& camera,
              double seconds,
              const std::optional<double>& wheels_m_s);

  // The speed that the track has found.
  void Learn(double speed_m_s) { learned_m_s_ = speed_m_s; }

 private:
  VisualMotion pictures_;
  double usual_m_s_;
  std::optional<double> learned_m_s_;
};

}  // namespace ridgeline
