// SPDX-License-Identifier: Apache-2.0
#include "optim/batch_search.h"

#include <cmath>
#include <limits>

namespace ridgeline {

Batch* SearchRoutine::Next() {
  if (handle_.done()) return nullptr;
  handle_.resume();
  if (handle_.promise().failure) std::rethrow_exception(handle_.promise().failure);
  return handle_.done() ? nullptr : handle_.promise().batch;
}

// True if there is a point to propose.
bool BatchStrategy::Advance() {
  while (!ended_) {
    if (batch_ != nullptr && proposed_ < batch_->points.size()) return true;
    if (batch_ != nullptr && evaluated_ < batch_->points.size()) return false;
    batch_ = routine_.Next();
    proposed_ = 0;
    evaluated_ = 0;
    ended_ = batch_ == nullptr;
    if (!ended_) {
      batch_->energies.assign(batch_->points.size(), std::numeric_limits<double>::infinity());
    }
  }
  return false;
}

std::optional<UnitPoint> BatchStrategy::Propose(std::int64_t id) {
  if (!Advance()) return std::nullopt;
  slots_[id] = proposed_;
  return batch_->points[proposed_++];
}

void BatchStrategy::Reject(std::int64_t id) {
  const auto it = slots_.find(id);
  if (batch_->redraw) {
    proposed_ = it->second;
    batch_->points[proposed_] = batch_->redraw();
  } else {
    ++evaluated_;
  }
  slots_.erase(it);
}

void BatchStrategy::Observe(std::int64_t id, const UnitPoint&, double energy, TrialState state) {
  const auto it = slots_.find(id);
  if (it == slots_.end()) return;
  if (state == TrialState::kComplete) batch_->energies[it->second] = energy;
  slots_.erase(it);
  ++evaluated_;
}

UnitPoint FoldIntoCube(UnitPoint point, const std::vector<bool>& periodic) {
  for (std::size_t d = 0; d < point.size(); ++d) {
    if (periodic[d]) {
      point[d] -= std::floor(point[d]);
    } else {
      point[d] = std::abs(std::remainder(point[d], 2.0));
    }
  }
  return point;
}

UnitPoint UniformPoint(Random& random, std::size_t dimension) {
  UnitPoint point(dimension);
  for (double& u : point) u = random.Uniform();
  return point;
}

}  // namespace ridgeline
