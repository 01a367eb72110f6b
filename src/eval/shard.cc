// SPDX-License-Identifier: Apache-2.0
#include "eval/shard.h"

#include <charconv>

#include "base/error.h"

namespace ridgeline {
namespace {

// 0: no whole number above 0.
int CountOf(const char* first, const char* last) {
  int value = 0;
  const auto [end, error] = std::from_chars(first, last, value);
  return error == std::errc() && end == last && value > 0 ? value : 0;
}

}  // namespace

Shard ParseShard(const std::string& text) {
  const std::size_t slash = text.find('/');
  Shard shard{0, 0};
  if (slash != std::string::npos) {
    const char* const first = text.data();
    shard = {CountOf(first, first + slash), CountOf(first + slash + 1, first + text.size())};
  }
  if (shard.index < 1 || shard.count < shard.index) {
    throw InputError("--shard", "", "\"" + text + "\"", "a part of a number, such as 2/3");
  }
  return shard;
}

std::string TextOf(const Shard& shard) {
  return std::to_string(shard.index) + "/" + std::to_string(shard.count);
}

}  // namespace ridgeline
