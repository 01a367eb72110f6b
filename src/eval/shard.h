// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace ridgeline {

// One of several parts of a list of work: every count-th piece of it, from the index-th on. The
// parts of one count have no piece in common, and every piece is in one of them.
struct Shard {
  int index = 1;  // from 1
  int count = 1;

  bool operator==(const Shard&) const = default;
  bool Takes(std::size_t piece) const {
    return piece % static_cast<std::size_t>(count) == static_cast<std::size_t>(index - 1);
  }
};

// "2/3". Throws InputError("--shard", ...).
Shard ParseShard(const std::string& text);
std::string TextOf(const Shard& shard);

}  // namespace ridgeline
