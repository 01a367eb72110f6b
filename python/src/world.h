// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "input/world.h"

namespace ridgeline::python {

// A path, as os.fspath() gives it.
std::filesystem::path PathOf(pybind11::handle value);
// One path or a list of them.
std::vector<std::filesystem::path> PathsOf(pybind11::handle value);

}  // namespace ridgeline::python
