// SPDX-License-Identifier: Apache-2.0
#include "optim/sampler_options.h"

#include <algorithm>
#include <sstream>

#include "base/error.h"

namespace ridgeline {
namespace {

constexpr int kMaxGridPoints = 10000000;

template <typename T>
void Require(bool good, const char* field, const T& found, const char* expected) {
  if (good) return;
  std::ostringstream text;
  text << found;
  throw InputError("", std::string("sampler.") + field, text.str(), expected);
}

void ValidateTpe(const TpeOptions& tpe) {
  Require(tpe.startup_trials >= 1, "tpe.startup_trials", tpe.startup_trials, ">= 1");
  Require(tpe.candidates >= 1, "tpe.candidates", tpe.candidates, ">= 1");
  Require(tpe.good_fraction > 0.0 && tpe.good_fraction < 1.0,
          "tpe.good_fraction",
          tpe.good_fraction,
          "a value in (0, 1)");
  Require(tpe.good_max >= 1, "tpe.good_max", tpe.good_max, ">= 1");
  Require(tpe.prior_weight > 0.0 && tpe.prior_weight < 1e6,
          "tpe.prior_weight",
          tpe.prior_weight,
          "a value in (0, 1e6)");
}

void ValidateGp(const GpOptions& gp) {
  Require(gp.startup_trials >= 2, "gp.startup_trials", gp.startup_trials, ">= 2");
  Require(gp.max_points >= 20, "gp.max_points", gp.max_points, ">= 20");
  Require(gp.refit_growth >= 0.0, "gp.refit_growth", gp.refit_growth, ">= 0");
  Require(gp.candidates >= 1, "gp.candidates", gp.candidates, ">= 1");
  Require(gp.climbs >= 0, "gp.climbs", gp.climbs, ">= 0");
}

void ValidatePopulations(const CmaEsOptions& cmaes, const DifferentialEvolutionOptions& de) {
  Require(cmaes.population >= 0, "cmaes.population", cmaes.population, ">= 0");
  Require(cmaes.sigma > 0.0 && cmaes.sigma <= 1.0,
          "cmaes.sigma",
          cmaes.sigma,
          "a fraction of the range in (0, 1]");
  Require(cmaes.ftol >= 0.0, "cmaes.ftol", cmaes.ftol, ">= 0");
  Require(cmaes.xtol >= 0.0, "cmaes.xtol", cmaes.xtol, ">= 0");
  Require(de.population >= 0, "de.population", de.population, ">= 0");
  Require(de.weight > 0.0 && de.weight <= 1.0, "de.weight", de.weight, "a value in (0, 1]");
  Require(de.crossover >= 0.0 && de.crossover <= 1.0,
          "de.crossover",
          de.crossover,
          "a value in [0, 1]");
  Require(de.variant >= 1 && de.variant <= 10, "de.variant", de.variant, "1 ... 10");
  Require(de.first_points >= 0, "de.first_points", de.first_points, ">= 0");
  Require(de.ftol >= 0.0, "de.ftol", de.ftol, ">= 0");
  Require(de.xtol >= 0.0, "de.xtol", de.xtol, ">= 0");
}

void ValidateNelderMead(const NelderMeadOptions& options) {
  Require(!options.steps.empty(), "nelder_mead.steps", "no steps", "at least one");
  Require(!options.groups.empty(), "nelder_mead.groups", "no groups", "at least one, e.g. \"*\"");
  for (const double step : options.steps) {
    Require(
        step > 0.0 && step < 1.0, "nelder_mead.steps", step, "fractions of the range in (0, 1)");
  }
  Require(options.convergence > 0.0 && options.convergence < 1.0,
          "nelder_mead.convergence",
          options.convergence,
          "a value in (0, 1)");
}

void ValidateGrid(const GridOptions& grid) {
  Require(grid.coarse_points >= 1 && grid.coarse_points <= kMaxGridPoints,
          "grid.coarse_points",
          grid.coarse_points,
          "1 ... 10000000");
  Require(grid.keep >= 1, "grid.keep", grid.keep, ">= 1");
  Require(grid.finest > 0.0 && grid.finest < 1.0, "grid.finest", grid.finest, "a value in (0, 1)");
}

void ValidateMultiStart(const MultiStartOptions& options) {
  Require(options.first_points >= 4, "multi_start.first_points", options.first_points, ">= 4");
  Require(options.growth >= 1.0 && options.growth <= 10.0,
          "multi_start.growth",
          options.growth,
          "a value in [1, 10]");
  Require(options.descents >= 1, "multi_start.descents", options.descents, ">= 1");
}

}  // namespace

void TpeOptions::Visit(OptionVisitor& v) {
  v.Field("startup_trials", startup_trials);
  v.Field("candidates", candidates);
  v.Field("good_fraction", good_fraction);
  v.Field("good_max", good_max);
  v.Field("prior_weight", prior_weight);
  v.Field("magic_clip", magic_clip);
  v.Field("consider_endpoints", consider_endpoints);
  v.Field("divide_by_deviation", divide_by_deviation);
}

void GpOptions::Visit(OptionVisitor& v) {
  v.Field("startup_trials", startup_trials);
  v.Field("max_points", max_points);
  v.Field("refit_growth", refit_growth);
  v.Field("candidates", candidates);
  v.Field("climbs", climbs);
}

void CmaEsOptions::Visit(OptionVisitor& v) {
  v.Field("population", population);
  v.Field("sigma", sigma);
  v.Field("ftol", ftol);
  v.Field("xtol", xtol);
}

void DifferentialEvolutionOptions::Visit(OptionVisitor& v) {
  v.Field("population", population);
  v.Field("weight", weight);
  v.Field("crossover", crossover);
  v.Field("first_points", first_points);
  v.Field("variant", variant);
  v.Field("ftol", ftol);
  v.Field("xtol", xtol);
}

void GpDeOptions::Visit(OptionVisitor& v) { v.Field("gp_trials", gp_trials); }

void NelderMeadOptions::Visit(OptionVisitor& v) {
  v.Field("steps", steps);
  v.Field("groups", groups);
  v.Field("convergence", convergence);
}

void GridOptions::Visit(OptionVisitor& v) {
  v.Field("coarse_points", coarse_points);
  v.Field("keep", keep);
  v.Field("finest", finest);
}

void MultiStartOptions::Visit(OptionVisitor& v) {
  v.Field("first_points", first_points);
  v.Field("growth", growth);
  v.Field("descents", descents);
}

void SamplerOptions::Visit(OptionVisitor& v) {
  v.Field("name", name);
  v.Group("tpe", [this](OptionVisitor& g) { tpe.Visit(g); });
  v.Group("gp", [this](OptionVisitor& g) { gp.Visit(g); });
  v.Group("cmaes", [this](OptionVisitor& g) { cmaes.Visit(g); });
  v.Group("de", [this](OptionVisitor& g) { de.Visit(g); });
  v.Group("gp_de", [this](OptionVisitor& g) { gp_de.Visit(g); });
  v.Group("nelder_mead", [this](OptionVisitor& g) { nelder_mead.Visit(g); });
  v.Group("grid", [this](OptionVisitor& g) { grid.Visit(g); });
  v.Group("multi_start", [this](OptionVisitor& g) { multi_start.Visit(g); });
}

void SamplerOptions::Validate() const {
  const std::vector<std::string>& names = SamplerNames();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw InputError("",
                     "sampler.name",
                     "\"" + name + "\"",
                     "a known sampler, e.g. \"" + NearestName(name, names) + "\"");
  }
  ValidateTpe(tpe);
  ValidateGp(gp);
  ValidatePopulations(cmaes, de);
  Require(gp_de.gp_trials >= 1, "gp_de.gp_trials", gp_de.gp_trials, ">= 1");
  ValidateNelderMead(nelder_mead);
  ValidateGrid(grid);
  ValidateMultiStart(multi_start);
}

const std::vector<std::string>& SamplerNames() {
  static const std::vector<std::string> names = {"random",
                                                 "sobol",
                                                 "tpe",
                                                 "tpe_multivariate",
                                                 "gp",
                                                 "cmaes",
                                                 "de",
                                                 "gp_de",
                                                 "nelder_mead",
                                                 "grid",
                                                 "multi_start"};
  return names;
}

}  // namespace ridgeline
