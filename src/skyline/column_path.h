// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

namespace ridgeline {

// Costs of a boundary that crosses every column of a grid once: at state s of a column, the cells
// 0 .. s - 1 lie above it. Column-major, so that a column's costs are contiguous.
struct ColumnCosts {
  int columns = 0;
  int rows = 0;
  // (rows + 1) per column: cost of the boundary at state s.
  std::vector<float> unary;
  // rows per column: cost of a step of the boundary past cell r between this column and the next
  // (the last column's are not used). Not negative.
  std::vector<float> step;
};

struct ColumnPath {
  std::vector<int> states;  // one per column
  // How much dearer the best path is that leaves this column's state by more than the tolerance.
  std::vector<float> margins;
};

// The path of least total cost, by dynamic programming forwards and backwards, and the exact
// min-marginals of each column. Time and memory: columns * rows.
ColumnPath CheapestColumnPath(const ColumnCosts& costs, int margin_tolerance);

}  // namespace ridgeline
