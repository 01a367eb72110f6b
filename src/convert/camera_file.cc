// SPDX-License-Identifier: Apache-2.0
#include "convert/camera_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "base/error.h"
#include "convert/camera_words.h"
#include "convert/text_lines.h"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;
using enum CameraParameter;

constexpr const char* kExpected =
    "fx, fy, cx, cy (or F, Px, Py in mm with the sensor's size), k1, k2, k3, p1, p2 by name; or a "
    "matrix K; or \"name MODEL width height params\"; or give --camera FILE";

// What a file says, bit by bit.
class Collector {
 public:
  Collector(std::string file, int width, int height)
      : file_(std::move(file)), width_(width), height_(height) {}

  void Set(CameraParameter parameter, double value) {
    values_[static_cast<std::size_t>(parameter)] = value;
  }
  void SetSensor(double width_mm, double height_mm) { sensor_mm_ = std::max(width_mm, height_mm); }
  void SetMillimetres() { millimetres_ = true; }
  void SetMatrix(const std::vector<double>& k) {
    Set(kFx, k[0]);
    Set(kCx, k[2]);
    Set(kFy, k[4]);
    Set(kCy, k[5]);
  }

  CameraIntrinsics Camera() const {
    if (!Value(kFx)) throw InputError(file_, "", "no focal length", kExpected);
    double w = Value(kW).value_or(width_);
    double h = Value(kH).value_or(height_);
    double scale = ScaleFrom(w, h);
    if (millimetres_) {
      if (!sensor_mm_) {
        throw InputError(file_,
                         "focal length",
                         "millimetres without the sensor's size",
                         "pixels, or \"sensor width of WIDTHxHEIGHTmm\"");
      }
      scale *= std::max(w, h) / *sensor_mm_;
    }
    const double fx = *Value(kFx) * scale;
    const double fy = Value(kFy).value_or(*Value(kFx)) * scale;
    const double cx = Value(kCx) ? *Value(kCx) * scale : 0.5 * width_;
    const double cy = Value(kCy) ? *Value(kCy) * scale : 0.5 * height_;
    CheckPlausible(fx, fy, cx, cy);
    const auto distortion = [&](CameraParameter p) { return Value(p).value_or(0.0); };
    CameraIntrinsics camera;
    camera.width = width_;
    camera.height = height_;
    camera.params = {fx, fy, cx, cy};
    const bool bent = distortion(kK1) != 0.0 || distortion(kK2) != 0.0 || distortion(kP1) != 0.0 ||
                      distortion(kP2) != 0.0 || distortion(kK3) != 0.0;
    if (bent) {
      camera.model = "OPENCV";
      for (const CameraParameter p : {kK1, kK2, kP1, kP2}) camera.params.push_back(distortion(p));
    }
    if (distortion(kK3) != 0.0) {
      camera.model = "FULL_OPENCV";
      for (const double value : {distortion(kK3), 0.0, 0.0, 0.0}) camera.params.push_back(value);
    }
    camera.Validate(file_, "camera");
    return camera;
  }

 private:
  std::optional<double> Value(CameraParameter parameter) const {
    return values_[static_cast<std::size_t>(parameter)];
  }

  // Of a camera for pictures of w x h px to those at hand.
  double ScaleFrom(double w, double h) const {
    constexpr double kShape = 0.01;
    if (std::abs(w * height_ / (h * width_) - 1.0) < kShape) return width_ / w;
    throw InputError(
        file_,
        "image size",
        std::to_string(static_cast<int>(w)) + " x " + std::to_string(static_cast<int>(h)) + " px",
        "the shape of the pictures, " + std::to_string(width_) + " x " + std::to_string(height_) +
            " px (--camera FILE gives another camera)");
  }

  void CheckPlausible(double fx, double fy, double cx, double cy) const {
    const double side = std::max(width_, height_);
    const auto within = [](double value, double low, double high) {
      return value >= low && value <= high;
    };
    if (within(fx, 0.2 * side, 20.0 * side) && within(fy / fx, 0.8, 1.25) &&
        within(cx / width_, 0.3, 0.7) && within(cy / height_, 0.3, 0.7)) {
      return;
    }
    char found[160];
    std::snprintf(found, sizeof found, "fx %.1f, fy %.1f, cx %.1f, cy %.1f px", fx, fy, cx, cy);
    throw InputError(file_,
                     "",
                     found,
                     "a camera of pictures of " + std::to_string(width_) + " x " +
                         std::to_string(height_) + " px: " + kExpected);
  }

  std::string file_;
  int width_;
  int height_;
  std::array<std::optional<double>, kCameraParameters> values_;
  std::optional<double> sensor_mm_;
  bool millimetres_ = false;
};

// In pixels, so that a rotation is none.
bool IsMatrix(const std::vector<double>& k) {
  return k.size() == 9 && k[0] > 10.0 && k[4] > 10.0 && k[3] == 0.0 && k[6] == 0.0 && k[7] == 0.0 &&
         k[8] == 1.0 && std::abs(k[1]) < 0.01 * k[0];
}

class Reader {
 public:
  Reader(const fs::path& file, int width, int height)
      : file_(file.string()), width_(width), height_(height), lines_(ReadLines(file)) {
    for (const TextLine& line : lines_) keyed_.push_back(ParseKeyedLine(line.text()));
  }

  CameraFile Read() {
    if (ReadColmap() || ReadBlocks()) return result_;
    Collector collector(file_, width_, height_);
    for (std::size_t i = 0; i < lines_.size(); ++i) ReadKeys(i, collector);
    result_.common = collector.Camera();
    return result_;
  }

