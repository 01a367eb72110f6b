// SPDX-License-Identifier: Apache-2.0
#include "eval/csv_text.h"

#include <cmath>
#include <sstream>

namespace ridgeline {

std::string CsvNumber(double value, int digits) {
  if (!std::isfinite(value)) return "";
  std::ostringstream text;
  text.precision(digits);
  text << std::fixed << value;
  return text.str();
}

std::string CsvField(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

bool ReadCsvRow(std::istream& stream, std::vector<std::string>& fields) {
  fields.clear();
  if (stream.peek() == std::istream::traits_type::eof()) return false;
  fields.emplace_back();
  bool quoted = false;
  for (char c = 0; stream.get(c);) {
    if (quoted) {
      if (c != '"') {
        fields.back() += c;
      } else if (stream.peek() == '"') {
        fields.back() += static_cast<char>(stream.get());
      } else {
        quoted = false;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      fields.emplace_back();
    } else if (c == '\n') {
      break;
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  return true;
}

}  // namespace ridgeline
