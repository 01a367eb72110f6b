// SPDX-License-Identifier: Apache-2.0
#include "camera/picture_facts.h"

#include <cmath>

#include "base/error.h"
#include "camera/facts_parts.h"

namespace ridgeline {

std::optional<PictureFacts::Place> PlaceAt(std::optional<double> latitude,
                                           std::optional<double> longitude,
                                           const std::string& source) {
  if (!latitude || !longitude || (*latitude == 0.0 && *longitude == 0.0)) return std::nullopt;
  if (std::abs(*latitude) > 90.0 || std::abs(*longitude) > 360.0) return std::nullopt;
  return PictureFacts::Place{*latitude, *longitude, source};
}

void TakeAltitude(double altitude_m,
                  bool above_ellipsoid,
                  const std::string& source,
                  PictureFacts& facts) {
  const bool never_written = altitude_m == 0.0;
  if (never_written || !(altitude_m >= -1000.0 && altitude_m <= 20000.0)) {
    facts.doubts.push_back(
        FormatText("altitude: %.4g m in %s %s; taken as not told",
                   altitude_m,
                   source.c_str(),
                   never_written ? "was never written, as it seems" : "is none on this earth"));
    return;
  }
  facts.altitude_m = altitude_m;
  facts.altitude_above_ellipsoid = above_ellipsoid;
}

PictureFacts FactsOf(const ExifItems& exif, const XmpProperties& xmp) {
  PictureFacts facts;
  TakeXmp(xmp, facts);
  TakeExif(exif, facts);
  return facts;
}

PictureFacts ReadPictureFacts(const std::filesystem::path& path) {
  const PictureBlocks blocks = ReadPictureBlocks(path);
  const XmpProperties xmp = ParseXmp(blocks.xmp);
  const auto projection = xmp.find("ns.google.com/photos/1.0/panorama ProjectionType");
  if (projection != xmp.end()) {
    throw InputError(path.string(),
                     "GPano:ProjectionType",
                     "an " + projection->second + " panorama",
                     "a picture of a camera with a lens (cut one out of the panorama)");
  }
  return FactsOf(ParseExif(blocks.exif), xmp);
}

bool OrientationSwapsSides(int orientation) { return orientation >= 5 && orientation <= 8; }

double OrientationRollDeg(int orientation) {
  switch (orientation) {
    case 3:
    case 4:
      return 180.0;
    case 5:
    case 6:
      return 90.0;
    case 7:
    case 8:
      return -90.0;
    default:
      return 0.0;
  }
}

}  // namespace ridgeline
