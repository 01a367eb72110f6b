// SPDX-License-Identifier: Apache-2.0
#include "fuzz/mutate.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace ridgeline::fuzz {
namespace {

using Bytes = std::vector<std::uint8_t>;

// Numbers and marks at which readers trip.
constexpr std::array<std::string_view, 24> kWords = {
    "0",     "-1",         "1e300",      "1e-300",      "nan",   "inf",  "2147483648", "4294967296",
    "1e9",   "99999999999999999999",     "\"",          "[",     "{",    "}",          "]",
    "<",     ">",          "\xff\xff\xff\xff",          ",",     ";",    "\r\n",       "#",
    "\xef\xbb\xbf",        "18446744073709551615"};

std::size_t Below(std::size_t end, std::mt19937_64& random) {
  return end == 0 ? 0 : static_cast<std::size_t>(random() % end);
}

void Insert(Bytes& bytes, std::size_t at, std::span<const std::uint8_t> piece) {
  bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), piece.begin(), piece.end());
}

bool IsDigit(std::uint8_t c) { return c >= '0' && c <= '9'; }

// Puts a word in the place of the number that begins at or behind a random place.
void ReplaceNumber(Bytes& bytes, std::string_view word, std::mt19937_64& random) {
  const auto begin =
      std::find_if(bytes.begin() + static_cast<std::ptrdiff_t>(Below(bytes.size(), random)),
                   bytes.end(),
                   IsDigit);
  const auto end = std::find_if_not(begin, bytes.end(), IsDigit);
  const std::size_t at = static_cast<std::size_t>(begin - bytes.begin());
  bytes.erase(begin, end);
  Insert(bytes, at, {reinterpret_cast<const std::uint8_t*>(word.data()), word.size()});
}

void ChangeOnce(Bytes& bytes, std::span<const std::uint8_t> other, std::mt19937_64& random) {
  constexpr std::size_t kMostBytes = 1 << 16;
  const std::size_t at = Below(bytes.size(), random);
  const std::size_t length = std::min(bytes.size() - at, 1 + Below(64, random));
  const std::string_view word = kWords[Below(kWords.size(), random)];
  switch (random() % 8) {
    case 0:
      if (!bytes.empty()) bytes[at] ^= static_cast<std::uint8_t>(1u << (random() % 8));
      break;
    case 1:
      if (!bytes.empty()) bytes[at] = static_cast<std::uint8_t>(random());
      break;
    case 2:
      ReplaceNumber(bytes, word, random);
      break;
    case 3:
      Insert(bytes, at, {reinterpret_cast<const std::uint8_t*>(word.data()), word.size()});
      break;
    case 4:
      bytes.resize(at);
      break;
    case 5:
      bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                  bytes.begin() + static_cast<std::ptrdiff_t>(at + length));
      break;
    case 6: {
      const Bytes piece(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                        bytes.begin() + static_cast<std::ptrdiff_t>(at + length));
      for (std::size_t i = 0; i < 1 + random() % 8 && bytes.size() < kMostBytes; ++i) {
        Insert(bytes, at, piece);
      }
      break;
    }
    default: {
      const std::size_t from = Below(other.size(), random);
      Insert(bytes, at, other.subspan(from, std::min(other.size() - from, length)));
      break;
    }
  }
}

}  // namespace

std::vector<std::uint8_t> Mutated(std::span<const std::uint8_t> bytes,
                                  std::span<const std::uint8_t> other,
                                  std::mt19937_64& random) {
  Bytes copy(bytes.begin(), bytes.end());
  const std::size_t changes = 1 + random() % 6;
  for (std::size_t i = 0; i < changes; ++i) ChangeOnce(copy, other, random);
  return copy;
}

}  // namespace ridgeline::fuzz
