// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "optim/sampler_options.h"
#include "optim/search_box.h"
#include "optim/strategy.h"
#include "optim/trial.h"

namespace ridgeline {

// Where to search.
struct SearchProblem {
  SearchBox box;
  Feasible feasible;
  // First guess, a point of the box; empty if there is none. Every sampler proposes it first if it
  // is admissible; Nelder-Mead and CMA-ES begin around it.
  std::vector<double> start;
};

// A search in ask/tell form: the caller evaluates where and when it likes.
//
//   const auto sampler = MakeSampler(options, problem, seed);
//   for (Trial& trial : sampler->Ask(8)) {
//     trial.SetEnergy(energy(trial.values));
//     sampler->Tell(trial);
//   }
//
// The proposals are a function of options, problem, seed and of the order of asks and tells; asking
// for n points is the same as asking n times for one. Not thread-safe. minimize.h has the loop.
class Sampler {
 public:
  Sampler(const SearchProblem& problem, std::unique_ptr<Strategy> strategy);

  // Up to `count` admissible points to evaluate. Fewer, perhaps none, if the sampler waits for
  // results that are outstanding (a simplex, a generation) or has Ended(). Throws InputError if
  // kMaxRejections points in a row are not admissible: the box has no feasible point, or too few.
  std::vector<Trial> Ask(int count);

  // The result of a trial asked for, or of one of the caller's own (index kOwnTrial), which the
  // model-based samplers (TPE, GP) learn from and the others ignore. Throws InputError for values
  // outside of the box or other than asked for, for an index that is not outstanding, and for an
  // energy that does not fit the state.
  void Tell(const Trial& trial);

  // No further proposals will come: a grid at its finest, or a box without free parameters, whose
  // only point is proposed once.
  bool Ended() const;

  const SearchBox& box() const { return problem_.box; }

  static constexpr int kMaxRejections = 100000;

 private:
  struct Outstanding {
    UnitPoint point;
    std::vector<double> values;
  };

  bool Admissible(const std::vector<double>& values) const;
  std::optional<Outstanding> NextAdmissible();

  SearchProblem problem_;
  UnitCube cube_;
  std::unique_ptr<Strategy> strategy_;
  std::map<std::int64_t, Outstanding> outstanding_;
  std::int64_t next_index_ = 0;
};

// Throws InputError for options or a box that cannot be used, and for a start outside of the box.
std::unique_ptr<Sampler> MakeSampler(const SamplerOptions& options,
                                     const SearchProblem& problem,
                                     std::uint64_t seed);

}  // namespace ridgeline
