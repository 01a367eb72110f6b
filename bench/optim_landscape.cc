// SPDX-License-Identifier: Apache-2.0
// Chance of every sampler to end near the minimum of recorded energy landscapes (see landscape.h),
// over seeds and landscapes, as a Markdown table on stdout.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <string_view>

#include "base/error.h"
#include "landscape.h"
#include "optim/minimize.h"
#include "optim/sampler_table.h"

namespace ridgeline {
namespace {

struct Settings {
  std::vector<std::string> files;
  std::vector<std::string> samplers = SamplerNames();
  std::vector<int> budgets = {50, 100, 200, 1000, 10000};
  int seeds = 20;
  int gp_budget = 200;
  double within_m = 2.0;
  double within_deg = 2.0;
  SamplerOptions options;
};

// Metres by their Euclidean distance, degrees one by one; the unit is in the parameter's name.
bool Near(const SearchBox& box,
          const std::vector<double>& a,
          const std::vector<double>& b,
          const Settings& settings) {
  double square_m = 0.0;
  for (std::size_t i = 0; i < box.Size(); ++i) {
    const double difference = std::abs(box.Difference(i, a[i], b[i]));
    if (std::string_view(box.parameters[i].name).ends_with("_deg")) {
      if (difference > settings.within_deg) return false;
    } else {
      square_m += difference * difference;
    }
  }
  return square_m <= settings.within_m * settings.within_m;
}

struct Row {
  std::vector<double> hits;
  double milliseconds = 0.0;
  double trials = 0.0;
};

const Trial* BestAfter(const Trace& trace, std::size_t count) {
  const Trial* best = nullptr;
  for (std::size_t i = 0; i < std::min(count, trace.trials.size()); ++i) {
    const Trial& trial = trace.trials[i];
    if (trial.state != TrialState::kComplete) continue;
    if (best == nullptr || trial.energy < best->energy) best = &trial;
  }
  return best;
}

void RunOnce(const std::string& name,
             const Landscape& landscape,
             const Settings& settings,
             std::uint64_t seed,
             Row& row) {
  SamplerOptions options = settings.options;
  options.name = name;
  SearchProblem problem;
  problem.box = landscape.box();
  problem.feasible = [&](std::span<const double> v) { return landscape.Feasible(v); };
  MinimizeOptions run;
  run.budget = *std::max_element(settings.budgets.begin(), settings.budgets.end());
  if (name == "gp") run.budget = std::min(run.budget, settings.gp_budget);
  const auto energy = [&](std::span<const double> v) { return landscape.Energy(v); };
  const std::clock_t begin = std::clock();
  const Trace trace = Minimize(*MakeSampler(options, problem, seed), energy, run);
  row.milliseconds += 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  row.trials += static_cast<double>(trace.trials.size());
  row.hits.resize(settings.budgets.size());
  for (std::size_t k = 0; k < settings.budgets.size(); ++k) {
    const Trial* best = BestAfter(trace, static_cast<std::size_t>(settings.budgets[k]));
    if (best != nullptr && Near(landscape.box(), best->values, landscape.minimum(), settings)) {
      row.hits[k] += 1.0;
    }
  }
}

void PrintTable(const Settings& settings) {
  std::vector<Landscape> landscapes;
  for (const std::string& file : settings.files) landscapes.emplace_back(file);
  std::printf("%zu landscapes, %d seeds; %% within %g m and %g degrees of the minimum.\n\n",
              landscapes.size(),
              settings.seeds,
              settings.within_m,
              settings.within_deg);
  std::printf("| sampler |");
  for (const int budget : settings.budgets) std::printf(" %d |", budget);
  std::printf(" CPU ms per trial |\n|---|");
  for (std::size_t k = 0; k <= settings.budgets.size(); ++k) std::printf("---|");
  std::printf("\n");
  for (const std::string& name : settings.samplers) {
    Row row;
    for (const Landscape& landscape : landscapes) {
      for (int seed = 0; seed < settings.seeds; ++seed) {
        RunOnce(name, landscape, settings, static_cast<std::uint64_t>(seed), row);
      }
    }
    const double runs = static_cast<double>(landscapes.size()) * settings.seeds;
    std::printf("| %s |", name.c_str());
    for (std::size_t k = 0; k < settings.budgets.size(); ++k) {
      const bool beyond = name == "gp" && settings.budgets[k] > settings.gp_budget;
      beyond ? std::printf(" |") : std::printf(" %.0f |", 100.0 * row.hits[k] / runs);
    }
    std::printf(" %.4f |\n", row.milliseconds / row.trials);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace ridgeline

int main(int argc, char** argv) {
  ridgeline::Settings settings;
  CLI::App app("Chance of every sampler to end near the minimum of recorded energy landscapes");
  app.add_option("landscapes", settings.files, "CSV files, see landscape.h")->required();
  app.add_option("--samplers", settings.samplers)->check(CLI::IsMember(ridgeline::SamplerNames()));
  app.add_option("--budgets", settings.budgets)->check(CLI::PositiveNumber);
  app.add_option("--seeds", settings.seeds)->check(CLI::PositiveNumber);
  app.add_option("--gp-budget", settings.gp_budget, "trials of the slow gp sampler at most");
  app.add_option("--within-m", settings.within_m);
  app.add_option("--within-deg", settings.within_deg);
  std::vector<std::string> assignments;
  app.add_option("--set", assignments, "sampler options, e.g. multi_start.descents=2");
  CLI11_PARSE(app, argc, argv);
  try {
    for (const std::string& assignment : assignments) {
      ridgeline::SetOption(assignment,
                           [&](ridgeline::OptionVisitor& v) { settings.options.Visit(v); });
    }
    ridgeline::PrintTable(settings);
  } catch (const ridgeline::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
