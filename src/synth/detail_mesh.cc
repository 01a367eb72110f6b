// SPDX-License-Identifier: Apache-2.0
#include "synth/detail_mesh.h"

#include <array>

namespace ridgeline {

using Eigen::Vector2d;
using Eigen::Vector3d;

void DetailMesh::AddPolygon(std::span<const Vector3d> ring,
                            std::span<const Vector2d> ring_uv,
                            const DetailTriangle& look) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (std::size_t i = 0; i < ring.size(); ++i) {
    vertices.push_back(ring[i].cast<float>());
    uv.push_back(ring_uv.empty() ? Eigen::Vector2f::Zero() : ring_uv[i].cast<float>().eval());
  }
  for (std::uint32_t k = 2; k < ring.size(); ++k) {
    DetailTriangle triangle = look;
    triangle.vertices = {first, first + k - 1, first + k};
    triangles.push_back(triangle);
  }
}

void DetailMesh::AddFrustum(const Vector3d& center,
                            const Vector2d& along,
                            const Vector2d& lower_size,
                            const Vector2d& upper_size,
                            double height_m,
                            const DetailTriangle& look) {
  const Vector3d x(along.x(), along.y(), 0.0);
  const Vector3d y(-along.y(), along.x(), 0.0);
  const auto corner = [&](int i, const Vector2d& size, double height) -> Vector3d {
    const double sx = (i == 0 || i == 3) ? -0.5 : 0.5;
    const double sy = i < 2 ? -0.5 : 0.5;
    return center + sx * size.x() * x + sy * size.y() * y + Vector3d(0.0, 0.0, height);
  };
  std::array<Vector3d, 4> lower;
  std::array<Vector3d, 4> upper;
  for (int i = 0; i < 4; ++i) {
    lower[i] = corner(i, lower_size, 0.0);
    upper[i] = corner(i, upper_size, height_m);
  }
  AddPolygon(upper, {}, look);
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    const std::array<Vector3d, 4> side = {lower[i], lower[next], upper[next], upper[i]};
    AddPolygon(side, {}, look);
  }
}

}  // namespace ridgeline
