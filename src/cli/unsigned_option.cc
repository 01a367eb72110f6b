// SPDX-License-Identifier: Apache-2.0
#include "cli/unsigned_option.h"

#include <cstddef>
#include <string>

namespace ridgeline {

CLI::Validator Unsigned() {
  constexpr std::size_t kMostDigits = 19;
  return {[](std::string& text) {
            const bool digits = !text.empty() && text.size() <= kMostDigits &&
                                text.find_first_not_of("0123456789") == std::string::npos;
            return digits ? std::string()
                          : "got \"" + text + "\", expected a whole number from 0 on, below 1e19";
          },
          ""};
}

}  // namespace ridgeline
