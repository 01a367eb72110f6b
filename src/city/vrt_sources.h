// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace ridgeline {

// Throws InputError if a file is a VRT and names, itself or by a VRT that it names, a pipe or a
// device as a source: GDAL would wait for it for ever. Other files pass.
void CheckVrtSources(const std::string& file);

}  // namespace ridgeline
