// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "camera/intrinsics.h"
#include "camera/pose.h"
#include "city/city_model.h"
#include "lines/line_segment.h"
#include "projection/zbuffer_hough.h"
#include "score/line_energy.h"

namespace ridgeline {

// Edges of the polygons within a radius of the camera, projected and clipped to the near plane and
// the picture, without any occlusion check (Loeper et al., Fig. 2a). Pixels of `camera`.
std::vector<LineSegment> ProjectedEdges(const CityModel& model,
                                        const PinholeCamera& camera,
                                        const Pose& cam_from_local,
                                        double radius_m);

// Depths as grey values, near is dark, nothing is white (Fig. 2b).
cv::Mat DepthDrawing(const cv::Mat& depth, double white_m);

// Lines of one colour (BGR) on a copy of a picture.
cv::Mat LinesDrawn(const cv::Mat& picture,
                   std::span<const LineSegment> lines,
                   const cv::Scalar& color);

// The panels of Fig. 2 and 3 at one pose, as large as the camera.
struct LoeperFigures {
  cv::Mat edges;      // Fig. 2a
  cv::Mat depth;      // Fig. 2b
  cv::Mat segments;   // Fig. 2c
  cv::Mat model;      // Fig. 3a: the same segments
  cv::Mat picture;    // Fig. 3b
  cv::Mat matched;    // Fig. 3c: model segments with correspondents, and these
  std::size_t model_segments = 0;
  std::size_t picture_segments = 0;
  std::size_t matched_model_segments = 0;
  std::size_t pairs = 0;
  double energy = 1.0;
};

// @param bgr  The picture compared, as large as `camera`; @param lines  its segments.
LoeperFigures DrawLoeperFigures(const cv::Mat& bgr,
                                std::span<const LineSegment> lines,
                                const CityModel& model,
                                const PinholeCamera& camera,
                                const Pose& cam_from_local,
                                const LineEnergyOptions& energy,
                                const ZbufferHoughOptions& zbuffer);

}  // namespace ridgeline
