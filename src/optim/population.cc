// SPDX-License-Identifier: Apache-2.0
#include "optim/population.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <numeric>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/de.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "optim/batch_search.h"
#include "optim/sampler_plugin.h"
#include "optim/sobol.h"

namespace ridgeline {
namespace {

// pagmo's arithmetic wants finite numbers; energies are of order 1.
constexpr double kWorst = 1e30;

// pagmo's algorithms call the energy themselves. To ask and tell around them, each generation runs
// twice from the same state: first on a tape that writes down the points it asks for (within a
// generation they do not depend on the answers), then, once these are evaluated, on a tape that
// plays the energies back.
struct Tape {
  bool recording = true;
  std::vector<UnitPoint> points;
  std::vector<double> energies;
  std::size_t played = 0;
};

struct TapeProblem {
  std::shared_ptr<Tape> tape;
  UnitPoint lower;
  UnitPoint upper;

  pagmo::vector_double fitness(const pagmo::vector_double& x) const {
    if (tape->recording) {
      tape->points.push_back(x);
      return {kWorst};
    }
    assert(tape->points[tape->played] == x);
    return {tape->energies[tape->played++]};
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {lower, upper};
  }
};

std::vector<double> Finite(const std::vector<double>& energies) {
  std::vector<double> finite;
  for (const double energy : energies) finite.push_back(std::isfinite(energy) ? energy : kWorst);
  return finite;
}

// Generations of one pagmo algorithm, until it proposes no more points.
SearchRoutine Evolve(pagmo::algorithm algorithm,
                     pagmo::population population,
                     std::shared_ptr<Tape> tape,
                     std::vector<bool> periodic) {
  for (;;) {
    *tape = Tape{};
    pagmo::algorithm(algorithm).evolve(population);
    if (tape->points.empty()) co_return;
    Batch generation;
    for (const UnitPoint& point : tape->points) {
      generation.points.push_back(FoldIntoCube(point, periodic));
    }
    co_yield generation;
    tape->energies = Finite(generation.energies);
    tape->recording = false;
    population = algorithm.evolve(population);
  }
}

unsigned Seed32(Random& random) { return static_cast<unsigned>(random.Next() >> 32); }

// Size of a population: as asked for, or by the number of dimensions; pagmo wants five at least.
int PopulationSize(int asked, double by_dimension) {
  return std::max(5, asked > 0 ? asked : static_cast<int>(by_dimension));
}

pagmo::population MakePopulation(const TapeProblem& problem, const Batch& first) {
  pagmo::population population{pagmo::problem{problem}};
  const std::vector<double> energies = Finite(first.energies);
  for (std::size_t i = 0; i < first.points.size(); ++i) {
    population.push_back(first.points[i], {energies[i]});
  }
  return population;
}

// pagmo::de never says that it has converged; its generations do, by energies or by places.
bool Converged(const Batch& generation, const DifferentialEvolutionOptions& options) {
  const auto [least, greatest] =
      std::minmax_element(generation.energies.begin(), generation.energies.end());
  if (*greatest - *least < options.ftol) return true;
  for (std::size_t d = 0; d < generation.points[0].size(); ++d) {
    const auto [low, high] =
        std::minmax_element(generation.points.begin(),
                            generation.points.end(),
                            [d](const UnitPoint& a, const UnitPoint& b) { return a[d] < b[d]; });
    if ((*high)[d] - (*low)[d] > options.xtol) return false;
  }
  return true;
}

// The best points of a batch, best first.
Batch BestOf(const Batch& batch, std::size_t count) {
  std::vector<std::size_t> order(batch.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return batch.energies[a] < batch.energies[b];
  });
  Batch best;
  for (std::size_t i = 0; i < std::min(count, order.size()); ++i) {
    best.points.push_back(batch.points[order[i]]);
    best.energies.push_back(batch.energies[order[i]]);
  }
  return best;
}

}  // namespace

void CmaEsOptions::Visit(OptionVisitor& v) {
  v.Field("population", population, NotNegative());
  v.Field("sigma", sigma, LeftOpen(0.0, 1.0));
  v.Field("ftol", ftol, NotNegative());
  v.Field("xtol", xtol, NotNegative());
}

void DifferentialEvolutionOptions::Visit(OptionVisitor& v) {
  v.Field("population", population, NotNegative());
  v.Field("weight", weight, LeftOpen(0.0, 1.0));
  v.Field("crossover", crossover, Closed(0.0, 1.0));
  v.Field("first_points", first_points, NotNegative());
  v.Field("variant", variant, Closed(1, 10));
  v.Field("ftol", ftol, NotNegative());
  v.Field("xtol", xtol, NotNegative());
}

