// SPDX-License-Identifier: Apache-2.0
#include "score/edge_kind.h"

namespace ridgeline {
namespace {

bool IsOwn(Beside beside) { return beside == Beside::kOwnWall || beside == Beside::kOwnRoof; }

}  // namespace

EdgeKind KindOf(const VisiblePiece& piece, const Scene& scene) {
  if (piece.left == Beside::kSky || piece.right == Beside::kSky) return EdgeKind::kSkyline;
  if (IsOwn(piece.left) && IsOwn(piece.right)) {
    return scene.edge(piece.edge).seam ? EdgeKind::kSeam : EdgeKind::kFold;
  }
  if (piece.left == Beside::kGround || piece.right == Beside::kGround) {
    const FeatureEdge& edge = scene.edge(piece.edge);
    const auto is_ground = [&](std::uint32_t surface) {
      return surface != kNoSurface &&
             scene.model().surfaces[surface].surface_class == SurfaceClass::kGround;
    };
    if (is_ground(edge.surface0) || is_ground(edge.surface1)) return EdgeKind::kGround;
  }
  return EdgeKind::kOcclusion;
}

}  // namespace ridgeline
