// SPDX-License-Identifier: Apache-2.0
#include "skyline/column_path.h"

#include <algorithm>
#include <limits>

namespace ridgeline {
namespace {

// out[s] = min over t of in[t] + cost of the steps between t and s: a distance transform in two
// sweeps, since step costs add up along the column.
void SpreadSteps(std::span<const float> in, std::span<const float> step, std::span<float> out) {
  float best = in[0];
  out[0] = best;
  for (std::size_t s = 1; s < in.size(); ++s) {
    best = std::min(in[s], best + step[s - 1]);
    out[s] = best;
  }
  for (std::size_t s = in.size() - 1; s-- > 0;) {
    best = std::min(out[s], best + step[s]);
    out[s] = best;
  }
}

}  // namespace

ColumnPath CheapestColumnPath(const ColumnCosts& costs, int margin_tolerance) {
  const std::size_t columns = static_cast<std::size_t>(costs.columns);
  const std::size_t rows = static_cast<std::size_t>(costs.rows);
  const std::size_t states = rows + 1;
  const auto unary = [&](std::size_t c) {
    return std::span<const float>(costs.unary).subspan(c * states, states);
  };
  const auto step = [&](std::size_t c) {
    return std::span<const float>(costs.step).subspan(c * rows, rows);
  };

  // before[c][s]: cheapest way through the columns left of c that reaches state s of column c.
  std::vector<float> before(columns * states, 0.0f);
  std::vector<float> here(states);
  for (std::size_t c = 1; c < columns; ++c) {
    const float* previous = &before[(c - 1) * states];
    const std::span<const float> u = unary(c - 1);
    for (std::size_t s = 0; s < states; ++s) here[s] = previous[s] + u[s];
    SpreadSteps(here, step(c - 1), std::span<float>(before).subspan(c * states, states));
  }

  ColumnPath path;
  path.states.assign(columns, 0);
  path.margins.assign(columns, 0.0f);
  std::vector<float> after(states, 0.0f);  // the same from the right
  std::vector<float> total(states);
  for (std::size_t c = columns; c-- > 0;) {
    const float* b = &before[c * states];
    const std::span<const float> u = unary(c);
    for (std::size_t s = 0; s < states; ++s) {
      here[s] = after[s] + u[s];
      total[s] = b[s] + here[s];
    }
    const auto best = std::min_element(total.begin(), total.end());
    const int state = static_cast<int>(best - total.begin());
    const auto low_end = total.begin() + std::max(0, state - margin_tolerance);
    const auto high_begin =
        total.begin() + std::min(static_cast<int>(states), state + margin_tolerance + 1);
    float second = std::numeric_limits<float>::max();
    if (low_end != total.begin())
      second = std::min(second, *std::min_element(total.begin(), low_end));
    if (high_begin != total.end())
      second = std::min(second, *std::min_element(high_begin, total.end()));
    path.states[c] = state;
    path.margins[c] = second - *best;
    if (c > 0) SpreadSteps(here, step(c - 1), after);
  }
  return path;
}

}  // namespace ridgeline
