// SPDX-License-Identifier: Apache-2.0
#include "camera/picture_blocks.h"

#include <cstddef>
#include <fstream>
#include <system_error>

#include "base/error.h"

namespace ridgeline {
namespace {

constexpr std::string_view kExifHead("Exif\0\0", 6);
constexpr std::string_view kXmpHead("http://ns.adobe.com/xap/1.0/\0", 29);
// Blocks lie before the pixels; a TIFF's may lie anywhere.
constexpr std::size_t kMostBytes = std::size_t{512} << 20;

std::uint32_t BigEndian(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value = (value << 8) | static_cast<unsigned char>(bytes[at + i]);
  }
  return value;
}

std::uint32_t LittleEndian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;)
    value = (value << 8) | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

// Segments from the start of the image to the start of the scan (JPEG, ITU-T T.81, annex B).
PictureBlocks OfJpeg(std::string_view file) {
  PictureBlocks blocks;
  std::size_t at = 2;
  while (at + 4 <= file.size() && file[at] == '\xff') {
    const auto marker = static_cast<unsigned char>(file[at + 1]);
    if (marker == 0xda || marker == 0xd9) break;
    if (marker == 0xff) {
      ++at;
      continue;
    }
    const std::size_t size = BigEndian(file, at + 2, 2);
    if (size < 2 || at + 2 + size > file.size()) break;
    const std::string_view body = file.substr(at + 4, size - 2);
    if (marker == 0xe1 && body.starts_with(kExifHead) && blocks.exif.empty()) {
      blocks.exif = body.substr(kExifHead.size());
    } else if (marker == 0xe1 && body.starts_with(kXmpHead) && blocks.xmp.empty()) {
      blocks.xmp = body.substr(kXmpHead.size());
    }
    at += 2 + size;
  }
  return blocks;
}

// The text of an uncompressed iTXt chunk: keyword 0 flag method language 0 translated 0 text.
std::string TextOfItxt(std::string_view body) {
  constexpr std::string_view kKeyword("XML:com.adobe.xmp\0\0\0", 20);
  if (!body.starts_with(kKeyword)) return {};
  const std::size_t language_end = body.find('\0', kKeyword.size());
  if (language_end == std::string_view::npos) return {};
  const std::size_t translated_end = body.find('\0', language_end + 1);
  if (translated_end == std::string_view::npos) return {};
  return std::string(body.substr(translated_end + 1));
}

PictureBlocks OfPng(std::string_view file) {
  PictureBlocks blocks;
  std::size_t at = 8;
  while (at + 12 <= file.size()) {
    const std::size_t size = BigEndian(file, at, 4);
    if (size > file.size() - at - 12) break;
    const std::string_view type = file.substr(at + 4, 4);
    const std::string_view body = file.substr(at + 8, size);
    if (type == "eXIf") blocks.exif = body;
    if (type == "iTXt" && blocks.xmp.empty()) blocks.xmp = TextOfItxt(body);
    at += 12 + size;
  }
  return blocks;
}

PictureBlocks OfWebp(std::string_view file) {
  PictureBlocks blocks;
  std::size_t at = 12;
  while (at + 8 <= file.size()) {
    const std::size_t size = LittleEndian(file, at + 4);
    if (size > file.size() - at - 8) break;
    std::string_view body = file.substr(at + 8, size);
    if (file.substr(at, 4) == "EXIF") {
      if (body.starts_with(kExifHead)) body.remove_prefix(kExifHead.size());
      blocks.exif = body;
    }
    if (file.substr(at, 4) == "XMP ") blocks.xmp = body;
    at += 8 + size + size % 2;
  }
  return blocks;
}

PictureBlocks OfTiff(std::string_view file) {
  constexpr std::uint16_t kXmpTag = 700;
  PictureBlocks blocks;
  blocks.exif = file;
  const ExifItems items = ParseExif(file);
  const auto it = items.image.find(kXmpTag);
  if (it == items.image.end()) return blocks;
  for (const double byte : it->second.numbers) blocks.xmp += static_cast<char>(byte);
  return blocks;
}

bool IsTiff(std::string_view file) {
  return file.starts_with(std::string_view("II*\0", 4)) ||
         file.starts_with(std::string_view("MM\0*", 4));
}

}  // namespace

PictureBlocks ReadPictureBlocks(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw InputError(path.string(), "", "no such file", "a picture");
  }
  if (std::filesystem::file_size(path, error) > kMostBytes) return {};
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(path.string(), "", "no readable file", "a picture");
  const std::string file{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (file.starts_with("\xff\xd8")) return OfJpeg(file);
  if (file.starts_with("\x89PNG\r\n\x1a\n")) return OfPng(file);
  if (file.starts_with("RIFF") && file.compare(8, 4, "WEBP") == 0) return OfWebp(file);
  if (IsTiff(file)) return OfTiff(file);
  return {};
}

}  // namespace ridgeline
