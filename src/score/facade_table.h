// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "city/city_model.h"
#include "score/facade_directions.h"
#include "score/position_view.h"
#include "score/tilted_rays.h"

namespace ridgeline {

// FacadeDirections for a few tilts: on an upright wall a line's log ratio depends on nothing but
// the azimuth of the wall's courses relative to the heading, and is looked up. Courses and headings
// are rounded to a quarter of a degree at most.
class FacadeTable {
 public:
  FacadeTable(std::shared_ptr<const FacadeDirections> directions,
              std::span<const Eigen::Matrix3f> cam_from_level);

  // nullopt: the pose is under none of the tilts.
  std::optional<TiltedRays::Turned> Find(const Eigen::Matrix3f& cam_from_local) const {
    return rays_.Find(cam_from_local);
  }

  // As FacadeDirections::LogRatio().
  // @param turned  Find() of the rotation.
  float LogRatio(const PositionView& view,
                 const CityModel& model,
                 const Eigen::Matrix3f& cam_from_local,
                 const TiltedRays::Turned& turned) const;

 private:
  // The log ratio, weighted, of one line on a sloped surface.
  float OnSlope(std::size_t line, const Eigen::Vector3f& normal, const Eigen::Matrix3f& r) const;

  std::shared_ptr<const FacadeDirections> directions_;
  TiltedRays rays_;
  std::size_t columns_ = 0;  // lines, in fours
  // By tilt: by course relative to the heading, then by line; log ratios, weighted.
  std::vector<std::vector<float>> tables_;
};

}  // namespace ridgeline
