// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace ridgeline::testing {

// Writes EXIF blocks byte by byte, as CIPA DC-008 defines them, in either byte order; as BigTIFF or
// with pointers of another type where asked.
class ExifWriter {
 public:
  enum class Directory : std::uint8_t { kImage, kPhoto, kGps };
  using Ratio = std::pair<std::uint32_t, std::uint32_t>;

  explicit ExifWriter(bool big_endian = false) : big_(big_endian) {}

  // @param pointer_type  TIFF type of the pointers to directories: 4 LONG, 13 IFD, 16 LONG8, 18
  // IFD8.
  ExifWriter& Layout(bool big_tiff, std::uint16_t pointer_type) {
    word_ = big_tiff ? 8 : 4;
    pointer_type_ = pointer_type;
    return *this;
  }

  ExifWriter& Text(Directory directory, std::uint16_t tag, const std::string& text) {
    return Add(directory, {tag, 2, static_cast<std::uint32_t>(text.size() + 1), text + '\0'});
  }
  ExifWriter& Short(Directory directory, std::uint16_t tag, std::uint16_t value) {
    return Add(directory, {tag, 3, 1, Bytes(value, 2)});
  }
  ExifWriter& Undefined(Directory directory, std::uint16_t tag, const std::string& bytes) {
    return Add(directory, {tag, 7, static_cast<std::uint32_t>(bytes.size()), bytes});
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
    const bool big_tiff = word_ == 8;
    std::string head = std::string(big_ ? "MM" : "II") + Bytes(big_tiff ? 43 : 42, 2);
    if (big_tiff) head += Bytes(8, 2) + Bytes(0, 2);
    const std::size_t first = head.size() + word_;
    head += Bytes(first, word_);
    const std::size_t pointer = pointer_type_ >= 16 ? 8 : 4;
    std::vector<Item> image = items_[0];
    image.push_back({0x8769, pointer_type_, 1, Bytes(0, pointer)});
    image.push_back({0x8825, pointer_type_, 1, Bytes(0, pointer)});
    const std::size_t photo_at = first + DirectoryBytes(image, first).size();
    const std::string photo = DirectoryBytes(items_[1], photo_at);
    const std::size_t gps_at = photo_at + photo.size();
    image[image.size() - 2].bytes = Bytes(photo_at, pointer);
    image[image.size() - 1].bytes = Bytes(gps_at, pointer);
    return head + DirectoryBytes(image, first) + photo + DirectoryBytes(items_[2], gps_at);
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
    const std::size_t count_size = word_ == 8 ? 8 : 2;
    std::string entries = Bytes(items.size(), count_size);
    std::string data;
    const std::size_t data_at = at + count_size + (4 + 2 * word_) * items.size() + word_;
    for (const Item& item : items) {
      entries += Bytes(item.tag, 2) + Bytes(item.type, 2) + Bytes(item.count, word_);
      if (item.bytes.size() <= word_) {
        entries += item.bytes + std::string(word_ - item.bytes.size(), '\0');
      } else {
        entries += Bytes(data_at + data.size(), word_);
        data += item.bytes;
      }
    }
    return entries + Bytes(0, word_) + data;
  }

  std::size_t word_ = 4;  // bytes of an offset
  std::uint16_t pointer_type_ = 4;
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
