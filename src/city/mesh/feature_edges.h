// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "city/city_model.h"
#include "city/mesh/face_set.h"

namespace ridgeline {

struct FeatureEdgeOptions {
  double min_dihedral_deg = 10.0;  // smallest fold between the two exposed faces
  double adjoin_m = 0.05;          // faces and edges closer than this touch
  int threads = 0;
};

// The edges of a model that can be seen as lines. An edge of a polygon is first cut where other
// polygons begin or end along it. Of the faces that meet at a piece, those that lie back to back
// (walls shared by adjoining buildings) hide each other; the fold between the two that remain
// decides. A face that a piece crosses (the tall neighbour's wall above a low roof) counts on both
// sides. Pieces of one line with like faces are put together again. Face i becomes surface i.
//
// @param root_of_building  Index of the whole building of each building or part: where two of them
//     meet in one plane, the edge is kept as a seam.
std::vector<FeatureEdge> FindFeatureEdges(const FaceSet& set,
                                          const std::vector<std::uint32_t>& root_of_building,
                                          const FeatureEdgeOptions& options);

}  // namespace ridgeline
