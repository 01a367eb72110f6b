// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ridgeline {

// Numbers of a coordinate list, parsed while the text comes in, so that a list of nonsense fails at
// its first word and memory stays with the numbers. White space separates, and so do `separators`;
// `decimal` stands for the point.
class CoordinateList {
 public:
  // Longest list accepted; a ring of a building has dozens of numbers.
  static constexpr std::size_t kMaxNumbers = 3'000'000;

  void Begin(std::string_view separators = "", char decimal = '.');
  // Both throw std::invalid_argument holding the word that is not a finite number.
  void Feed(std::string_view text);
  void Finish();

  const std::vector<double>& numbers() const { return numbers_; }

 private:
  bool IsSeparator(char c) const;
  void Word(std::string_view word);

  std::vector<double> numbers_;
  std::string separators_;
  char decimal_ = '.';
  std::string tail_;  // a word cut by the end of a piece of text
};

}  // namespace ridgeline
