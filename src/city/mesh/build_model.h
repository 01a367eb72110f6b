// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "city/city_model.h"
#include "city/mesh/mesh_options.h"
#include "city/source_model.h"
#include "city/tally.h"

namespace ridgeline {

struct BuildStatistics {
  Tally tally;                           // what was dropped or repaired
  std::size_t classified_by_normal = 0;  // surfaces that the source gave no class
};

// Puts source models, already in one projected system, into one mesh: the wanted level of each
// building, vertices welded, surfaces classified, turned outwards and triangulated, feature edges
// found. Buildings that several files hold (tiles that overlap) are taken once. The sources are
// consumed.
CityModel BuildModel(std::vector<SourceModel>& sources,
                     const Crs& crs,
                     const MeshOptions& options,
                     BuildStatistics* statistics = nullptr);

}  // namespace ridgeline
