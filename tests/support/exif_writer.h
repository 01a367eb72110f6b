// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace ridgeline::testing {

// Writes EXIF blocks byte by byte, as CIPA DC-008 defines them, in either byte order.
class ExifWriter {
 public:
  enum class Directory : std::uint8_t { kImage, kPhoto, kGps };
  using Ratio = std::pair<std::uint32_t, std::uint32_t>;

  explicit ExifWriter(bool big_endian = false) : big_(big_endian) {}

  ExifWriter& Text(Directory directory, std::uint16_t tag, const std::string& text) {
    return Add(directory, {tag, 2, static_cast<std::uint32_t>(text.size() + 1), text + '\0'});
  }
  ExifWriter& Short(Directory directory, std::uint16_t tag, std::uint16_t value) {
    return Add(directory, {tag, 3, 1, Bytes(value, 2)});
  }
  ExifWriter& Byte(Directory directory, std::uint16_t tag, std::uint8_t value) {
    return Add(directory, {tag, 1, 1, Bytes(value, 1)});
  }
  ExifWriter& Ratios(Directory directory, std::uint16_t tag, const std::vector<Ratio>& ratios) {
    std::string bytes;
    for (const auto& [n, d] : ratios) bytes += Bytes(n, 4) + Bytes(d, 4);
    return Add(directory, {tag, 5, static_cast<std::uint32_t>(ratios.size()), bytes});
  }

  // The TIFF structure.
  std::string Block() const {
    const std::string head =
        (big_ ? std::string("MM\0*", 4) : std::string("II*\0", 4)) + Bytes(8, 4);
    std::vector<Item> image = items_[0];
    image.push_back({0x8769, 4, 1, Bytes(0, 4)});
    image.push_back({0x8825, 4, 1, Bytes(0, 4)});
    const std::size_t photo_at = 8 + DirectoryBytes(image, 8).size();
    const std::string photo = DirectoryBytes(items_[1], photo_at);
    const std::size_t gps_at = photo_at + photo.size();
    image[image.size() - 2].bytes = Bytes(photo_at, 4);
    image[image.size() - 1].bytes = Bytes(gps_at, 4);
    return head + DirectoryBytes(image, 8) + photo + DirectoryBytes(items_[2], gps_at);
  }

 private:
  struct Item {
    std::uint16_t tag;
    std::uint16_t type;
    std::uint32_t count;
    std::string bytes;
  };

  ExifWriter& Add(Directory directory, Item item) {
    items_[static_cast<std::size_t>(directory)].push_back(std::move(item));
    return *this;
  }

  std::string Bytes(std::uint64_t value, std::size_t size) const {
    std::string bytes(size, '\0');
    for (std::size_t i = 0; i < size; ++i) {
      bytes[big_ ? size - 1 - i : i] = static_cast<char>(value >> (8 * i));
    }
    return bytes;
  }

  std::string DirectoryBytes(const std::vector<Item>& items, std::size_t at) const {
    std::string entries = Bytes(items.size(), 2);
    std::string data;
    const std::size_t data_at = at + 2 + 12 * items.size() + 4;
    for (const Item& item : items) {
      entries += Bytes(item.tag, 2) + Bytes(item.type, 2) + Bytes(item.count, 4);
      if (item.bytes.size() <= 4) {
        entries += item.bytes + std::string(4 - item.bytes.size(), '\0');
      } else {
        entries += Bytes(data_at + data.size(), 4);
        data += item.bytes;
      }
    }
    return entries + Bytes(0, 4) + data;
  }

  bool big_;
  std::vector<Item> items_[3];
};

// A JPEG file with EXIF and XMP segments put after its first marker; empty blocks are left out.
inline std::string JpegWith(const std::string& jpeg,
                            const std::string& exif,
                            const std::string& xmp) {
  const auto segment = [](const std::string& body) {
    const std::size_t size = body.size() + 2;
    return std::string("\xff\xe1") + static_cast<char>(size >> 8) + static_cast<char>(size) + body;
  };
  std::string blocks;
  if (!exif.empty()) blocks += segment(std::string("Exif\0\0", 6) + exif);
  if (!xmp.empty()) blocks += segment(std::string("http://ns.adobe.com/xap/1.0/\0", 29) + xmp);
  return jpeg.substr(0, 2) + blocks + jpeg.substr(2);
}

}  // namespace ridgeline::testing
