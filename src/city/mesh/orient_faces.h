// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "city/mesh/face_set.h"
#include "city/tally.h"

namespace ridgeline {

// Turns the faces of each building so that neighbours agree and normals point outwards. Faces that
// are right already, as in well-made models, stay as they are. Faces are grouped by building.
//
// @param building_ids  For the tally, which names the buildings that were repaired and those whose
//     shells are open.
void OrientFaces(FaceSet& set, const std::vector<std::string>& building_ids, Tally& tally);

}  // namespace ridgeline
