// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

#include "optim/sampler.h"
#include "optim/trace.h"

namespace ridgeline {

// To be minimised. Called from several threads at once. +infinity marks a point that is not
// admissible; NaN, -infinity or an exception make the trial a failed one, and the search goes on.
using Energy = std::function<double(std::span<const double>)>;

struct MinimizeOptions {
  // Evaluations, those of a continued trace included, > 0.
  int budget = 200;
  // Points asked for and evaluated at once, > 0. Part of the result: a larger batch knows less.
  int batch = 1;
  // Threads to evaluate a batch on; 0 for all of the machine. Not part of the result.
  int threads = 1;
  // Called after every trial, in order, on the caller's thread, e.g. for progress; may be empty.
  std::function<void(const Trial&)> on_trial;

  // Throws InputError naming the field.
  void Validate() const;
};

// Runs a new sampler until the budget is spent or the sampler ends. The trace is the same on any
// number of threads.
//
// @param recorded  A trace of the same problem, options, seed and batch that stopped early: its
//     trials are taken from it rather than evaluated, and the result is that of an uninterrupted
//     run. Throws InputError if the sampler proposes other points than were recorded.
Trace Minimize(Sampler& sampler,
               const Energy& energy,
               const MinimizeOptions& options,
               const Trace& recorded = {});

}  // namespace ridgeline
