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

}  // namespace ridgeline
