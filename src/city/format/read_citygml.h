// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "city/format/input_file.h"
#include "city/source_model.h"

namespace ridgeline {

// Reads the buildings of a CityGML 1.0, 2.0 or 3.0 document (also inside a WFS answer) in one pass:
// boundary surfaces, solids, links between them, building parts, installations, openings, implicit
// geometry. Interiors and appearances are passed over; other city objects are counted. Throws
// InputError for text that is not such a document and for coordinates that are not numbers.
SourceModel ReadCityGml(InputFile& file);

}  // namespace ridgeline
