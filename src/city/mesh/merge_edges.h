// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "city/city_model.h"
#include "city/mesh/face_set.h"

namespace ridgeline {

// Puts edges together that follow each other on one line between like surfaces: the eaves above a
// facade of several polygons are one edge. Surfaces are alike if building, class and plane agree.
// The joined edge has the surfaces of its first piece. Face i is surface i.
std::vector<FeatureEdge> MergeCollinear(const FaceSet& set, const std::vector<FeatureEdge>& edges);

}  // namespace ridgeline
