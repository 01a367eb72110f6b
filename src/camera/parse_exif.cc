// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "camera/picture_blocks.h"

namespace ridgeline {
namespace {

constexpr std::uint16_t kPhotoDirectory = 0x8769;
constexpr std::uint16_t kGpsDirectory = 0x8825;
constexpr std::uint16_t kXmpPacket = 700;
// An item of more values is no fact about a picture but a thumbnail or a table; a text may be as
// long, an XMP packet in a TIFF file longer.
constexpr std::uint64_t kMostValues = 64;
constexpr std::uint64_t kLongestText = 4096;
constexpr std::uint64_t kLongestPacket = 64U << 20;
constexpr std::uint64_t kMostEntries = 65535;

// Bytes per value by TIFF type: byte, ascii, short, long, rational, then the signed ones, float,
// double, directory, and (16 to 18) BigTIFF's of eight bytes.
constexpr std::array<std::uint64_t, 19> kTypeSizes = {
    0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8};

class TiffReader {
 public:
  explicit TiffReader(std::string_view bytes) : bytes_(bytes) {
    little_ = bytes.starts_with("II");
    const bool known = bytes.size() >= 16 && (little_ || bytes.starts_with("MM"));
    const std::uint64_t version = known ? Unsigned(2, 2) : 0;
    big_ = version == 43;
    valid_ = version == 42 || (big_ && Unsigned(4, 2) == 8);
  }

  bool valid() const { return valid_; }
  std::uint64_t first_directory() const { return big_ ? Unsigned(8, 8) : Unsigned(4, 4); }
  bool Has(std::uint64_t at, std::uint64_t size) const {
    return at <= bytes_.size() && size <= bytes_.size() - at;
  }

  std::uint64_t Unsigned(std::uint64_t at, std::uint64_t size) const {
    std::uint64_t value = 0;
    for (std::uint64_t i = 0; i < size; ++i) {
      const std::uint64_t index = little_ ? at + size - 1 - i : at + i;
      value = (value << 8) | static_cast<unsigned char>(bytes_[index]);
    }
    return value;
  }

  double Number(std::uint64_t at, std::uint16_t type) const {
    const auto u16 = [&] { return static_cast<std::uint16_t>(Unsigned(at, 2)); };
    const auto u32 = [&](std::uint64_t offset) {
      return static_cast<std::uint32_t>(Unsigned(at + offset, 4));
    };
    switch (type) {
      case 3:
        return u16();
      case 4:
      case 13:
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
      case 16:
      case 18:
        return static_cast<double>(Unsigned(at, 8));
      case 17:
        return static_cast<double>(static_cast<std::int64_t>(Unsigned(at, 8)));
      default:
        return static_cast<unsigned char>(bytes_[at]);
    }
  }

  // The items of the directory at an offset; none if it does not lie in the block.
  std::map<std::uint16_t, ExifItem> Directory(std::uint64_t at) const {
    std::map<std::uint16_t, ExifItem> items;
    const std::uint64_t count_size = big_ ? 8 : 2;
    const std::uint64_t entry_size = big_ ? 20 : 12;
    if (!Has(at, count_size)) return items;
    const std::uint64_t count = std::min(Unsigned(at, count_size), kMostEntries);
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t entry = at + count_size + entry_size * i;
      if (!Has(entry, entry_size)) break;
      ReadItem(entry, items);
    }
    return items;
  }

 private:
  static double Ratio(double numerator, double denominator) {
    return denominator == 0.0 ? std::numeric_limits<double>::quiet_NaN() : numerator / denominator;
  }

  void ReadItem(std::uint64_t entry, std::map<std::uint16_t, ExifItem>& items) const {
    const auto tag = static_cast<std::uint16_t>(Unsigned(entry, 2));
    const auto type = static_cast<std::uint16_t>(Unsigned(entry + 2, 2));
    const std::uint64_t word = big_ ? 8 : 4;
    const std::uint64_t count = Unsigned(entry + 4, word);
    if (type >= kTypeSizes.size() || kTypeSizes[type] == 0 || items.contains(tag)) return;
    const bool bytes = type == 1 || type == 7;
    const bool text = type == 2 || (bytes && tag == kXmpPacket);
    const std::uint64_t most = tag == kXmpPacket ? kLongestPacket
                               : text            ? kLongestText
                                                 : kMostValues;
    if (count > most) return;
    const std::uint64_t size = kTypeSizes[type] * count;
    const std::uint64_t value = entry + 4 + word;
    const std::uint64_t at = size <= word ? value : Unsigned(value, word);
    if (!Has(at, size)) return;
    ExifItem item;
    if (text) {
      item.text = bytes_.substr(at, size);
      item.text.erase(std::min(item.text.find('\0'), item.text.size()));
      while (!item.text.empty() && item.text.back() == ' ') item.text.pop_back();
    } else {
      item.numbers.reserve(count);
      for (std::uint64_t v = 0; v < count; ++v) {
        item.numbers.push_back(Number(at + kTypeSizes[type] * v, type));
      }
    }
    items.emplace(tag, std::move(item));
  }

  std::string_view bytes_;
  bool little_ = false;
  bool big_ = false;  // BigTIFF
  bool valid_ = false;
};

}  // namespace

ExifItems ParseExif(std::string_view tiff) {
  ExifItems items;
  const TiffReader reader(tiff);
  if (!reader.valid()) return items;
  items.image = reader.Directory(reader.first_directory());
  const auto follow = [&](std::uint16_t tag) -> std::map<std::uint16_t, ExifItem> {
    const auto it = items.image.find(tag);
    if (it == items.image.end() || it->second.numbers.empty()) return {};
    const double at = it->second.numbers.front();
    if (!(at >= 0.0 && at < static_cast<double>(tiff.size()))) return {};
    return reader.Directory(static_cast<std::uint64_t>(at));
  };
  items.photo = follow(kPhotoDirectory);
  items.gps = follow(kGpsDirectory);
  return items;
}

}  // namespace ridgeline
