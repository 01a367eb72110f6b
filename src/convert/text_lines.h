// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "camera/pose.h"

namespace ridgeline {

// A line of a text file, cut into fields at blanks or at a delimiter.
class TextLine {
 public:
  TextLine(std::string file, int number, std::string text, char delimiter);

  int number() const { return number_; }
  const std::string& text() const { return text_; }
  std::size_t size() const { return fields_.size(); }
  const std::string& operator[](std::size_t i) const { return fields_[i]; }

  // The field as a finite number. Throws InputError with file, line and `name` if it is none or if
  // the line ends before it.
  double Number(std::size_t field, const char* name) const;
  int Integer(std::size_t field, const char* name) const;
  // Unit quaternion w, x, y, z from this field on; normalized only if it is off by more than
  // rounding.
  Eigen::Quaterniond Quaternion(std::size_t field) const;
  // All fields from this one on, with the blanks between them.
  std::string Rest(std::size_t field) const;
  // Throws InputError "file: line N: got <found>, expected <expected>".
  [[noreturn]] void Fail(const std::string& found, const std::string& expected) const;

 private:
  std::string file_;
  int number_;
  std::string text_;
  std::vector<std::string> fields_;
};

// The lines of a file in order, comments (#) and empty ones included.
//
// @param delimiter  ' ': any run of blanks and tabs.
std::vector<TextLine> ReadLines(const std::filesystem::path& path, char delimiter = ' ');

// Whether a line has something to say.
bool IsData(const TextLine& line);

// Three numbers after "# origin" in a file's comments; zero if there are none.
Eigen::Vector3d OriginIn(const std::vector<TextLine>& lines);

}  // namespace ridgeline
