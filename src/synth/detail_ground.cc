// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "synth/detail_mesh.h"

namespace ridgeline {
namespace {

using Eigen::Vector2d;

constexpr double kNearMarginM = 60.0;
constexpr double kFarReachM = 2000.0;
constexpr double kFarStepM = 25.0;

template <typename Height>
void AddGrid(const Vector2d& first,
             int columns,
             int rows,
             double step_m,
             const Height& height,
             DetailMesh& mesh) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const Vector2d xy = first + step_m * Vector2d(c, r);
      mesh.vertices.emplace_back(xy.x(), xy.y(), height(xy));
      mesh.uv.emplace_back(0.0f, 0.0f);
    }
  }
  DetailTriangle ground;
  ground.material = Material::kGround;
  for (int r = 0; r + 1 < rows; ++r) {
    for (int c = 0; c + 1 < columns; ++c) {
      const std::uint32_t a = base + static_cast<std::uint32_t>(r * columns + c);
      const std::uint32_t b = a + static_cast<std::uint32_t>(columns);
      ground.vertices = {a, a + 1, b + 1};
      mesh.triangles.push_back(ground);
      ground.vertices = {a, b + 1, b};
      mesh.triangles.push_back(ground);
    }
  }
}

}  // namespace

void AddGround(const Town& town, DetailMesh& mesh) {
  const Vector2d margin(kNearMarginM, kNearMarginM);
  const Vector2d lower = (town.Lower() - margin).array().floor();
  const Vector2d upper = (town.Upper() + margin).array().ceil();
  const Vector2d size = upper - lower;
  AddGrid(
      lower,
      static_cast<int>(size.x()) + 1,
      static_cast<int>(size.y()) + 1,
      1.0,
      [&](const Vector2d& xy) { return static_cast<float>(town.TerrainHeight(xy)); },
      mesh);
  // The far ground lies under the near one and rises into hills with the distance.
  const Vector2d middle = 0.5 * (lower + upper);
  const double near_reach = 0.5 * size.norm();
  const int steps = static_cast<int>(2.0 * (kFarReachM + near_reach) / kFarStepM) + 1;
  const Vector2d far_first = middle - 0.5 * kFarStepM * Vector2d(steps - 1, steps - 1);
  AddGrid(
      far_first,
      steps,
      steps,
      kFarStepM,
      [&](const Vector2d& xy) {
        const Vector2d outside = (lower - xy).cwiseMax(xy - upper).cwiseMax(Vector2d::Zero());
        const double beyond = std::max(0.0, outside.norm() - 2.0 * kFarStepM);
        const double hills = 0.5 + 0.5 * std::sin(xy.x() / 310.0) * std::cos(xy.y() / 270.0);
        const double drop = outside.norm() < 2.0 * kFarStepM ? 1.5 : 0.0;
        return static_cast<float>(town.TerrainHeight(xy) - drop + 0.045 * beyond * hills);
      },
      mesh);
}

}  // namespace ridgeline
