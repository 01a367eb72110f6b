// SPDX-License-Identifier: Apache-2.0
#include "city/format/coordinate_list.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace ridgeline {
namespace {

constexpr std::size_t kMaxWord = 64;

}  // namespace

void CoordinateList::Begin(std::string_view separators, char decimal) {
  separators_ = separators;
  decimal_ = decimal;
  numbers_.clear();
  tail_.clear();
}

bool CoordinateList::IsSeparator(char c) const {
  return c == ' ' || c == '\n' || c == '\t' || c == '\r' ||
         separators_.find(c) != std::string::npos;
}

void CoordinateList::Word(std::string_view word) {
  std::string pointed;
  std::string_view digits = word.front() == '+' ? word.substr(1) : word;
  if (decimal_ != '.') {
    pointed = digits;
    std::replace(pointed.begin(), pointed.end(), decimal_, '.');
    digits = pointed;
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value)) {
    throw std::invalid_argument(std::string(word.substr(0, kMaxWord)));
  }
  if (numbers_.size() >= kMaxNumbers) throw std::invalid_argument("more numbers than a ring has");
  numbers_.push_back(value);
}

void CoordinateList::Feed(std::string_view text) {
  std::size_t position = 0;
  if (!tail_.empty()) {
    while (position < text.size() && !IsSeparator(text[position])) ++position;
    tail_.append(text.substr(0, position));
    if (tail_.size() > kMaxWord) throw std::invalid_argument(tail_.substr(0, kMaxWord));
    if (position == text.size()) return;
    Word(tail_);
    tail_.clear();
  }
  while (position < text.size()) {
    if (IsSeparator(text[position])) {
      ++position;
      continue;
    }
    const std::size_t first = position;
    while (position < text.size() && !IsSeparator(text[position])) ++position;
    const std::string_view word = text.substr(first, position - first);
    if (position == text.size()) {
      tail_ = word.substr(0, kMaxWord + 1);
    } else {
      Word(word);
    }
  }
}

void CoordinateList::Finish() {
  if (!tail_.empty()) Word(tail_);
  tail_.clear();
}

}  // namespace ridgeline
