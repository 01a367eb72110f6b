// SPDX-License-Identifier: Apache-2.0
#include "replay/loeper_figures.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>

#include "projection/rasterizer.h"

namespace ridgeline {
namespace {

constexpr int kShift = 4;  // fractional bits of OpenCV's line ends
const cv::Scalar kModelColor(40, 40, 220);
const cv::Scalar kPictureColor(200, 120, 20);

void DrawLine(const LineSegment& line, const cv::Scalar& color, int thickness, cv::Mat& picture) {
  constexpr float kScale = 1 << kShift;
  const auto point = [](const Eigen::Vector2f& p) {
    // OpenCV's integer coordinates are pixel centres.
    return cv::Point(static_cast<int>(std::lround((p.x() - 0.5f) * kScale)),
                     static_cast<int>(std::lround((p.y() - 0.5f) * kScale)));
  };
  cv::line(picture, point(line.a), point(line.b), color, thickness, cv::LINE_AA, kShift);
}

int ThicknessOf(const cv::Mat& picture) { return std::max(1, picture.cols / 500); }

}  // namespace

std::vector<LineSegment> ProjectedEdges(const CityModel& model,
                                        const PinholeCamera& camera,
                                        const Pose& cam_from_local,
                                        double radius_m) {
  // As if every edge were visible: pieces that ProjectPieces() clips.
  VisibleSet all;
  all.position = cam_from_local.center_in_world;
  for (std::size_t i = 0; i < model.feature_edges.size(); ++i) {
    const FeatureEdge& edge = model.feature_edges[i];
    const auto near = [&](const Eigen::Vector3d& p) {
      return (p - cam_from_local.center_in_world).head<2>().cwiseAbs().maxCoeff() <= radius_m;
    };
    if (!near(edge.a) && !near(edge.b)) continue;
    VisiblePiece piece;
    piece.a = edge.a.cast<float>();
    piece.b = edge.b.cast<float>();
    piece.edge = static_cast<std::uint32_t>(i);
    all.pieces.push_back(piece);
  }
  std::vector<ProjectedSegment> projected;
  ProjectPieces(all, camera, cam_from_local, projected);
  std::vector<LineSegment> lines;
  for (const ProjectedSegment& segment : projected) lines.push_back({segment.a, segment.b, 1.0f});
  return lines;
}

cv::Mat DepthDrawing(const cv::Mat& depth, double white_m) {
  cv::Mat drawing(depth.size(), CV_8UC3, cv::Scalar(255, 255, 255));
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const float value = depth.at<float>(y, x);
      if (!std::isfinite(value)) continue;
      // The root shows near steps, too.
      const double grey = 230.0 * std::sqrt(std::min(1.0, value / white_m));
      drawing.at<cv::Vec3b>(y, x) = cv::Vec3b::all(static_cast<std::uint8_t>(grey));
    }
  }
  return drawing;
}

cv::Mat LinesDrawn(const cv::Mat& picture,
                   std::span<const LineSegment> lines,
                   const cv::Scalar& color) {
  cv::Mat drawn = picture.clone();
  for (const LineSegment& line : lines) DrawLine(line, color, ThicknessOf(drawn), drawn);
  return drawn;
}

LoeperFigures DrawLoeperFigures(const cv::Mat& bgr,
                                std::span<const LineSegment> lines,
                                const CityModel& model,
                                const PinholeCamera& camera,
                                const Pose& cam_from_local,
                                const LineEnergyOptions& energy_options,
                                const ZbufferHoughOptions& zbuffer) {
  LoeperFigures figures;
  const cv::Mat paper(camera.height, camera.width, CV_8UC3, cv::Scalar(255, 255, 255));
  figures.edges = LinesDrawn(
      paper, ProjectedEdges(model, camera, cam_from_local, zbuffer.radius_m), {90, 60, 30});
  figures.depth = DepthDrawing(RasterizeDepth(model, camera, cam_from_local, zbuffer.radius_m),
                               zbuffer.white_m);
  std::vector<LineSegment> of_model;
  for (const ProjectedSegment& s : ZbufferHoughSegments(model, camera, cam_from_local, zbuffer)) {
    of_model.push_back({s.a, s.b, 1.0f});
  }
  figures.segments = LinesDrawn(paper, of_model, kModelColor);
  figures.model = figures.segments;
  const cv::Mat pale = 0.5 * bgr + cv::Scalar(127, 127, 127);
  figures.picture = LinesDrawn(pale, lines, kPictureColor);

  const LineEnergy energy(lines, camera.width, energy_options);
  const std::vector<LineEnergy::Pair> pairs = energy.Pairs(of_model);
  std::set<std::size_t> model_side, picture_side;
  for (const LineEnergy::Pair& pair : pairs) {
    model_side.insert(pair.model);
    picture_side.insert(pair.picture);
  }
  figures.matched = pale.clone();
  const int thickness = ThicknessOf(pale);
  for (const std::size_t i : picture_side) {
    DrawLine(lines[i], kPictureColor, thickness, figures.matched);
  }
  for (const std::size_t j : model_side) {
    DrawLine(of_model[j], kModelColor, thickness + 1, figures.matched);
  }
  figures.model_segments = of_model.size();
  figures.picture_segments = lines.size();
  figures.matched_model_segments = model_side.size();
  figures.pairs = pairs.size();
  figures.energy = energy.Energy(of_model);
  return figures;
}

}  // namespace ridgeline
