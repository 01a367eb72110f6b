// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "track/sensors.h"

namespace ridgeline {

// Readings whose compass heading, pitch and roll are those of the integrated gyroscope: rotation rates
// turn the attitude from one reading to the next (exponential map, trapezoid rule), and compass and
// tilt pull it back with a time constant (a complementary filter), so that neither the gyroscope's
// drift nor a shaken accelerometer lasts. Starts at the first reading that has a compass heading and a
// tilt; readings before it, and those after a gap without rates or times, are as the instruments say.
// The heading's reference (sensors.heading_reference) stays as it was.
//
// Throws InputError naming `file` if no reading has a rotation rate and a time.
std::vector<SensorReading> IntegrateGyroscope(std::vector<SensorReading> readings,
                                              const SensorOptions& options,
                                              const std::string& file);

}  // namespace ridgeline
