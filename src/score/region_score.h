// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "base/options.h"
#include "score/score.h"

namespace ridgeline {

struct RegionScoreOptions {
  // Columns of the grid over the picture on which regions and colours are compared.
  int columns = 64;

  void Visit(OptionVisitor& v) { v.Field("columns", columns); }
  // Throws InputError naming the field, e.g. "score.regions.columns".
  void Validate() const;
};

// Sky, buildings and ground as the model shows them, against the colours of the picture: how much the
// region behind a cell of a grid tells of the cell's colour (mutual information of region and colour,
// less what chance gives, Miller and Madow 1955). The energy is 1 - information / ln 3, since three
// regions tell ln 3 at most; a pose that sees one region alone has energy 1. The colours are ranks
// within the picture: brightness and contrast do not matter, nor what colour anything has.
// Cf. Prisacariu and Reid, "PWP3D", IJCV 2012 (regions by their own statistics).
class RegionScore final : public Score {
 public:
  // @param bgr  CV_8UC3. `model` must outlive the score.
  RegionScore(const cv::Mat& bgr,
              const PinholeCamera& camera,
              const CityModel& model,
              const RegionScoreOptions& options);

  enum Region : std::uint8_t { kSky, kBuilding, kGround, kRegions };

  ViewParts parts() const override { return {false, true}; }
  const char* unusable() const override {
    return has_colours_ ? "" : "the picture has one colour only";
  }
  double LogRatio(const PositionView& view,
                  const Pose& cam_from_local,
                  PictureEvidence::Workspace& workspace) const override;
  // Of the cells' regions, row by row; kRegions: not known.
  double EnergyOfRegions(std::span<const std::uint8_t> regions) const;

  // Of the grid.
  const PinholeCamera& camera() const { return camera_; }

 private:
  static constexpr int kLumaBins = 6;
  static constexpr int kChromaBins = 3;
  static constexpr int kColours = kLumaBins * kChromaBins * kChromaBins;

  PinholeCamera camera_;
  const CityModel& model_;
  bool has_colours_ = false;
  std::vector<std::uint8_t> colours_;   // bins, by cell
  std::vector<Eigen::Vector3f> rays_;   // through the cells' centres, camera axes, unit
};

}  // namespace ridgeline
