// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/options.h"
#include "projection/scene.h"
#include "projection/simd4.h"
#include "score/edge_kind.h"
#include "score/oriented_distance_field.h"

namespace ridgeline {

struct LineLikelihoodOptions {
  // Share of each kind of edge that shows as a line in pictures, in (0, 1).
  std::vector<double> seen_share = {0.6, 0.5, 0.5, 0.2, 0.3};
  // Standard deviation of a detected line about the projected edge: of the detection [share of the
  // picture's width] and of the model across the edge [m].
  double sigma_width = 0.004;
  double sigma_model_m = 0.3;
  // Spacing of samples along an edge [share of the picture's width].
  double spacing_width = 0.008;

  void Visit(OptionVisitor& v);
};

// Log likelihood ratio of one sample of an edge whose nearest line is at a distance, or beyond it,
// where lines at random have the density [1 / px].
double LineLogRatio(double distance_px,
                    bool is_beyond,
                    double sigma_px,
                    double density,
                    double seen_share);

// Log likelihood ratio of the picture's lines given the projected edges against lines at random
// with the density rho [px / px^2] that the picture has there. The nearest line to a sample of an
// edge is the edge's own, seen with probability v and half-normal distance h (wider towards the
// camera: model errors are metres, not pixels), or the nearest random one, exponential with 2 rho.
// Its distance d then counts log(1 - v + v * (h(d) / (2 rho) + P_h(> d))), or 0 where something
// hides the edge.
class LineLikelihood {
 public:
  // Standard deviations [px] are tabulated at geometric levels.
  static constexpr int kSigmaLevels = 12;
  static double SigmaOfLevel(int level);
  static int LevelOfSigma(double sigma_px);

  LineLikelihood(const OrientedDistanceField& field,
                 const PinholeCamera& camera,
                 const LineLikelihoodOptions& options);

  // Sums over all samples, by kind of edge. `kinds` per piece of the visible set that the segments
  // come from.
  std::array<float, kEdgeKinds> LogRatios(std::span<const ProjectedSegment> segments,
                                          std::span<const EdgeKind> kinds) const;

 private:
  // Distances are looked up in steps of half a pixel.
  static constexpr int kDistances = 64;
  static constexpr int kUnitsPerDistance = 256 / kDistances;
  static constexpr int kDensityLevels = OrientedDistanceField::kHiddenLevel + 1;

  // Index into table_ of the first distance.
  static std::size_t TableOf(EdgeKind kind, int sigma_level, int density_level) {
    return ((static_cast<std::size_t>(kind) * kSigmaLevels + sigma_level) * kDensityLevels +
            density_level) *
           kDistances;
  }
  // What all samples of a segment share, for four segments.
  struct Strokes;
  Strokes StrokesOf(const ProjectedSegment* segments, std::size_t count) const;
  float SumAlong(const Strokes& strokes, int lane, EdgeKind kind) const;
  simd::Int4 SigmaLevels(simd::Float4 inverse_depths) const;

  const OrientedDistanceField& field_;
  float spacing_px_ = 1.0f;
  int first_level_ = 0;  // of sigma, of an edge far away
  // Least inverse depths [1 / m] of the levels after the first.
  std::array<float, kSigmaLevels> nearer_{};
  std::vector<float> table_;
};

}  // namespace ridgeline
