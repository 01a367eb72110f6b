// SPDX-License-Identifier: Apache-2.0
#include "projection/occluder_leaf.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace ridgeline {
namespace {

// Of degenerate occluders and unused places: nothing lies so deep.
constexpr float kNeverHides = 1e9f;
// Height of a degenerate occluder [m].
constexpr double kThinnest = 5e-4;

}  // namespace

OccluderLeaf::OccluderLeaf(std::span<const std::uint32_t> indices,
                           std::span<const Occluder> occluders) {
  tolerance = simd::Splat(kNeverHides);
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const Occluder& o = occluders[indices[k]];
    const int lane = static_cast<int>(k);
    simd::SetLane(a, lane, o.a);
    simd::SetLane(b, lane, o.b);
    simd::SetLane(c, lane, o.c);
    simd::SetLane(d, lane, o.d);
    // Twice the area, of a triangle too.
    const Eigen::Vector3d across =
        (o.c - o.a).cast<double>().cross((o.c == o.d ? o.c - o.b : o.d - o.b).cast<double>());
    const double length = across.norm();
    const float longest = std::sqrt(std::max({(o.b - o.a).squaredNorm(),
                                              (o.c - o.b).squaredNorm(),
                                              (o.d - o.c).squaredNorm(),
                                              (o.a - o.d).squaredNorm()}));
    // Thinner than the rounding of floats some kilometres from the origin: its plane means nothing.
    if (length <= kThinnest * longest) continue;
    simd::SetLane(normal, lane, (across / length).cast<float>());
    tolerance[lane] = o.tolerance_m;
  }
}

}  // namespace ridgeline
