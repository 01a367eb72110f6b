// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace ridgeline {
namespace {

// What a file holds may be of any length, and of any bytes: those that end or move a line of text
// are shown as spaces.
std::string Cut(const std::string& found) {
  constexpr std::size_t kShown = 400;
  std::string shown = found.size() <= kShown ? found : found.substr(0, kShown) + "...";
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c >= '\0' && c < ' ' && c != '\n'; }, ' ');
  return shown;
}

std::string Message(const std::string& file,
                    const std::string& field,
                    const std::string& found,
                    const std::string& expected) {
  std::string message = Cut(file);
  if (!field.empty()) message += (message.empty() ? "" : ": ") + Cut(field);
  std::string detail;
  if (!found.empty()) detail = "got " + Cut(found);
  if (!expected.empty()) detail += (detail.empty() ? "expected " : ", expected ") + expected;
  if (!detail.empty()) message += (message.empty() ? "" : ": ") + detail;
  return message;
}

std::size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substitution = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, substitution});
    }
  }
  return row.back();
}

}  // namespace

InputError::InputError(std::string file, std::string field, std::string found, std::string expected)
    : std::runtime_error(Message(file, field, found, expected)),
      file_(std::move(file)),
      field_(std::move(field)) {}

std::string NearestName(std::string_view name, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t best_distance = std::numeric_limits<std::size_t>::max();
  for (const std::string& candidate : candidates) {
    const std::size_t distance = EditDistance(name, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace ridgeline
