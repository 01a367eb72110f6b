// SPDX-License-Identifier: Apache-2.0
#include "optim/sampler_options.h"

#include <algorithm>
#include <sstream>

#include "base/error.h"

namespace ridgeline {
namespace {

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

}  // namespace

void TpeOptions::Visit(OptionVisitor& v) {
  v.Field("startup_trials", startup_trials);
  v.Field("candidates", candidates);
  v.Field("good_fraction", good_fraction);
  v.Field("good_max", good_max);
  v.Field("prior_weight", prior_weight);
  v.Field("magic_clip", magic_clip);
  v.Field("consider_endpoints", consider_endpoints);
}

void SamplerOptions::Visit(OptionVisitor& v) {
  v.Field("name", name);
  v.Group("tpe", [this](OptionVisitor& g) { tpe.Visit(g); });
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
}

const std::vector<std::string>& SamplerNames() {
  static const std::vector<std::string> names = {"random", "tpe", "tpe_multivariate"};
  return names;
}

}  // namespace ridgeline
