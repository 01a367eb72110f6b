// SPDX-License-Identifier: Apache-2.0
#include "convert/text_lines.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include "base/error.h"
#include "base/text_file.h"

namespace ridgeline {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string Trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(kBlanks) - first + 1));
}

std::vector<std::string> Fields(const std::string& text, char delimiter) {
  std::vector<std::string> fields;
  std::size_t at = 0;
  if (delimiter == ' ') {
    while ((at = text.find_first_not_of(kBlanks, at)) != std::string::npos) {
      const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
      fields.push_back(text.substr(at, end - at));
      at = end;
    }
    return fields;
  }
  while (at <= text.size()) {
    const std::size_t end = std::min(text.find(delimiter, at), text.size());
    std::string field = Trimmed(std::string_view(text).substr(at, end - at));
    const bool quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
    if (quoted) field = field.substr(1, field.size() - 2);
    fields.push_back(std::move(field));
    at = end + 1;
  }
  return fields;
}

}  // namespace

TextLine::TextLine(std::string file, int number, std::string text, char delimiter)
    : file_(std::move(file)),
      number_(number),
      text_(std::move(text)),
      fields_(Fields(text_, delimiter)) {}

double TextLine::Number(std::size_t field, const char* name) const {
  if (field >= fields_.size()) {
    Fail(std::to_string(fields_.size()) + " columns", std::string("a number for ") + name);
  }
  std::string_view text = fields_[field];
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = NAN;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    Fail("\"" + fields_[field] + "\"", std::string("a number for ") + name);
  }
  return value;
}

int TextLine::Integer(std::size_t field, const char* name) const {
  const double value = Number(field, name);
  if (value != std::floor(value) || std::abs(value) > 2147483647.0) {
    Fail("\"" + fields_[field] + "\"", std::string("a whole number for ") + name);
  }
  return static_cast<int>(value);
}

Eigen::Quaterniond TextLine::Quaternion(std::size_t field) const {
  Eigen::Quaterniond q(Number(field, "qw"),
                       Number(field + 1, "qx"),
                       Number(field + 2, "qy"),
                       Number(field + 3, "qz"));
  constexpr double kUnitTolerance = 1e-3;  // lists with few digits
  constexpr double kRounding = 1e-14;
  const double deviation = std::abs(q.norm() - 1.0);
  if (!(deviation < kUnitTolerance)) {
    Fail("a quaternion of norm " + std::to_string(q.norm()), "a unit quaternion qw qx qy qz");
  }
  if (deviation > kRounding) q.normalize();
  return q;
}

std::string TextLine::Rest(std::size_t field) const {
  if (field >= fields_.size()) {
    Fail(std::to_string(fields_.size()) + " columns",
         "a name in column " + std::to_string(field + 1));
  }
  // Found from the back, since earlier fields may be equal.
  std::size_t at = 0;
  for (std::size_t i = 0; i < field; ++i) {
    at = text_.find(fields_[i], at) + fields_[i].size();
  }
  return Trimmed(std::string_view(text_).substr(at));
}

void TextLine::Fail(const std::string& found, const std::string& expected) const {
  throw InputError(file_, "line " + std::to_string(number_), found, expected);
}

std::vector<TextLine> ReadLines(const std::filesystem::path& path, char delimiter) {
  const std::string content = ReadText(path);
  std::vector<TextLine> lines;
  std::size_t at = content.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  while (at < content.size()) {
    const std::size_t end = std::min(content.find('\n', at), content.size());
    std::string text = content.substr(at, end - at);
    if (text.ends_with('\r')) text.pop_back();
    lines.emplace_back(
        path.string(), static_cast<int>(lines.size()) + 1, std::move(text), delimiter);
    at = end + 1;
  }
  return lines;
}

bool IsData(const TextLine& line) {
  const std::size_t first = line.text().find_first_not_of(kBlanks);
  return first != std::string::npos && line.text()[first] != '#';
}

Eigen::Vector3d OriginIn(const std::vector<TextLine>& lines) {
  for (const TextLine& line : lines) {
    if (line.size() < 5 || line[0] != "#" || line[1] != "origin") continue;
    return {line.Number(2, "the origin's east"),
            line.Number(3, "the origin's north"),
            line.Number(4, "the origin's height")};
  }
  return Eigen::Vector3d::Zero();
}

}  // namespace ridgeline
