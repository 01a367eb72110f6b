// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "city/city_model.h"
#include "city/mesh/face_set.h"

namespace ridgeline {

// Marks as seams the corners at which one building's facade goes on, within `joint_m`, in another
// building's: in terraced rows whose models are a few centimetres or decimetres off, the joint is
// two corners with a small step, where the street shows one line at most. Edges are cut where the
// neighbour's facade ends. Face i is surface i.
void MarkJointSeams(const FaceSet& set,
                    const std::vector<std::uint32_t>& root_of_building,
                    double joint_m,
                    std::vector<FeatureEdge>& edges);

}  // namespace ridgeline
