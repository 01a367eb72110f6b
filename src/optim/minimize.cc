// SPDX-License-Identifier: Apache-2.0
#include "optim/minimize.h"

#include <algorithm>
#include <exception>

#include "base/error.h"
#include "base/parallel.h"

namespace ridgeline {
namespace {

void RequirePositive(const char* field, int value) {
  if (value > 0) return;
  throw InputError("", std::string("search.") + field, std::to_string(value), "> 0");
}

void Evaluate(const Energy& energy, Trial& trial) {
  try {
    trial.SetEnergy(energy(trial.values));
  } catch (const std::exception& e) {
    trial.state = TrialState::kFailed;
    trial.message = e.what();
  }
}

const Trial& Recorded(const Trace& recorded, const Trial& asked) {
  const Trial& trial = recorded.trials[asked.index];
  if (trial.index == asked.index && trial.values == asked.values) return trial;
  throw InputError("",
                   "trace: trial " + std::to_string(asked.index),
                   "a point that this search does not propose",
                   "a trace of the same problem, sampler options, seed and batch");
}

}  // namespace

void MinimizeOptions::Validate() const {
  RequirePositive("budget", budget);
  RequirePositive("batch", batch);
}

Trace Minimize(Sampler& sampler,
               const Energy& energy,
               const MinimizeOptions& options,
               const Trace& recorded) {
  options.Validate();
  Trace trace;
  while (static_cast<int>(trace.trials.size()) < options.budget) {
    const int left = options.budget - static_cast<int>(trace.trials.size());
    std::vector<Trial> batch = sampler.Ask(std::min(options.batch, left));
    if (batch.empty()) break;
    std::size_t known = 0;
    while (known < batch.size() && trace.trials.size() + known < recorded.trials.size()) {
      batch[known] = Recorded(recorded, batch[known]);
      ++known;
    }
    ParallelFor(batch.size() - known, options.threads, [&](std::size_t i) {
      Evaluate(energy, batch[known + i]);
    });
    for (const Trial& trial : batch) {
      sampler.Tell(trial);
      trace.trials.push_back(trial);
      if (options.on_trial) options.on_trial(trial);
    }
  }
  return trace;
}

}  // namespace ridgeline
