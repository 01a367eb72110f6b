// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "skyline/skyline.h"

namespace ridgeline {

using Polyline = std::vector<Eigen::Vector2d>;

// Algorithm 1 of Ayadi et al.: keeps point i if |y[i + 1] + y[i - 1] - 2 y[i]| < precision. The two
// end points are kept. A precision of 0 keeps every point, as the paper says of it.
Polyline RemoveAberrantPoints(const Polyline& points, double precision_px);

// Douglas-Peucker: the fewest of the points, found by halving, such that no point lies farther than
// `precision_px` from the line between its neighbours that are kept.
Polyline SimplifyPolyline(const Polyline& points, double precision_px);

// Both, over each run of seen columns: y_px of the columns then lies on the simplified polygon.
// Other columns are left alone.
Skyline CleanSkyline(const Skyline& skyline, double precision_px);

}  // namespace ridgeline