SearchRoutine CmaEs(StrategyContext context, CmaEsOptions options) {
  static const std::uint64_t kStage = HashText("optim.cmaes");
  Random random(context.seed, kStage);
  const std::size_t d = context.dimension;
  const auto anywhere = [&] { return UniformPoint(random, d); };
  int size = PopulationSize(options.population, 4.0 + 3.0 * std::log(static_cast<double>(d)));
  for (UnitPoint start = context.start;; size *= 2) {
    Batch first;
    first.redraw = anywhere;
    if (!start.empty()) first.points.push_back(start);
    while (static_cast<int>(first.points.size()) < size) {
      UnitPoint point = anywhere();
      for (std::size_t k = 0; k < start.size(); ++k) {
        point[k] = start[k] + options.sigma * random.Normal();
      }
      first.points.push_back(FoldIntoCube(point, context.periodic));
    }
    co_yield first;
    const auto tape = std::make_shared<Tape>();
    const TapeProblem problem{tape, UnitPoint(d, 0.0), UnitPoint(d, 1.0)};
    const pagmo::algorithm algorithm{pagmo::cmaes(
        1, -1, -1, -1, -1, options.sigma, options.ftol, options.xtol, true, false, Seed32(random))};
    SearchRoutine run = Evolve(algorithm, MakePopulation(problem, first), tape, context.periodic);
    while (Batch* batch = run.Next()) co_yield *batch;
    start.clear();
  }
}

SearchRoutine DifferentialEvolution(StrategyContext context, DifferentialEvolutionOptions options) {
  static const std::uint64_t kStage = HashText("optim.de");
  Random random(context.seed, kStage);
  const std::size_t d = context.dimension;
  SobolSequence sobol(d, context.seed);
  const int size = PopulationSize(options.population, 10.0 + 2.0 * static_cast<double>(d));
  for (UnitPoint start = context.start;; start.clear()) {
    Batch first;
    first.redraw = [&sobol] { return sobol.Next(); };
    if (!start.empty()) first.points.push_back(start);
    while (static_cast<int>(first.points.size()) < std::max(size, options.first_points)) {
      first.points.push_back(sobol.Next());
    }
    co_yield first;
    const Batch best = BestOf(first, static_cast<std::size_t>(size));
    const auto tape = std::make_shared<Tape>();
    TapeProblem problem{tape, UnitPoint(d, 0.0), UnitPoint(d, 1.0)};
    for (std::size_t k = 0; k < d; ++k) {
      // Room for a population to sit astride the seam.
      if (!context.periodic[k]) continue;
      problem.lower[k] = -0.5;
      problem.upper[k] = 1.5;
    }
    const pagmo::algorithm algorithm{pagmo::de(1,
                                               options.weight,
                                               options.crossover,
                                               static_cast<unsigned>(options.variant),
                                               0.0,
                                               0.0,
                                               Seed32(random))};
    SearchRoutine run = Evolve(algorithm, MakePopulation(problem, best), tape, context.periodic);
    while (Batch* batch = run.Next()) {
      co_yield *batch;
      if (Converged(*batch, options)) break;
    }
  }
}

extern const SamplerPlugin kCmaEsSampler;
constinit const SamplerPlugin kCmaEsSampler = {
    .name = "cmaes",
    .declare = [](OptionGroups& options) { options.Add<CmaEsOptions>("cmaes"); },
    .begins_at_start = true,
    .make = [](const StrategyContext& context,
               const OptionGroups& options) -> std::unique_ptr<Strategy> {
      return std::make_unique<BatchStrategy>(CmaEs(context, options.Get<CmaEsOptions>()));
    }};

extern const SamplerPlugin kDifferentialEvolutionSampler;
constinit const SamplerPlugin kDifferentialEvolutionSampler = {
    .name = "de",
    .declare = [](OptionGroups& options) { options.Add<DifferentialEvolutionOptions>("de"); },
    .begins_at_start = true,
    .make = [](const StrategyContext& context,
               const OptionGroups& options) -> std::unique_ptr<Strategy> {
      return std::make_unique<BatchStrategy>(
          DifferentialEvolution(context, options.Get<DifferentialEvolutionOptions>()));
    }};

}  // namespace ridgeline
