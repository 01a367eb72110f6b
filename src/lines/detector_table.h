// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lines/detector_plugin.h"

namespace ridgeline {

// All detectors of lines. Valid until the next AddDetector().
std::span<const DetectorPlugin* const> DetectorTable();

// Adds a detector of a program of its own to the table. `plugin` must outlive the program's work.
// Throws InputError for a name that the table has.
void AddDetector(const DetectorPlugin& plugin);

// Their names, in the order of the table.
std::vector<std::string> DetectorNames();

// Throws InputError for a name that no detector of the table has.
const DetectorPlugin& FindDetector(const std::string& name);

}  // namespace ridgeline
