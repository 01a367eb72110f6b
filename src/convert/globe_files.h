// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "city/city_model.h"
#include "input/dataset.h"

namespace ridgeline {

// The truths of a dataset for globes and web maps, in WGS 84 longitude and latitude (nine decimals:
// 0.1 mm), with the heights as they are. Throws InputError for places where PROJ has no answer and
// for a dataset whose system is not known.

// Points as RFC 7946 has them; properties: id, set, image, heading from grid and true north, pitch,
// roll, east, north, height.
std::string PosesGeoJson(const Dataset& dataset);

// Placemarks with a view from the camera (OGC KML 2.3: Camera; tilt is 90 + pitch), absolute
// heights.
std::string PosesKml(const Dataset& dataset);

}  // namespace ridgeline
