// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "optim/batch_search.h"

namespace ridgeline {

struct Vertex {
  UnitPoint point;
  double energy = 0.0;
};

// One downhill simplex (Nelder and Mead 1965; coefficients 1, 2, 1/2, 1/2) over some of the
// coordinates, the others at rest.
// @param best  Where it starts, with its energy; at the end the best vertex. Shared with the
// caller.
// @param step  Edge of the first simplex, along each coordinate; inwards at a face of the cube.
// @param smallest  Ends when no vertex is farther from the best than this along any axis.
SearchRoutine Simplex(std::shared_ptr<Vertex> best,
                      std::vector<std::size_t> coordinates,
                      std::vector<bool> periodic,
                      double step,
                      double smallest);

}  // namespace ridgeline
