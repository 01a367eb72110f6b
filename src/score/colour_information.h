// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "base/options.h"
#include "camera/intrinsics.h"
#include "projection/simd4.h"
#include "projection/surface_panorama.h"
#include "score/surface_groups.h"
#include "score/tilted_rays.h"

namespace ridgeline {

struct ColourOptions {
  // Columns of the grid over the picture on which surfaces and colours are compared.
  int columns = 64;

  void Visit(OptionVisitor& v) { v.Field("columns", columns, Closed(8, 640)); }
};

// How much the surfaces that a pose puts behind the cells of a grid over the picture tell of the
// cells' colours. The colours are ranks within the picture: brightness and contrast do not matter,
// nor what colour anything has. Cf. Prisacariu and Reid, "PWP3D", IJCV 2012 (regions by their own
// statistics).
class ColourInformation {
 public:
  struct Cues {
    // Mutual information of colour and region (sky, building, ground), less what chance gives
    // (Miller and Madow 1955), as a share of the ln 3 that three regions can tell at most: [0, 1];
    // 0 for a picture of one colour, and where a pose sees no building or nothing else.
    double regions = 0.0;
    // Log Bayes factor [nat] of the colours before buildings: the walls and the roofs of each
    // building have their own distribution, against all one and the same (symmetric Dirichlet
    // priors). 0 if there is one such group; below 0 where the groups tell nothing.
    double facades = 0.0;
  };
  // Memory to use again.
  struct Workspace {
    std::vector<SurfacePanorama::Places> nodes;
    std::vector<std::uint16_t> groups;  // by cell
    std::vector<std::uint32_t> joint;   // cells by group and colour; all zero between uses
    std::vector<std::uint8_t> in_view;  // by group; all zero between uses
  };

  // @param bgr  CV_8UC3; @param camera  of the picture.
  // @param hidden  CV_8U, as large; not 0 where something hides the surfaces. Empty: nowhere.
  ColourInformation(const cv::Mat& bgr,
                    const PinholeCamera& camera,
                    const ColourOptions& options,
                    const cv::Mat& hidden = {});

  Cues Of(const SurfacePanorama& surfaces,
          const SurfaceGroups& groups,
          const Eigen::Matrix3f& cam_from_world,
          Workspace& workspace) const;
  // The same under a tilt.
  // @param rays  Those of cell_rays(). @param turned  Of them.
  Cues Of(const SurfacePanorama& surfaces,
          const SurfaceGroups& groups,
          const TiltedRays& rays,
          const TiltedRays::Turned& turned,
          Workspace& workspace) const;
  // Of the groups behind the cells, row by row; kNoGroup: not known.
  Cues Of(std::span<const std::uint16_t> groups, int group_count, Workspace& workspace) const;

  // Through the centres of the cells, row by row [camera axes].
  std::vector<Eigen::Vector3f> cell_rays() const;

  bool has_colours() const { return has_colours_; }
  // Of the grid.
  const PinholeCamera& camera() const { return camera_; }

 private:
  // The groups behind all cells, into workspace.groups.
  void FindGroups(const SurfacePanorama& surfaces,
                  const SurfaceGroups& groups,
                  const Eigen::Matrix3f& cam_from_world,
                  Workspace& workspace) const;

  static constexpr int kLumaBins = 6;
  static constexpr int kChromaBins = 3;
  // Cells between nodes.
  static constexpr int kBlock = 4;
  static constexpr int kColours = kLumaBins * kChromaBins * kChromaBins;
  static constexpr std::uint8_t kHidden = kColours;
  static constexpr std::size_t kStride = kColours + 2;  // of the counts of a group

  double SumOfLogRising(const std::uint32_t* counts) const;

  PinholeCamera camera_;
  bool has_colours_ = false;
  std::vector<std::uint8_t> colours_;  // bins, by cell; or kHidden
  // Rays (camera axes) through the centres of every fourth cell of every fourth row, and of one
  // cell and row beyond; four of them side by side.
  int nodes_across_ = 0;
  int nodes_down_ = 0;
  std::vector<simd::Vec3x4> node_rays_;
  // By number of cells n: n ln n; log of the rising factorials of the Dirichlet priors.
  std::vector<double> n_log_n_;
  std::vector<double> log_rising_colour_;
  std::vector<double> log_rising_all_;
};

}  // namespace ridgeline
