// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ridgeline {

// What a camera is made of, as text files name it. T1 and T2 of Pix4D are p1 and p2.
enum class CameraParameter : std::uint8_t { kFx, kFy, kCx, kCy, kK1, kK2, kK3, kP1, kP2, kW, kH };
inline constexpr std::size_t kCameraParameters = 11;

// A line as words and numbers: "Focal length (px): 1000.5" is a key and a number.
struct KeyedLine {
  std::string key;  // the words before the first number, small letters and digits only
  std::vector<double> values;
  bool millimetres = false;
};

KeyedLine ParseKeyedLine(const std::string& text);

// The parameters that the numbers after a key stand for, in their order; empty for other keys.
std::vector<CameraParameter> ParametersOf(const std::string& key);

}  // namespace ridgeline
