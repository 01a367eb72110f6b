// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ridgeline {

// What a picture file says about itself, as bytes: the TIFF structure of its EXIF block and its XMP
// packet. Either may be empty.
struct PictureBlocks {
  std::string exif;
  std::string xmp;
};

// Looks into JPEG, PNG, WebP and TIFF files; others have none. Throws InputError if the file cannot
// be read. GDAL tells EXIF items too, but rounded to six digits: metres for a latitude in degrees.
PictureBlocks ReadPictureBlocks(const std::filesystem::path& path);

// One EXIF item: text for ASCII items, numbers for all others (0 / 0 is NaN).
struct ExifItem {
  std::string text;
  std::vector<double> numbers;
};

// Items by tag number (CIPA DC-008, Exif 2.32) of the three directories. Damaged parts are left
// out.
struct ExifItems {
  std::map<std::uint16_t, ExifItem> image;
  std::map<std::uint16_t, ExifItem> photo;
  std::map<std::uint16_t, ExifItem> gps;
};
ExifItems ParseExif(std::string_view tiff);

// Simple properties of an XMP packet by "<namespace URI> <name>", whether written as attributes or
// as elements. A packet that is not XML gives what comes before the damage.
using XmpProperties = std::map<std::string, std::string>;
XmpProperties ParseXmp(std::string_view packet);

}  // namespace ridgeline
