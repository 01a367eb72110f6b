// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "input/dataset.h"

namespace ridgeline {

// A dataset as text for `folder`/dataset.json: paths below the folder or beside it become relative.
// Positions are rounded to 1e-7 m and prior angles to 1e-9 degrees, far below any meaning, so that
// formats which store poses in other numbers give back the same text; quaternions are kept to their
// last bit.
std::string DatasetJson(const Dataset& dataset, const std::filesystem::path& folder);

}  // namespace ridgeline
