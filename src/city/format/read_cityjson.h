// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "city/format/input_file.h"
#include "city/source_model.h"

namespace ridgeline {

// Reads the buildings of CityJSON 1.0, 1.1 or 2.0, or of a CityJSONSeq (one CityJSON object, then
// one CityJSONFeature per line): transform, semantics, geometry templates. All geometries of one
// level with surfaces make one shape; only of fractions of a level ("2.0" and "2.2") the finest
// counts. Throws InputError for text that is not
// CityJSON and for indices out of range.
SourceModel ReadCityJson(InputFile& file);

}  // namespace ridgeline
