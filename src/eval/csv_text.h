// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <istream>
#include <string>
#include <vector>

namespace ridgeline {

// A number with a fixed count of digits after the point; "" for what is not finite.
std::string CsvNumber(double value, int digits);

// A text as one CSV field (RFC 4180).
std::string CsvField(const std::string& text);

// The fields of the next row, quotes undone (RFC 4180); false at the end of the text.
bool ReadCsvRow(std::istream& stream, std::vector<std::string>& fields);

}  // namespace ridgeline
