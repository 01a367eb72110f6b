// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ridgeline {

// Direction of magnetic north, clockwise from true north [deg], at the Earth's surface by the World
// Magnetic Model 2025 (NOAA NCEI and British Geological Survey; public domain), whose rates of
// change are taken back in time too: within about 0.5 deg from 2015 to 2030 outside of the polar
// regions.
//
// @param year  Decimal, e.g. 2026.5.
double MagneticDeclinationDeg(double latitude_deg, double longitude_deg, double year);

}  // namespace ridgeline
