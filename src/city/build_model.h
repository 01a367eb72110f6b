// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "city/city_model.h"
#include "city/read_city.h"
#include "city/source_model.h"

namespace ridgeline {

// Puts source models, already in one projected system, into one mesh: the wanted level of each
// building, vertices welded, surfaces classified, turned outwards and triangulated, feature edges
// found. Buildings that several files hold (tiles that overlap) are taken once. The sources are
// consumed.
CityModel BuildModel(std::vector<SourceModel>& sources, const Crs& crs, const CityOptions& options);

}  // namespace ridgeline
