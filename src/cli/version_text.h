// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace ridgeline {

// "0.1.0" of a release; "0.1.0+12.g0a1b2c3d4" twelve commits after it, "0.1.0+g0a1b2c3d4" where git
// knows no release; ".dirty" at the end where files were changed.
std::string VersionNumber();

// "ridgeline 0.1.0".
std::string VersionText();

}  // namespace ridgeline
