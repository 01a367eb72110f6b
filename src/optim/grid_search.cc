// SPDX-License-Identifier: Apache-2.0
#include "optim/grid_search.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "base/error.h"
#include "optim/batch_search.h"
#include "optim/places.h"
#include "optim/sampler_plugin.h"

namespace ridgeline {
namespace {

constexpr std::size_t kFullLattice = 4;
constexpr std::size_t kCorners = 10;
constexpr double kMostPoints = 1.1e7;
constexpr int kMostCoarsePoints = 10000000;

void RequireFewEnough(std::size_t per_axis, std::size_t d) {
  if (std::pow(static_cast<double>(per_axis), static_cast<double>(d)) <= kMostPoints) return;
  throw InputError("",
                   "sampler.name",
                   "\"grid\" with " + std::to_string(per_axis) + " points on each of " +
                       std::to_string(d) + " axes",
                   "another sampler, or a box with more admissible points");
}

std::vector<UnitPoint> CoarseGrid(std::size_t per_axis, std::size_t d) {
  std::vector<UnitPoint> points;
  std::vector<std::size_t> index(d, 0);
  for (;;) {
    UnitPoint point(d);
    for (std::size_t k = 0; k < d; ++k) {
      point[k] = (static_cast<double>(index[k]) + 0.5) / static_cast<double>(per_axis);
    }
    points.push_back(point);
    std::size_t k = 0;
    while (k < d && ++index[k] == per_axis) index[k++] = 0;
    if (k == d) return points;
  }
}

void Shuffle(std::vector<UnitPoint>& points, Random& random) {
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random.Below(i)]);
}

// Offsets in {-1, 0, 1}^d, without zero.
std::vector<std::vector<int>> Neighbourhood(std::size_t d) {
  std::vector<std::vector<int>> offsets;
  if (d <= kFullLattice) {
    std::vector<int> offset(d, -1);
    for (;;) {
      if (std::any_of(offset.begin(), offset.end(), [](int o) { return o != 0; })) {
        offsets.push_back(offset);
      }
      std::size_t k = 0;
      while (k < d && ++offset[k] == 2) offset[k++] = -1;
      if (k == d) return offsets;
    }
  }
  for (std::size_t k = 0; k < d; ++k) {
    for (const int side : {-1, 1}) {
      offsets.emplace_back(d, 0);
      offsets.back()[k] = side;
    }
  }
  if (d > kCorners) return offsets;
  for (std::size_t corner = 0; corner < (std::size_t{1} << d); ++corner) {
    offsets.emplace_back(d);
    for (std::size_t k = 0; k < d; ++k) offsets.back()[k] = (corner >> k & 1) != 0 ? 1 : -1;
  }
  return offsets;
}

bool AnyFinite(const std::vector<Vertex>& places) {
  return std::any_of(places.begin(), places.end(), [](const Vertex& place) {
    return std::isfinite(place.energy);
  });
}

void Append(const Batch& batch, std::vector<Vertex>& places) {
  for (std::size_t i = 0; i < batch.points.size(); ++i) {
    places.push_back({batch.points[i], batch.energies[i]});
  }
}

}  // namespace

void GridOptions::Visit(OptionVisitor& v) {
  v.Field("coarse_points", coarse_points, Closed(1, kMostCoarsePoints));
  v.Field("keep", keep, AtLeast(1));
  v.Field("finest", finest, Open(0.0, 1.0));
}

SearchRoutine GridSearch(StrategyContext context, GridOptions options) {
  static const std::uint64_t kStage = HashText("optim.grid");
  Random random(context.seed, kStage);
  const double share = 1.0 / static_cast<double>(context.dimension);
  std::size_t per_axis = static_cast<std::size_t>(
      std::max(2.0, std::floor(std::pow(options.coarse_points, share) + 1e-9)));
  std::vector<Vertex> places;
  for (;; per_axis *= 2) {
    RequireFewEnough(per_axis, context.dimension);
    Batch coarse;
    coarse.points = CoarseGrid(per_axis, context.dimension);
    Shuffle(coarse.points, random);
    co_yield coarse;
    Append(coarse, places);
    if (AnyFinite(places)) break;
  }

  const std::vector<std::vector<int>> offsets = Neighbourhood(context.dimension);
  double spacing = 1.0 / static_cast<double>(per_axis);
  std::size_t keep = static_cast<std::size_t>(options.keep);
  while (spacing > options.finest) {
    const std::vector<Vertex> centers = BestApart(places, keep, 1.01 * spacing, context.periodic);
    if (centers.empty()) co_return;
    spacing /= 3.0;
    keep = std::max<std::size_t>(1, keep / 2);
    places = centers;
    for (const Vertex& center : centers) {
      Batch around;
      for (const std::vector<int>& offset : offsets) {
        UnitPoint point = center.point;
        for (std::size_t k = 0; k < point.size(); ++k) point[k] += spacing * offset[k];
        around.points.push_back(FoldIntoCube(point, context.periodic));
      }
      co_yield around;
      Append(around, places);
    }
  }
}

extern const SamplerPlugin kGridSampler;
constinit const SamplerPlugin kGridSampler = {
    .name = "grid",
    .declare = [](OptionGroups& options) { options.Add<GridOptions>("grid"); },
    .make = [](const StrategyContext& context,
               const OptionGroups& options) -> std::unique_ptr<Strategy> {
      return std::make_unique<BatchStrategy>(GridSearch(context, options.Get<GridOptions>()));
    }};

}  // namespace ridgeline
