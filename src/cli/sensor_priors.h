// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cli/context.h"
#include "input/dataset.h"
#include "track/sensors.h"

namespace ridgeline {

// Takes assignments "sensors.…=…" out of those of --set and applies them. Throws InputError for
// options of the sensors without a sensor file.
SensorOptions TakeSensorOptions(const std::string& sensors, std::vector<std::string>& set);

// Gives the queries of a dataset the priors of a sensor file (track/sensors.h), by their ids; for one
// query alone a file of one row may have any id. The height is left to terrain and camera height where
// sensors.height_source is "dtm". Queries without a usable row lose their prior, which is noted. Throws
// InputError if no query gets one, and for "barometer" without a terrain raster.
void PriorsFromSensors(const std::string& sensors,
                       const SensorOptions& options,
                       const Context& context,
                       Dataset& dataset);

}  // namespace ridgeline
