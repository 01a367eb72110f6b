// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "camera/picture_blocks.h"

namespace ridgeline {
namespace {

constexpr std::uint16_t kPhotoDirectory = 0x8769;
constexpr std::uint16_t kGpsDirectory = 0x8825;
// An item of more values is no fact about a picture but a thumbnail or a table.
constexpr std::uint32_t kMostValues = 1U << 20;

// Bytes per value by TIFF type: byte, ascii, short, long, rational, then the signed ones, float,
// double.
constexpr std::array<std::uint32_t, 13> kTypeSizes = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8};

class TiffReader {
 public:
  explicit TiffReader(std::string_view bytes) : bytes_(bytes) {
    little_ = bytes.starts_with(std::string_view("II*\0", 4));
    valid_ = little_ || bytes.starts_with(std::string_view("MM\0*", 4));
  }

  bool valid() const { return valid_ && bytes_.size() >= 8; }
  bool Has(std::size_t at, std::size_t size) const {
    return at <= bytes_.size() && size <= bytes_.size() - at;
  }

  std::uint64_t Unsigned(std::size_t at, std::size_t size) const {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t index = little_ ? at + size - 1 - i : at + i;
      value = (value << 8) | static_cast<unsigned char>(bytes_[index]);
    }
    return value;
  }

  double Number(std::size_t at, std::uint16_t type) const {
    const auto u16 = [&] { return static_cast<std::uint16_t>(Unsigned(at, 2)); };
    const auto u32 = [&](std::size_t offset) {
      return static_cast<std::uint32_t>(Unsigned(at + offset, 4));
    };
    switch (type) {
      case 3:
        return u16();
      case 4:
        return u32(0);
      case 5:
        return Ratio(u32(0), u32(4));
      case 6:
        return static_cast<std::int8_t>(bytes_[at]);
      case 8:
        return static_cast<std::int16_t>(u16());
      case 9:
        return static_cast<std::int32_t>(u32(0));
      case 10:
        return Ratio(static_cast<std::int32_t>(u32(0)), static_cast<std::int32_t>(u32(4)));
      case 11:
        return std::bit_cast<float>(u32(0));
      case 12:
        return std::bit_cast<double>(Unsigned(at, 8));
      default:
        return static_cast<unsigned char>(bytes_[at]);
    }
  }

  // The items of the directory at an offset; none if it does not lie in the block.
  std::map<std::uint16_t, ExifItem> Directory(std::size_t at) const {
    std::map<std::uint16_t, ExifItem> items;
    if (!Has(at, 2)) return items;
    const std::size_t count = Unsigned(at, 2);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t entry = at + 2 + 12 * i;
      if (!Has(entry, 12)) break;
      ReadItem(entry, items);
    }
    return items;
  }

 private:
  static double Ratio(double numerator, double denominator) {
    return denominator == 0.0 ? std::numeric_limits<double>::quiet_NaN() : numerator / denominator;
  }

  void ReadItem(std::size_t entry, std::map<std::uint16_t, ExifItem>& items) const {
    const auto tag = static_cast<std::uint16_t>(Unsigned(entry, 2));
    const auto type = static_cast<std::uint16_t>(Unsigned(entry + 2, 2));
    const auto count = static_cast<std::uint32_t>(Unsigned(entry + 4, 4));
    if (type == 0 || type >= kTypeSizes.size() || count > kMostValues) return;
    const std::size_t size = std::size_t{kTypeSizes[type]} * count;
    const std::size_t at = size <= 4 ? entry + 8 : Unsigned(entry + 8, 4);
    if (!Has(at, size)) return;
    ExifItem item;
    if (type == 2) {
      item.text = bytes_.substr(at, size);
      item.text.erase(std::min(item.text.find('\0'), item.text.size()));
      while (!item.text.empty() && item.text.back() == ' ') item.text.pop_back();
    } else {
      item.numbers.reserve(count);
      for (std::uint32_t v = 0; v < count; ++v) {
        item.numbers.push_back(Number(at + std::size_t{kTypeSizes[type]} * v, type));
      }
    }
    items.emplace(tag, std::move(item));
  }

  std::string_view bytes_;
  bool little_ = false;
  bool valid_ = false;
};

}  // namespace

ExifItems ParseExif(std::string_view tiff) {
  ExifItems items;
  const TiffReader reader(tiff);
  if (!reader.valid()) return items;
  items.image = reader.Directory(reader.Unsigned(4, 4));
  const auto follow = [&](std::uint16_t tag) -> std::map<std::uint16_t, ExifItem> {
    const auto it = items.image.find(tag);
    if (it == items.image.end() || it->second.numbers.empty()) return {};
    return reader.Directory(static_cast<std::size_t>(it->second.numbers.front()));
  };
  items.photo = follow(kPhotoDirectory);
  items.gps = follow(kGpsDirectory);
  return items;
}

}  // namespace ridgeline
