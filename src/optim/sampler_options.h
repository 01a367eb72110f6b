// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/options.h"

namespace ridgeline {

// Tree-structured Parzen estimator; the defaults are those of Optuna 3.1 (see tpe.h).
struct TpeOptions {
  // Uniform random trials before the densities are used, >= 1.
  int startup_trials = 10;
  // Draws from the density of the good trials, of which the best ratio is proposed, >= 1.
  int candidates = 24;
  // The good trials are the best min(ceil(good_fraction * n), good_max), at least one.
  double good_fraction = 0.1;
  int good_max = 25;
  // Weight of the prior kernel beside 1 per trial, > 0.
  double prior_weight = 1.0;
  // Lower limit of bandwidths: range / min(100, 1 + number of kernels).
  bool magic_clip = true;
  // Univariate rule: outermost kernels reach to the bounds.
  bool consider_endpoints = false;

  void Visit(OptionVisitor& v);
};

// Which sampler, and how it is set. Each sampler reads its own group only.
struct SamplerOptions {
  // One of SamplerNames().
  std::string name = "tpe";
  TpeOptions tpe;

  void Visit(OptionVisitor& v);
  // Throws InputError naming the field, e.g. "sampler.tpe.candidates".
  void Validate() const;
};

// Names that SamplerOptions::name accepts.
const std::vector<std::string>& SamplerNames();

}  // namespace ridgeline
