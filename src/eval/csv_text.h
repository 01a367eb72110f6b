// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace ridgeline {

// A number with a fixed count of digits after the point; "" for what is not finite.
std::string CsvNumber(double value, int digits);

// A text as one CSV field (RFC 4180).
std::string CsvField(const std::string& text);

}  // namespace ridgeline
