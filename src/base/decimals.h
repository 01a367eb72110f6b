// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace ridgeline {

// The double nearest to `value` rounded to so many decimals, so that its shortest text has no more:
// 690909.215, not 690909.2150000001. Not finite, or too large for that many: the value itself.
double RoundedTo(double value, int decimals);

// The shortest text that reads back as the same double.
std::string ShortestText(double value);

}  // namespace ridgeline
