// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "base/format_text.h"
#include "camera/picture_facts.h"

// The parts of FactsOf. Each fills in what is still absent, so that the finer source comes first.
namespace ridgeline {

// `latitude` and `longitude` as a place [deg]; nullopt where one is absent or out of range, and at
// 0, 0, which a receiver without a fix writes.
std::optional<PictureFacts::Place> PlaceAt(std::optional<double> latitude,
                                           std::optional<double> longitude,
                                           const std::string& source);

// Takes an altitude [m] that can be one: not 0 to the last digit (never written), nor out of
// [-1000, 20000].
void TakeAltitude(double altitude_m,
                  bool above_ellipsoid,
                  const std::string& source,
                  PictureFacts& facts);

void TakeExif(const ExifItems& exif, PictureFacts& facts);
void TakeXmp(const XmpProperties& xmp, PictureFacts& facts);

}  // namespace ridgeline
