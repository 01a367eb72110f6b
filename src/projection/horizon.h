// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "city/city_model.h"
#include "projection/bvh_build.h"
#include "projection/sector_test.h"
#include "projection/terrain_mesh.h"
#include "projection/triangle_edges.h"

namespace ridgeline {

// Skyline of buildings and terrain from a position, exact: the highest elevation at an azimuth lies
// on an edge of the scene, and along an edge the tangent of the elevation is a linear function of
// the azimuth's sine and cosine. So it is the upper envelope of the edges, without rays. Where
// nothing reaches above it, the skyline is the horizontal: the ground goes on to the horizon.
class Horizon {
 public:
  Horizon(const CityModel& model,
          const TriangleEdges& mesh,
          const TerrainMesh& terrain,
          double step_rad);

  struct Columns {
    int first = 0;  // azimuth = index * step(), clockwise from north; may be negative
    int count = 0;  // at most columns of a full turn
  };
  // The azimuths in a sector.
  Columns ColumnsOf(double center, double half_width) const;

  // Elevation angles [rad] at the columns.
  void Elevations(const Eigen::Vector3f& eye,
                  const Columns& columns,
                  const SectorTest& sector,
                  std::vector<float>& elevations) const;

  // Azimuth step [rad]: a full turn divided by a whole number, at most the step asked for.
  double step() const { return step_; }
  std::size_t memory_bytes() const {
    return edges_.size() * sizeof(Edge) + clusters_.size() * sizeof(Cluster);
  }

 private:
  struct Edge {
    Eigen::Vector3f a, b;
  };
  struct Cluster {
    Eigen::AlignedBox3f box;
    std::uint32_t first = 0;
    std::uint32_t count = 0;  // 0: inner
    std::uint32_t skip = 0;   // next cluster if this one is skipped
  };
  class Envelope;

  void BuildTree();
  void AddCluster(const BoxTree& tree, std::int32_t child, std::vector<Edge>& ordered);

  double step_ = 0.0;
  int turn_ = 0;  // columns of a full turn
  // Sines and cosines of the azimuths of two turns, so that an interval never wraps.
  std::vector<float> sines_;
  std::vector<float> cosines_;
  std::vector<Edge> edges_;        // in the order of the clusters
  std::vector<Cluster> clusters_;  // depth first
};

}  // namespace ridgeline
