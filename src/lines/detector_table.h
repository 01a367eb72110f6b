// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lines/detector_plugin.h"

namespace ridgeline {

// All detectors of lines.
std::span<const DetectorPlugin* const> DetectorTable();

// Their names, in the order of the table.
std::vector<std::string> DetectorNames();

// Throws InputError for a name that no detector of the table has.
const DetectorPlugin& FindDetector(const std::string& name);

}  // namespace ridgeline
