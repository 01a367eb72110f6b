// SPDX-License-Identifier: Apache-2.0
// Best values of samplers on test functions, as CSV on stdout, for peers/optuna_compare.py:
//   optim_quality SEEDS [SAMPLER | SAMPLER:OPTION=VALUE]...
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "optim/minimize.h"
#include "optim/sampler_table.h"
#include "optim_functions.h"

namespace ridgeline {
namespace {

constexpr int kTrials = 200;

void Run(const std::string& sampler, const TestFunction& function, std::uint64_t seed) {
  SamplerOptions options;
  const std::size_t colon = sampler.find(':');
  options.name = sampler.substr(0, colon);
  if (colon != std::string::npos) {
    SetOption(sampler.substr(colon + 1), [&](OptionVisitor& v) { options.Visit(v); });
  }
  MinimizeOptions run;
  run.budget = kTrials;
  const std::clock_t begin = std::clock();
  const Trace trace =
      Minimize(*MakeSampler(options, {function.Box(), {}, {}}, seed), function.energy, run);
  const double milliseconds = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  std::printf("%s,%s,%llu,%.17g,%.17g,%.17g,%.6f\n",
              sampler.c_str(),
              function.name.c_str(),
              static_cast<unsigned long long>(seed),
              trace.BestEnergyAfter(50),
              trace.BestEnergyAfter(100),
              trace.BestEnergyAfter(200),
              milliseconds / kTrials);
}

}  // namespace
}  // namespace ridgeline

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 0;
  if (seeds <= 0) {
    std::fprintf(stderr, "usage: optim_quality SEEDS [SAMPLER | SAMPLER:OPTION=VALUE]...\n");
    return 2;
  }
  std::vector<std::string> samplers(argv + 2, argv + argc);
  if (samplers.empty()) samplers = ridgeline::SamplerNames();
  std::printf("sampler,function,seed,best50,best100,best200,ms_per_trial\n");
  for (const std::string& sampler : samplers) {
    for (const ridgeline::TestFunction& function : ridgeline::TestFunctions()) {
      for (int seed = 0; seed < seeds; ++seed) ridgeline::Run(sampler, function, seed);
    }
  }
  return 0;
}
