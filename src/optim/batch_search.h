// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <coroutine>
#include <exception>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "base/random.h"
#include "optim/strategy.h"

namespace ridgeline {

// Points that a search wants evaluated before it goes on.
struct Batch {
  std::vector<UnitPoint> points;
  // One per point once evaluated; +infinity for inadmissible and failed ones.
  std::vector<double> energies;
  // Another point instead of an inadmissible one. If empty, that one counts as evaluated.
  std::function<UnitPoint()> redraw;
};

// A search written as a plain loop, which pauses wherever it needs energies:
//
//   SearchRoutine Descend(UnitPoint x) {
//     Batch batch{{x}, {}, {}};
//     co_yield batch;  // fills batch.energies, and batch.points where it redrew
//     ...
//   }
//
// Parameters of a routine are taken by value: it outlives its caller's statement.
class SearchRoutine {
 public:
  struct promise_type {
    Batch* batch = nullptr;
    std::exception_ptr failure;

    SearchRoutine get_return_object() {
      return SearchRoutine(std::coroutine_handle<promise_type>::from_promise(*this));
    }
    std::suspend_always initial_suspend() noexcept { return {}; }
    std::suspend_always final_suspend() noexcept { return {}; }
    std::suspend_always yield_value(Batch& next) noexcept {
      batch = &next;
      return {};
    }
    void return_void() noexcept {}
    void unhandled_exception() noexcept { failure = std::current_exception(); }
  };

  SearchRoutine(SearchRoutine&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  SearchRoutine& operator=(SearchRoutine&&) = delete;
  ~SearchRoutine() {
    if (handle_) handle_.destroy();
  }

  // Goes on to the next batch; nullptr at the end. The last batch must have its energies.
  Batch* Next();

 private:
  explicit SearchRoutine(std::coroutine_handle<promise_type> handle) : handle_(handle) {}

  std::coroutine_handle<promise_type> handle_;
};

// Runs a routine as a strategy. Waits where the routine needs results that are outstanding. Trials
// of the caller's own are not seen by the routine.
class BatchStrategy final : public Strategy {
 public:
  explicit BatchStrategy(SearchRoutine routine) : routine_(std::move(routine)) {}

  std::optional<UnitPoint> Propose(std::int64_t id) override;
  void Reject(std::int64_t id) override;
  void Observe(std::int64_t id, const UnitPoint& point, double energy, TrialState state) override;
  bool Ended() const override { return ended_; }

 private:
  bool Advance();

  SearchRoutine routine_;
  Batch* batch_ = nullptr;
  std::size_t proposed_ = 0;
  std::size_t evaluated_ = 0;
  std::map<std::int64_t, std::size_t> slots_;
  bool ended_ = false;
};

// The point of the cube that a point of space stands for: periodic coordinates wrap around, others
// are reflected at the faces, so that the energy stays continuous.
UnitPoint FoldIntoCube(UnitPoint point, const std::vector<bool>& periodic);

// Uniform in the cube.
UnitPoint UniformPoint(Random& random, std::size_t dimension);

}  // namespace ridgeline
