// SPDX-License-Identifier: Apache-2.0
#include "city/tally.h"

#include <algorithm>

namespace ridgeline {

void Tally::Add(std::string_view kind, std::string_view id) {
  auto it = entries_.find(kind);
  if (it == entries_.end()) it = entries_.emplace(std::string(kind), Entry{}).first;
  Entry& entry = it->second;
  ++entry.count;
  const bool repeated = !entry.ids.empty() && entry.ids.back() == id;
  if (!id.empty() && !repeated && entry.ids.size() < kMaxIds) entry.ids.emplace_back(id);
}

void Tally::Add(std::string_view kind, std::size_t count) {
  if (count > 0) entries_[std::string(kind)].count += count;
}

void Tally::Merge(const Tally& other) {
  for (const auto& [kind, entry] : other.entries_) {
    Entry& mine = entries_[kind];
    mine.count += entry.count;
    const std::size_t room = std::min(kMaxIds - mine.ids.size(), entry.ids.size());
    mine.ids.insert(mine.ids.end(), entry.ids.begin(), entry.ids.begin() + room);
  }
}

std::vector<std::string> Tally::Lines() const {
  constexpr std::size_t kShown = 3;
  std::vector<std::string> lines;
  for (const auto& [kind, entry] : entries_) {
    std::string line = std::to_string(entry.count) + " " + kind;
    for (std::size_t i = 0; i < std::min(kShown, entry.ids.size()); ++i) {
      line += (i == 0 ? " (" : ", ") + entry.ids[i];
    }
    if (entry.ids.size() > kShown) line += ", ...";
    if (!entry.ids.empty()) line += ")";
    lines.push_back(line);
  }
  return lines;
}

}  // namespace ridgeline
