// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ridgeline {

// Counts what is dropped or repaired, by kind, with the ids concerned.
class Tally {
 public:
  struct Entry {
    std::size_t count = 0;
    std::vector<std::string> ids;  // the first kMaxIds
  };
  static constexpr std::size_t kMaxIds = 1000;

  void Add(std::string_view kind, std::string_view id);
  void Add(std::string_view kind, std::size_t count);
  void Merge(const Tally& other);
  const std::map<std::string, Entry, std::less<>>& entries() const { return entries_; }

  // One line per kind: "12 rings with fewer than 3 points dropped (A, B, C, ...)".
  std::vector<std::string> Lines() const;

 private:
  std::map<std::string, Entry, std::less<>> entries_;
};

}  // namespace ridgeline
