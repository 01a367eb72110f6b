// SPDX-License-Identifier: Apache-2.0
#include "convert/camera_words.h"

#include <cctype>
#include <charconv>
#include <set>
#include <system_error>
#include <utility>

namespace ridgeline {
namespace {

bool StartsNumber(const std::string& text, std::size_t at) {
  const auto digit = [&](std::size_t i) {
    return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0;
  };
  if (at > 0 &&
      (std::isalnum(static_cast<unsigned char>(text[at - 1])) != 0 || text[at - 1] == '_'))
    return false;  // k1, fx2
  if (digit(at)) return true;
  const bool sign = text[at] == '-' || text[at] == '+';
  if (text[at] == '.') return digit(at + 1);
  return sign && (digit(at + 1) || (at + 1 < text.size() && text[at + 1] == '.' && digit(at + 2)));
}

struct Meaning {
  std::set<std::string> keys;
  std::vector<CameraParameter> parameters;  // in the order of the line's numbers
};

const std::vector<Meaning>& Meanings() {
  static const std::vector<Meaning> meanings = {
      {{"f",
        "focal",
        "focallength",
        "focallengthpx",
        "fpx",
        "focallengthpixels",
        "focallengthpixel",
        "focallengthinpixels",
        "focallengthmm",
        "fmm"},
       {CameraParameter::kFx, CameraParameter::kFy}},
      {{"fx", "focallengthx", "focalx", "fxpx"}, {CameraParameter::kFx}},
      {{"fy", "focallengthy", "focaly", "fypx"}, {CameraParameter::kFy}},
      {{"cx", "px", "ppx", "x0", "principalpointx", "cxpx"}, {CameraParameter::kCx}},
      {{"cy", "py", "ppy", "y0", "principalpointy", "cypx"}, {CameraParameter::kCy}},
      {{"principalpoint", "principalpointpx", "principalpointmm", "pp", "cxcy"},
       {CameraParameter::kCx, CameraParameter::kCy}},
      {{"k1", "r1", "radialk1", "radial1"}, {CameraParameter::kK1}},
      {{"k2", "r2", "radialk2", "radial2"}, {CameraParameter::kK2}},
      {{"k3", "r3", "radialk3", "radial3"}, {CameraParameter::kK3}},
      {{"p1", "t1", "tangentialp1", "tangential1"}, {CameraParameter::kP1}},
      {{"p2", "t2", "tangentialp2", "tangential2"}, {CameraParameter::kP2}},
      {{"radial", "radialdistortion", "k1k2k3"},
       {CameraParameter::kK1, CameraParameter::kK2, CameraParameter::kK3}},
      {{"tangential", "tangentialdistortion", "p1p2", "t1t2"},
       {CameraParameter::kP1, CameraParameter::kP2}},
      {{"width", "imagewidth", "w", "cols", "widthpx"}, {CameraParameter::kW}},
      {{"height", "imageheight", "h", "rows", "heightpx"}, {CameraParameter::kH}},
      {{"imagesize", "size", "resolution", "imageresolution", "imagesizepx"},
       {CameraParameter::kW, CameraParameter::kH}},
  };
  return meanings;
}

}  // namespace

KeyedLine ParseKeyedLine(const std::string& text) {
  KeyedLine keyed;
  bool follows_times = false;  // "960x1280", "9.8x7.3mm"
  for (std::size_t at = 0; at < text.size();) {
    const bool is_factor = std::exchange(follows_times, false) &&
                           std::isdigit(static_cast<unsigned char>(text[at])) != 0;
    if (is_factor || StartsNumber(text, at)) {
      const std::size_t from = text[at] == '+' ? at + 1 : at;
      double value = 0.0;
      const auto [end, error] =
          std::from_chars(text.data() + from, text.data() + text.size(), value);
      if (error == std::errc()) {
        keyed.values.push_back(value);
        at = static_cast<std::size_t>(end - text.data());
        follows_times = at < text.size() && (text[at] == 'x' || text[at] == 'X');
        if (follows_times) ++at;
        continue;
      }
    }
    const auto c = static_cast<unsigned char>(text[at++]);
    if (keyed.values.empty() && std::isalnum(c) != 0) {
      keyed.key += static_cast<char>(std::tolower(c));
    }
  }
  keyed.millimetres = text.find("mm") != std::string::npos;
  return keyed;
}

std::vector<CameraParameter> ParametersOf(const std::string& key) {
  for (const Meaning& meaning : Meanings()) {
    if (meaning.keys.contains(key)) return meaning.parameters;
  }
  return {};
}

}  // namespace ridgeline
