// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "base/options.h"
#include "camera/intrinsics.h"
#include "city/city_model.h"
#include "projection/simd4.h"
#include "projection/surface_panorama.h"

namespace ridgeline {

struct RegionOptions {
  // Columns of the grid over the picture on which regions and colours are compared.
  int columns = 32;

  void Visit(OptionVisitor& v) { v.Field("columns", columns); }
  // Throws InputError naming the field, e.g. "score.regions.columns".
  void Validate() const;
};

// Sky, buildings and ground as the model shows them, against the colours of the picture: how much
// the region behind a cell of a grid tells of the cell's colour (mutual information of region and
// colour, less what chance gives, Miller and Madow 1955), as a share of the ln 3 that three regions
// can tell at most. The colours are ranks within the picture: brightness and contrast do not
// matter, nor what colour anything has. Cf. Prisacariu and Reid, "PWP3D", IJCV 2012 (regions by
// their own statistics).
class RegionInformation {
 public:
  enum Region : std::uint8_t { kSky, kBuilding, kGround, kRegions };

  // @param bgr  CV_8UC3; @param camera  of the picture.
  RegionInformation(const cv::Mat& bgr, const PinholeCamera& camera, const RegionOptions& options);

  // [0, 1]; 0 for a picture of one colour, and where a pose sees no building or nothing else.
  // `labels` is memory to use again.
  double Share(const SurfacePanorama& surfaces,
               const CityModel& model,
               const Eigen::Matrix3f& cam_from_world,
               std::vector<std::uint8_t>& labels) const;
  // Of the cells' regions, row by row; kRegions: not known.
  double Share(std::span<const std::uint8_t> regions) const;

  bool has_colours() const { return has_colours_; }
  // Of the grid.
  const PinholeCamera& camera() const { return camera_; }

 private:
  static constexpr int kLumaBins = 6;
  static constexpr int kChromaBins = 3;
  static constexpr int kColours = kLumaBins * kChromaBins * kChromaBins;

  PinholeCamera camera_;
  bool has_colours_ = false;
  std::vector<std::uint8_t> colours_;  // bins, by cell
  std::vector<simd::Vec3x4> rays_;     // through the cells' centres, camera axes, four by four
};

}  // namespace ridgeline