 private:
  // "id MODEL width height params" in every line of data.
  bool ReadColmap() {
    for (const TextLine& line : lines_) {
      if (!IsData(line)) continue;
      const bool is_camera = line.size() >= 7 && std::isupper(line[1].front()) != 0 &&
                             std::isdigit(line[2].front()) != 0;
      if (!is_camera) return false;
      CameraIntrinsics camera;
      camera.model = line[1];
      camera.width = line.Integer(2, "width");
      camera.height = line.Integer(3, "height");
      for (std::size_t i = 4; i < line.size(); ++i) {
        camera.params.push_back(line.Number(i, "params"));
      }
      camera.Validate(file_, "line " + std::to_string(line.number()));
      if (camera.width != width_ || camera.height != height_) {
        line.Fail(
            line[2] + " x " + line[3] + " px",
            "the pictures' " + std::to_string(width_) + " x " + std::to_string(height_) + " px");
      }
      result_.by_picture[line[0]] = camera;
      result_.common = camera;
    }
    if (result_.by_picture.size() > 1) result_.common.reset();
    return !result_.by_picture.empty();
  }

  // The matrix in lines i to i + 2; empty if there is none.
  std::vector<double> MatrixAt(std::size_t i) const {
    std::vector<double> k;
    for (std::size_t row = i; row < std::min(i + 3, keyed_.size()); ++row) {
      if (keyed_[row].values.size() != 3 || !keyed_[row].key.empty()) return {};
      k.insert(k.end(), keyed_[row].values.begin(), keyed_[row].values.end());
    }
    return IsMatrix(k) ? k : std::vector<double>{};
  }

  // A matrix in three lines, with the picture's name above and distortion below where they are.
  bool ReadBlocks() {
    int blocks = 0;
    for (std::size_t i = 0; i + 2 < lines_.size(); ++i) {
      const std::vector<double> k = MatrixAt(i);
      if (k.empty()) continue;
      ++blocks;
      Collector collector(file_, width_, height_);
      collector.SetMatrix(k);
      std::string name;
      if (i > 0 && lines_[i - 1].size() == 3 && IsData(lines_[i - 1])) {
        name = lines_[i - 1][0];
        collector.Set(kW, lines_[i - 1].Integer(1, "width"));
        collector.Set(kH, lines_[i - 1].Integer(2, "height"));
      }
      ReadDistortion(i + 3, collector);
      const CameraIntrinsics camera = collector.Camera();
      if (!name.empty()) result_.by_picture[name] = camera;
      result_.common = camera;
      i += 2;
    }
    if (blocks > 1) result_.common.reset();
    return blocks > 0;
  }

  void ReadDistortion(std::size_t i, Collector& collector) const {
    if (i >= keyed_.size() || !keyed_[i].key.empty()) return;
    const std::vector<double>& radial = keyed_[i].values;
    if (radial.size() < 2 || radial.size() > 3) return;
    collector.Set(kK1, radial[0]);
    collector.Set(kK2, radial[1]);
    if (radial.size() == 3) collector.Set(kK3, radial[2]);
    if (i + 1 >= keyed_.size() || keyed_[i + 1].values.size() != 2) return;
    collector.Set(kP1, keyed_[i + 1].values[0]);
    collector.Set(kP2, keyed_[i + 1].values[1]);
  }

  void ReadKeys(std::size_t i, Collector& collector) const {
    const KeyedLine& line = keyed_[i];
    if (line.key.find("sensorwidth") != std::string::npos && line.values.size() >= 2) {
      collector.SetSensor(line.values[0], line.values[1]);
      collector.SetMillimetres();
      return;
    }
    if (!IsData(lines_[i])) return;
    if (IsMatrix(line.values)) {
      collector.SetMatrix(line.values);
      return;
    }
    if (line.values.empty()) {
      if (i + 1 < keyed_.size()) ReadTable(i, collector);
      return;
    }
    const std::vector<CameraParameter> parameters = ParametersOf(line.key);
    if (parameters.empty()) return;
    if (line.millimetres) collector.SetMillimetres();
    for (std::size_t p = 0; p < std::min(parameters.size(), line.values.size()); ++p) {
      collector.Set(parameters[p], line.values[p]);
    }
  }

  // Names in line i over numbers in the next.
  void ReadTable(std::size_t i, Collector& collector) const {
    std::vector<std::string> names(1);
    for (const char c : lines_[i].text() + " ") {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
        names.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      } else if (!names.back().empty()) {
        names.emplace_back();
      }
    }
    names.pop_back();
    const KeyedLine& numbers = keyed_[i + 1];
    if (!numbers.key.empty() || numbers.values.size() != names.size()) return;
    for (std::size_t n = 0; n < names.size(); ++n) {
      const std::vector<CameraParameter> parameters = ParametersOf(names[n]);
      if (!parameters.empty()) collector.Set(parameters.front(), numbers.values[n]);
    }
  }

  std::string file_;
  int width_;
  int height_;
  std::vector<TextLine> lines_;
  std::vector<KeyedLine> keyed_;
  CameraFile result_;
};

}  // namespace

std::optional<CameraIntrinsics> CameraFile::Of(const std::string& picture) const {
  const auto it = by_picture.find(picture);
  return it == by_picture.end() ? common : it->second;
}

CameraFile ReadCameraFile(const fs::path& file, int width, int height) {
  return Reader(file, width, height).Read();
}

}  // namespace ridgeline
