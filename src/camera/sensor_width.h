// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

namespace ridgeline {

// Width of a camera's sensor [mm], longer side, by the model name in its EXIF, capitals or not;
// nullopt: unknown. For cameras that do not tell their 35 mm equivalent.
std::optional<double> SensorWidthMm(std::string_view model);

}  // namespace ridgeline
