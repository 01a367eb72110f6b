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

// Looks into JPEG, PNG (eXIf, iTXt, and the "Raw profile type" texts of older programs), WebP, TIFF
// and BigTIFF files; others have none. Throws InputError if the file cannot be read.
//
// Own code, and not GDAL's or a library's: GDAL 3.6 tells EXIF items rounded to six digits (metres
// for a latitude in degrees) and has none for PNG and WebP; libexif reads JPEG only; Exiv2's
// licence is the GPL. The parsers here read a dozen items, follow no pointer twice and are bounded
// by the size of the file, whatever its bytes are.
PictureBlocks ReadPictureBlocks(const std::filesystem::path& path);

// One EXIF item. ASCII items and long runs of bytes (an XMP packet) are text, all others numbers
// (0 / 0 is NaN).
struct ExifItem {
  std::string text;
  std::vector<double> numbers;
};

// Items by tag number (CIPA DC-008, Exif 2.32) of the three directories, whatever integer type the
// pointers to them have. Damaged parts and items of more than 64 values are left out.
struct ExifItems {
  std::map<std::uint16_t, ExifItem> image;
  std::map<std::uint16_t, ExifItem> photo;
  std::map<std::uint16_t, ExifItem> gps;
};
ExifItems ParseExif(std::string_view tiff);

// Simple properties of an XMP packet by "<namespace> <name>", whether written as attributes or as
// elements; members of a structure by "<namespace> <structure>/<member>". Namespaces are written
// in small letters without "http://", "www." and the "/" or "#" at their end: programs differ in
// these.
// Text before the packet is passed over; a packet that is not XML gives what comes before the
// damage.
using XmpProperties = std::map<std::string, std::string>;
XmpProperties ParseXmp(std::string_view packet);

}  // namespace ridgeline
