// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "optim/trial.h"

namespace ridgeline {

// A point of the unit cube, [0, 1] per free parameter.
using UnitPoint = std::vector<double>;

// What a strategy knows of its problem.
struct StrategyContext {
  std::size_t dimension = 1;            // >= 1
  std::vector<bool> periodic;           // per coordinate: 0 and 1 are the same place
  std::vector<std::string> names;       // of the coordinates
  std::vector<std::string> parameters;  // of the box, the fixed ones too
  // First guess; empty if there is none.
  UnitPoint start;
  std::uint64_t seed = 0;
};

// How a sampler thinks: points of the unit cube in, points out. Sampler gives it the box,
// feasibility, numbering and checks of the input. Not thread-safe; results must be a function of
// the context and the calls alone.
class Strategy {
 public:
  virtual ~Strategy() = default;

  // The point of proposal `id`. Ids rise; each proposal may count on those before it being either
  // outstanding or observed. nullopt: it needs a result that is outstanding, or has ended.
  virtual std::optional<UnitPoint> Propose(std::int64_t id) = 0;
  // The last proposal is not admissible; Propose() is called again with the same id.
  virtual void Reject(std::int64_t id) = 0;
  // A result: of proposal `id`, in any order, or of a point that was not proposed (a new id).
  // energy is +infinity for infeasible trials and NaN for failed ones.
  virtual void Observe(std::int64_t id,
                       const UnitPoint& point,
                       double energy,
                       TrialState state) = 0;
  // True once no proposal will ever follow.
  virtual bool Ended() const { return false; }
};

}  // namespace ridgeline
