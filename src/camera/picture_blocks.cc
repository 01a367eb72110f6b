// SPDX-License-Identifier: Apache-2.0
#include "camera/picture_blocks.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "base/atomic_file.h"
#include "base/regular_file.h"

namespace ridgeline {
namespace {

constexpr std::string_view kExifHead("Exif\0\0", 6);
constexpr std::string_view kXmpHead("http://ns.adobe.com/xap/1.0/\0", 29);
// No packet is larger.
constexpr std::size_t kMostInflated = std::size_t{64} << 20;

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

// Some programs keep JPEG's head before the block where none belongs, or end it with another byte.
std::string WithoutHead(std::string_view exif) {
  if (exif.starts_with(kExifHead.substr(0, 5)) && exif.size() > kExifHead.size()) {
    exif.remove_prefix(kExifHead.size());
  }
  return std::string(exif);
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
    if (marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8)) {  // stand alone
      at += 2;
      continue;
    }
    const std::size_t size = BigEndian(file, at + 2, 2);
    if (size < 2 || at + 2 + size > file.size()) break;
    const std::string_view body = file.substr(at + 4, size - 2);
    if (marker == 0xe1 && body.starts_with(kExifHead.substr(0, 5)) && blocks.exif.empty()) {
      blocks.exif = WithoutHead(body);
    } else if (marker == 0xe1 && body.starts_with(kXmpHead) && blocks.xmp.empty()) {
      blocks.xmp = body.substr(kXmpHead.size());
    }
    at += 2 + size;
  }
  return blocks;
}

// zlib's stream; what comes before the damage of a damaged one.
std::string Inflated(std::string_view deflated) {
  std::string text;
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) return text;
  std::array<char, 1 << 15> part;
  // zlib's interface is older than const.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(deflated.data()));  // NOLINT
  stream.avail_in = static_cast<uInt>(std::min(deflated.size(), kMostInflated));
  int state = Z_OK;
  while (state == Z_OK && text.size() < kMostInflated) {
    stream.next_out = reinterpret_cast<Bytef*>(part.data());  // NOLINT
    stream.avail_out = part.size();
    state = inflate(&stream, Z_NO_FLUSH);
    text.append(part.data(), part.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  return text;
}

struct PngText {
  std::string_view keyword;
  std::string text;
};

// PNG (third edition), 11.3.3: keyword 0, then by type [flag] [method] [language 0 translated 0].
PngText TextOfChunk(std::string_view type, std::string_view body) {
  PngText result;
  const std::size_t end = body.find('\0');
  if (end == std::string_view::npos) return result;
  result.keyword = body.substr(0, end);
  body.remove_prefix(end + 1);
  bool deflated = type == "zTXt";
  if (deflated) body.remove_prefix(std::min<std::size_t>(1, body.size()));
  if (type == "iTXt") {
    if (body.size() < 2) return result;
    deflated = body[0] == 1;
    body.remove_prefix(2);
    for (int i = 0; i < 2; ++i) {
      const std::size_t next = body.find('\0');
      if (next == std::string_view::npos) return result;
      body.remove_prefix(next + 1);
    }
  }
  result.text = deflated ? Inflated(body) : std::string(body);
  return result;
}

// What older programs write: a line of the kind, a line of the length, hexadecimal digits.
std::string OfRawProfile(std::string_view text) {
  for (int line = 0; line < 3; ++line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  std::string bytes;
  int high = -1;
  for (const char c : text) {
    const int digit = c >= '0' && c <= '9'   ? c - '0'
                      : c >= 'a' && c <= 'f' ? c - 'a' + 10
                      : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                             : -1;
    if (digit < 0) continue;
    if (high >= 0) bytes += static_cast<char>(16 * high + digit);
    high = high < 0 ? digit : -1;
  }
  return bytes;
}

void TakePngText(const PngText& text, PictureBlocks& blocks) {
  if (text.keyword == "XML:com.adobe.xmp" && blocks.xmp.empty()) blocks.xmp = text.text;
  constexpr std::string_view kProfile = "Raw profile type ";
  if (!text.keyword.starts_with(kProfile)) return;
  const std::string_view kind = text.keyword.substr(kProfile.size());
  const std::string bytes = OfRawProfile(text.text);
  if (kind == "xmp" && blocks.xmp.empty()) blocks.xmp = bytes;
  if (kind != "exif" && kind != "APP1") return;
  if (bytes.starts_with(kXmpHead)) {
    if (blocks.xmp.empty()) blocks.xmp = bytes.substr(kXmpHead.size());
  } else if (blocks.exif.empty()) {
    blocks.exif = WithoutHead(bytes);
  }
}

PictureBlocks OfPng(std::string_view file) {
  PictureBlocks blocks;
  std::size_t at = 8;
  while (at + 12 <= file.size()) {
    const std::size_t size = BigEndian(file, at, 4);
    if (size > file.size() - at - 12) break;
    const std::string_view type = file.substr(at + 4, 4);
    const std::string_view body = file.substr(at + 8, size);
    if (type == "eXIf") blocks.exif = WithoutHead(body);
    if (type == "iTXt" || type == "zTXt" || type == "tEXt") {
      TakePngText(TextOfChunk(type, body), blocks);
    }
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
    const std::string_view body = file.substr(at + 8, size);
    if (file.substr(at, 4) == "EXIF") blocks.exif = WithoutHead(body);
    if (file.substr(at, 4) == "XMP ") blocks.xmp = body;
    at += 8 + size + size % 2;
  }
  return blocks;
}

PictureBlocks OfTiff(std::string file) {
  constexpr std::uint16_t kXmpTag = 700;
  PictureBlocks blocks;
  const ExifItems items = ParseExif(file);
  const auto it = items.image.find(kXmpTag);
  if (it != items.image.end()) blocks.xmp = it->second.text;
  blocks.exif = std::move(file);
  return blocks;
}

bool IsTiff(std::string_view file) {
  return file.starts_with(std::string_view("II*\0", 4)) ||
         file.starts_with(std::string_view("MM\0*", 4)) ||
         file.starts_with(std::string_view("II+\0", 4)) ||
         file.starts_with(std::string_view("MM\0+", 4));
}

}  // namespace

PictureBlocks ReadPictureBlocks(const std::filesystem::path& path) {
  RequireRegularFile(path, "a picture");
  std::string file = ReadFile(path);
  if (file.starts_with("\xff\xd8")) return OfJpeg(file);
  if (file.starts_with("\x89PNG\r\n\x1a\n")) return OfPng(file);
  constexpr std::size_t kWebpHeader = 12;  // "RIFF", a size, "WEBP"
  if (file.starts_with("RIFF") && file.size() >= kWebpHeader && file.compare(8, 4, "WEBP") == 0) {
    return OfWebp(file);
  }
  if (IsTiff(file)) return OfTiff(std::move(file));
  return {};
}

}  // namespace ridgeline
