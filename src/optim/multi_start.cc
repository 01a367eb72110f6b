// SPDX-License-Identifier: Apache-2.0
#include "optim/multi_start.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "optim/batch_search.h"
#include "optim/places.h"
#include "optim/sampler_plugin.h"
#include "optim/sobol.h"

namespace ridgeline {
namespace {

// Simplices of the polish as fractions of the descent's, and where a descent and a polish end.
constexpr double kPolish[] = {0.3, 0.08};
constexpr double kConverged = 0.2;
constexpr double kSmallestSpacing = 0.01;

}  // namespace

void MultiStartOptions::Visit(OptionVisitor& v) {
  v.Field("first_points", first_points, AtLeast(4));
  v.Field("growth", growth, Closed(1.0, 10.0));
  v.Field("descents", descents, AtLeast(1));
}

SearchRoutine MultiStart(StrategyContext context, MultiStartOptions options) {
  SobolSequence sobol(context.dimension, context.seed);
  std::vector<std::size_t> all(context.dimension);
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<Vertex> seen;
  std::vector<UnitPoint> starts;
  double least = std::numeric_limits<double>::infinity();
  for (double count = options.first_points;; count *= options.growth) {
    Batch batch;
    batch.redraw = [&sobol] { return sobol.Next(); };
    for (int i = 0; i < static_cast<int>(count); ++i) batch.points.push_back(sobol.Next());
    co_yield batch;
    for (std::size_t i = 0; i < batch.points.size(); ++i) {
      seen.push_back({batch.points[i], batch.energies[i]});
    }
    const double dimension = static_cast<double>(context.dimension);
    const double spacing = std::max(
        kSmallestSpacing, 0.5 * std::pow(static_cast<double>(seen.size()), -1.0 / dimension));

    std::vector<Vertex> fresh;
    for (const Vertex& vertex : seen) {
      const bool near = std::any_of(starts.begin(), starts.end(), [&](const UnitPoint& start) {
        return !Apart(start, vertex.point, context.periodic, 0.5 * spacing);
      });
      if (!near) fresh.push_back(vertex);
    }
    for (const Vertex& start : BestApart(fresh, options.descents, spacing, context.periodic)) {
      starts.push_back(start.point);
      const auto best = std::make_shared<Vertex>(start);
      SearchRoutine descent = Simplex(best, all, context.periodic, spacing, kConverged * spacing);
      while (Batch* asked = descent.Next()) co_yield *asked;
      if (best->energy >= least) continue;
      for (const double fraction : kPolish) {
        const double step = fraction * spacing;
        SearchRoutine polish = Simplex(best, all, context.periodic, step, kConverged * step);
        while (Batch* asked = polish.Next()) co_yield *asked;
      }
      least = best->energy;
      starts.push_back(best->point);
    }
  }
}

extern const SamplerPlugin kMultiStartSampler;
constinit const SamplerPlugin kMultiStartSampler = {
    .name = "multi_start",
    .declare = [](OptionGroups& options) { options.Add<MultiStartOptions>("multi_start"); },
    .make = [](const StrategyContext& context,
               const OptionGroups& options) -> std::unique_ptr<Strategy> {
      return std::make_unique<BatchStrategy>(MultiStart(context, options.Get<MultiStartOptions>()));
    }};

}  // namespace ridgeline
