// SPDX-License-Identifier: Apache-2.0
// Cost of one suggestion (ask and tell) when `trials` results are known.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <string>

#include "optim/minimize.h"

namespace ridgeline {
namespace {

double Energy(std::span<const double> x) {
  double sum = 0.0;
  for (const double v : x) sum += (v - 0.3) * (v - 0.3);
  return sum;
}

SearchProblem Cube(int dimensions) {
  SearchProblem problem;
  for (int d = 0; d < dimensions; ++d) {
    problem.box.parameters.push_back({"x" + std::to_string(d), 0.0, 1.0});
  }
  return problem;
}

// Suggestions per run: so few that the number of results stays near its argument, enough for one in
// which the gp sampler fits its hyper-parameters.
constexpr int kSuggestions = 25;

double CpuMilliseconds() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void Suggest(benchmark::State& state, const char* name) {
  const int trials = static_cast<int>(state.range(0));
  SamplerOptions options;
  options.name = name;
  MinimizeOptions run;
  run.budget = trials;
  double slowest = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    const auto sampler = MakeSampler(options, Cube(6), 1);
    Minimize(*sampler, Energy, run);
    state.ResumeTiming();
    for (int i = 0; i < kSuggestions; ++i) {
      const double begin = CpuMilliseconds();
      for (Trial& trial : sampler->Ask(1)) {
        trial.SetEnergy(Energy(trial.values));
        sampler->Tell(trial);
      }
      slowest = std::max(slowest, CpuMilliseconds() - begin);
    }
  }
  state.counters["per_suggestion"] =
      benchmark::Counter(kSuggestions * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["slowest_ms"] = slowest;
}

BENCHMARK_CAPTURE(Suggest, tpe, "tpe")->Arg(200)->Arg(1000);
BENCHMARK_CAPTURE(Suggest, tpe_multivariate, "tpe_multivariate")->Arg(200)->Arg(1000);
BENCHMARK_CAPTURE(Suggest, gp, "gp")->Arg(200)->Arg(500)->Iterations(2);
BENCHMARK_CAPTURE(Suggest, multi_start, "multi_start")->Arg(200)->Arg(10000);

}  // namespace
}  // namespace ridgeline
